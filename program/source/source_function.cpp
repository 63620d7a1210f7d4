// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/source_function.h"

#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>

#include <CGAL/property_map.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

Fit_traits::Fit_traits(Fit fit) : fit_(std::make_shared<const Fit>(std::move(fit))) {}

double Fit_traits::value(const Point_3& p) const { return fit_->value(p); }
Jet_3<double, 1> Fit_traits::first_order(const Point_3& p) const { return fit_->first_order(p); }
Jet_3<double> Fit_traits::taylor(const Point_3& p) const { return fit_->taylor(p); }
Interval Fit_traits::bounds(const CGAL::Bbox_3& box) const { return fit_->bounds(box); }
double Fit_traits::rounding(const Point_3& p) const { return fit_->rounding(p); }
double Fit_traits::certainty(const Point_3& p) const { return fit_->certainty(p); }
CGAL::Bbox_3 Fit_traits::bbox() const { return fit_->bbox(); }
Fit_traits Fit_traits::in_box(const CGAL::Bbox_3& box) const { return Fit_traits(fit_->in_box(box)); }
Fit_traits Fit_traits::in_band(double height) const { return Fit_traits(fit_->in_band(height)); }
Fitted_structure_3<double> Fit_traits::structure(const Point_3& p) const { return fit_->structure(p); }
std::optional<double> Fit_traits::scale() const { return fit_->scale(); }
double Fit_traits::spacing(const Point_3& p) const { return fit_->spacing(p); }
Close_sheets Fit_traits::close_sheets(double longest_step) const {
  return fit_->close_sheets<CGAL::Parallel_if_available_tag>(longest_step);
}
CGAL::Bbox_3 Fit_traits::band_box() const { return fit_->band_box(); }

namespace {

using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;

/// The points with unit normals from the columns nx, ny, nz; empty unless every point has one.
std::vector<Point_with_normal> points_with_normals(const Annotated_mesh_3<Kernel>& mesh) {
  const auto *x = find_column(mesh.attributes, "nx"), *y = find_column(mesh.attributes, "ny"),
             *z = find_column(mesh.attributes, "nz");
  if (!x || !y || !z) return {};
  std::vector<Point_with_normal> result;
  for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i) {
    const double length = std::hypot(x->values[i], y->values[i], z->values[i]);
    if (!std::isnormal(length)) return {};
    result.emplace_back(mesh.mesh.points[i],
                        Kernel::Vector_3(x->values[i] / length, y->values[i] / length, z->values[i] / length));
  }
  return result;
}

/// Calls `fit(parameters, data...)`, where the data are points and triangles, points with normals, or points alone.
template <class Fit>
auto fit_with_parameters(const Annotated_mesh_3<Kernel>& mesh, const Fit& fit) try {
  const auto none = parameters::default_values();
  if (!mesh.mesh.triangles.empty()) return fit(none, mesh.mesh.points, mesh.mesh.triangles);
  const auto with_normals = points_with_normals(mesh);
  if (with_normals.empty()) return fit(none, mesh.mesh.points);
  return fit(parameters::point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
                 .normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>()),
             with_normals);
} catch (const Input_error& error) {
  if (error.field() != "scale") throw; // other options were checked before
  throw Input_error(option_text("scale") + ": " + error.sentence());
}

} // namespace

std::vector<Fitted_structure_3<double>> fit_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options,
                                                     Orientation_of_level_set orientation) {
  return fit_with_parameters(mesh, [&](const auto& parameters, const auto&... data) {
    return fitted_structures<CGAL::Parallel_if_available_tag>(data..., options, orientation, parameters);
  });
}

double part_with_opposed_normals(const Annotated_mesh_3<Kernel>& mesh) {
  if (!mesh.mesh.triangles.empty()) return 0;
  const std::vector<Point_with_normal> points = points_with_normals(mesh);
  std::vector<Eigen::Vector3d> places;
  for (const auto& [p, normal] : points) places.emplace_back(p.x(), p.y(), p.z());
  const Point_tree<3> tree(places);
  std::vector<std::uint8_t> are_opposed(points.size(), 0);
  const auto compare = [&](std::size_t i) {
    for (const std::size_t j : tree.nearest(places[i], 2))
      if (j != i && points[i].second * points[j].second < 0) are_opposed[i] = 1;
  };
  parallel_for<CGAL::Parallel_if_available_tag>(0, points.size(), compare, 256);
  return points.empty() ? 0 : double(std::count(are_opposed.begin(), are_opposed.end(), 1)) / double(points.size());
}

Fit_traits blend_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options) {
  return fit_with_parameters(mesh, [&](const auto& parameters, const auto&... data) {
    return Fit_traits(Fit_traits::Fit(data..., options, parameters));
  });
}

Any_function_3 any_level_set(const Source_function& function, double isovalue, Orientation_of_level_set orientation) {
  return std::visit([&](const auto& f) { return Any_function_3::make(Level_set_traits_3(f, isovalue, orientation)); },
                    function);
}

} // namespace equiaffine
