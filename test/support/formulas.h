// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas, and their meshes by compiled code of the library, so that tests that only need a surface do not instantiate
// Marching Cubes.
#ifndef EQUIAFFINE_TEST_SUPPORT_FORMULAS_H
#define EQUIAFFINE_TEST_SUPPORT_FORMULAS_H

#include <equiaffine/engine/vectorized.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>

#include <CGAL/Bbox_3.h>

#include <string>
#include <type_traits>

namespace equiaffine::test {

using Formula = Analytic_function_traits_3<vectorized::Kernel, Expression_3>;

inline Formula formula(const std::string& text, const CGAL::Bbox_3& box) { return {Expression_3(text), box}; }

template <class Traits>
Isosurface_3<vectorized::Kernel> surface_of(const Traits& f, const Marching_cubes_options& options = {})
  requires std::is_constructible_v<vectorized::Formula, Traits>
{
  return vectorized::marching_cubes(Level_set_traits_3(vectorized::Formula(f), 0.), options);
}

} // namespace equiaffine::test

#endif
