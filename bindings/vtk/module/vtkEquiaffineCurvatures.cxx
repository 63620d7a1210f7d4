// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkEquiaffineCurvatures.h"

#include "Attribute_arrays.h"
#include "Doubt.h"
#include "is_aborted.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = std::array<std::size_t, 3>;
using Structures = std::vector<Fitted_structure_3<double>>;

std::vector<Kernel::Point_3> points_of(vtkPolyData& mesh) {
  std::vector<Kernel::Point_3> points;
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    std::array<double, 3> p;
    mesh.GetPoint(n, p.data());
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

/// The triangles of strips and of polygons, which are triangulated as fans around their first corner.
std::vector<Triangle> triangles_of(vtkPolyData& mesh) {
  std::vector<Triangle> triangles;
  const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c) {
    triangles.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
  };
  vtkIdType n;
  const vtkIdType* corners;
  for (mesh.GetPolys()->InitTraversal(); mesh.GetPolys()->GetNextCell(n, corners);)
    for (vtkIdType c = 2; c < n; ++c) add(corners[0], corners[c - 1], corners[c]);
  for (mesh.GetStrips()->InitTraversal(); mesh.GetStrips()->GetNextCell(n, corners);)
    for (vtkIdType c = 2; c < n; ++c) add(corners[c - 2], corners[c - 1 + c % 2], corners[c - c % 2]);
  return triangles;
}

using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;

/// The points with the active normals. Empty unless every point has a normal.
std::vector<Point_with_normal> points_with_normals(vtkPolyData& mesh) {
  vtkDataArray* const normals = mesh.GetPointData()->GetNormals();
  std::vector<Point_with_normal> result;
  if (!normals || normals->GetNumberOfTuples() != mesh.GetNumberOfPoints()) return result;
  for (vtkIdType n = 0; const auto& p : points_of(mesh)) {
    const double* const v = normals->GetTuple3(n++);
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!std::isnormal(length)) return {};
    result.emplace_back(p, Kernel::Vector_3(v[0] / length, v[1] / length, v[2] / length));
  }
  return result;
}

Structures structures_of(vtkPolyData& mesh, const Fit_options& options, Orientation_of_level_set orientation) {
  using Tag = CGAL::Parallel_if_available_tag;
  const std::vector<Triangle> triangles = triangles_of(mesh);
  if (!triangles.empty()) return fitted_structures<Tag>(points_of(mesh), triangles, options, orientation);
  const auto with_normals = points_with_normals(mesh);
  if (with_normals.empty()) return fitted_structures<Tag>(points_of(mesh), options, orientation);
  return fitted_structures<Tag>(with_normals, options, orientation,
                                parameters::point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
                                    .normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>()));
}

void add_columns(const Structures& structures, const Attribute_selection& selection, const std::vector<double>& areas,
                 bool with_errors, vtkPointData& data) {
  std::vector<std::size_t> all(structures.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  Vertex_attributes attributes = attributes_of_fit(structures, selection, areas);
  const Error_rows errors = with_errors ? selected_errors(selection, false) : Error_rows();
  for (const Estimate_attribute& row : errors) attributes.columns.push_back(row.column(structures));
  Attribute_arrays arrays(selection, errors);
  arrays.add(attributes, all);
  arrays.move_to(data);
}

} // namespace

vtkStandardNewMacro(vtkEquiaffineCurvatures);

vtkEquiaffineCurvatures::vtkEquiaffineCurvatures() { this->SetAttributes("all"); }
vtkEquiaffineCurvatures::~vtkEquiaffineCurvatures() { this->SetAttributes(nullptr); }

void vtkEquiaffineCurvatures::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Attributes: " << (this->Attributes ? this->Attributes : "(none)") << '\n'
     << indent << "EstimateErrors: " << this->EstimateErrors << '\n'
     << indent << "Scale: " << this->Scale << '\n'
     << indent << "Degree: " << this->Degree << '\n'
     << indent << "FeatureAngle: " << this->FeatureAngle << '\n'
     << indent << "Orientation: " << this->Orientation << '\n';
}

int vtkEquiaffineCurvatures::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
  vtkPolyData* const input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputs);
  struct Aborted {};
  try {
    const Attribute_selection selection = select_attributes(this->Attributes ? this->Attributes : "none");
    output->ShallowCopy(input);
    if (input->GetNumberOfPoints() == 0) return 1;
    const Progress_observer observer([&](const Progress_observer::Stage& stage) {
      if (stage.total > 0) this->UpdateProgress(double(stage.done) / double(stage.total));
      if (is_aborted(*this)) throw Aborted();
    });
    const Fit_options options = {.scale = this->Scale < 0 ? std::nullopt : std::optional(this->Scale),
                                 .degree = this->Degree == 0 ? std::nullopt : std::optional(this->Degree),
                                 .feature_angle = this->FeatureAngle};
    if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0) refuse_attributes_of_mesh(selection);
    const Structures structures = structures_of(*input, options,
                                                this->Orientation == AGAINST
                                                    ? Orientation_of_level_set::AGAINST_GRADIENT
                                                    : Orientation_of_level_set::ALONG_GRADIENT);
    std::vector<double> areas; // computed after the fit, which checks the triangles
    if (attribute_of_mesh(selection)) areas = selected_vertex_areas(selection, points_of(*input), triangles_of(*input));
    add_columns(structures, selection, areas, this->EstimateErrors, *output->GetPointData());
  } catch (const Aborted&) {
    output->Initialize();
  } catch (const std::bad_alloc&) {
    output->Initialize();
    vtkErrorMacro("not enough memory for the fits to this mesh; use one with fewer points");
  } catch (const std::exception& error) {
    output->Initialize();
    vtkErrorMacro(<< error.what());
  }
  return 1; // also after an error, since 0 would make the pipeline print a second error
}
