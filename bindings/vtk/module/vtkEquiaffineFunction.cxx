// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkEquiaffineFunction.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Any_function_3.h>

#include <vtkObjectFactory.h>

using equiaffine::Any_function_3;

vtkStandardNewMacro(vtkEquiaffineFunction);

vtkEquiaffineFunction::vtkEquiaffineFunction() = default;
vtkEquiaffineFunction::~vtkEquiaffineFunction() = default;

void vtkEquiaffineFunction::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Function: " << (this->Function ? "(set)" : "(none)") << '\n';
}

void vtkEquiaffineFunction::SetFormula(const char* formula) try {
  const CGAL::Bbox_3 anywhere(-1, -1, -1, 1, 1, 1); // required, but unused
  this->SetFunction(Any_function_3::make(equiaffine::make_analytic_traits<Any_function_3::Kernel>(
      equiaffine::Expression_3(formula ? formula : ""), anywhere)));
} catch (const equiaffine::Input_error& error) {
  vtkErrorMacro(<< error.what());
}

void vtkEquiaffineFunction::SetFunction(const Any_function_3& function) {
  this->Function = std::make_unique<const Any_function_3>(function);
  this->Modified();
}

double vtkEquiaffineFunction::EvaluateFunction(double x[3]) {
  return this->Function ? this->Function->value({x[0], x[1], x[2]}) : 0;
}

void vtkEquiaffineFunction::EvaluateGradient(double x[3], double g[3]) {
  const auto jet = this->Function ? this->Function->first_order({x[0], x[1], x[2]}) : equiaffine::Jet_3<double, 1>(0.);
  for (std::size_t a = 0; a < 3; ++a) g[a] = jet.coefficients()[1 + a];
}
