// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a triangle mesh, remeshes it, and moves its vertices onto the fit, at a scale that suits the shape.
#ifndef EQUIAFFINE_ATTRIBUTES_REMESH_BY_FIT_H
#define EQUIAFFINE_ATTRIBUTES_REMESH_BY_FIT_H

#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/fit/move_to_fit.h>
#include <equiaffine/fit/remesh_on_fit.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine {

/// The result of remesh_by_fit().
template <class Kernel>
struct Remesh_by_fit {
  Fitted_function_traits_3<Kernel> fit; ///< the fit, with values up to a 25th of the size of the mesh above the surface
  Fit_remesh_report report;             ///< outcomes of the vertices
};

} // namespace equiaffine

namespace equiaffine::internal {

/// The kernel of the points of the vertices.
template <class Mesh, class Parameters>
using Kernel_of_vertices = typename CGAL::Kernel_traits<Point_of_vertices<Mesh, Parameters>>::Kernel;

/// When remeshing tries smaller scales of a fit, and when it accepts them.
struct Remesh_thresholds {
  static constexpr double enough = 0.05;       ///< fraction of the vertices that may be off the fit
  static constexpr double least_gain = 1. / 3; ///< fraction of these vertices that must get onto the fit
  static constexpr double greatest_loss = 0.1; ///< fraction of the data at which a number may become unknown
  static constexpr double known = 0.5;         ///< largest relative error of a number that counts as known
  static constexpr std::size_t most_data = 1000; ///< at which numbers are computed
  static constexpr int most_tries = 4;
};

/// The fraction of the vertices of a remesh that are neither on the fit nor on creases.
inline double part_beside_fit(const Whole_motion_3& motion) {
  std::size_t kept = 0;
  for (std::size_t v = 0; v < motion.points().size(); ++v)
    kept += motion.outcome(v) == Fit_outcome::ON_FIT || motion.outcome(v) == Fit_outcome::ON_FEATURE;
  return 1 - double(kept) / double(motion.points().size());
}

/// The fractions of a sample of the data at which a fit knows the affine area density, of order 2, and the affine
/// Gaussian curvature, of order 4.
template <class Kernel>
std::array<double, 2> parts_known(const Fitted_function_traits_3<Kernel>& fit,
                                  const std::vector<typename Kernel::Point_3>& data) {
  const std::vector<std::size_t> some = random_subset(data.size(), Remesh_thresholds::most_data, 1);
  std::array<double, 2> parts = {};
  for (const std::size_t i : some) {
    const auto fitted = fit.structure(data[i]);
    const auto known = [&](std::string_view attribute) {
      return find_row(attribute)->error.is_known(fitted.structure, fitted.error, Remesh_thresholds::known);
    };
    parts[0] += double(known("affine_area_density")) / double(some.size());
    parts[1] += double(known("affine_gaussian_curvature")) / double(some.size());
  }
  return parts;
}

/// Moves a remesh to a fit. If the scale was chosen from the data and many vertices would be off the fit, the scale
/// is too large for the shape. Smaller scales are tried while they leave fewer vertices off the fit and numbers stay
/// known at about as many data. `fit` is replaced by a fit that leaves a third fewer vertices off it.
/// `refit(options)` makes a fit, or throws Input_error.
template <class ConcurrencyTag, class Kernel, class Refit>
Whole_motion_3 motion_to_best_fit(Whole_remesh_3<Kernel>& remesh, Fitted_function_traits_3<Kernel>& fit,
                                  Fit_options options, const std::vector<typename Kernel::Point_3>& data,
                                  const Refit& refit) {
  using Thresholds = Remesh_thresholds;
  const auto motion_to = [&](const Fitted_function_traits_3<Kernel>& to) {
    return motion_to_fit<ConcurrencyTag>(remesh.array(), to, remesh.crossings(), remesh.features());
  };
  std::optional<Whole_motion_3> best = motion_to(fit);
  double last_part = part_beside_fit(*best), least_part = last_part;
  const bool may_change = !options.scale && fit.scale() && remesh.edge_length() > 0;
  if (!may_change || last_part < Thresholds::enough) return *std::move(best);
  options.scale = fit.scale();
  const auto known = parts_known(fit, data);
  for (int n = 0; n < Thresholds::most_tries && least_part >= Thresholds::enough; ++n) {
    try {
      *options.scale /= std::numbers::sqrt2;
      const Fitted_function_traits_3<Kernel> smaller = refit(options);
      const auto still_known = parts_known(smaller, data);
      if (std::max(known[0] - still_known[0], known[1] - still_known[1]) > Thresholds::greatest_loss) break;
      Whole_motion_3 motion = motion_to(smaller);
      const double part = part_beside_fit(motion);
      if (part >= last_part) break;
      last_part = part;
      if (part > (1 - Thresholds::least_gain) * least_part) continue;
      least_part = part;
      fit = smaller;
      best.emplace(std::move(motion));
    } catch (const Input_error&) {
      break; // too few points are within that scale
    }
  }
  return *std::move(best);
}

/// Replaces a mesh by its remesh on a fit, or on a better one.
template <class ConcurrencyTag, class Mesh, class Kernel, class Refit, class Parameters>
Fit_remesh_report remesh_on_best_fit(Mesh& mesh, Fitted_function_traits_3<Kernel>& fit, const Fit_options& fit_options,
                                     const std::vector<typename Kernel::Point_3>& data, const Refit& refit,
                                     const Remesh_options& options, const Parameters& parameters) {
  options.check();
  Whole_remesh_3<Kernel> remesh(copy_to_remesh<Kernel>(mesh, parameters), options, ConcurrencyTag());
  const Whole_motion_3 motion = motion_to_best_fit<ConcurrencyTag>(remesh, fit, fit_options, data, refit);
  return replace_by_moved<ConcurrencyTag>(mesh, remesh, motion, parameters);
}

/// The height above the data up to which remeshing needs the values of a fit: a 25th of the diagonal of their box,
/// widened by a tenth of its longest side, or by more than any coordinate if all points are equal.
template <class Point>
double height_of_remesh(const std::vector<Point>& data) {
  CGAL::Bbox_3 box;
  for (const Point& p : data) box += p.bbox();
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  const double farthest = std::max({std::abs(box.xmax()), std::abs(box.ymax()), std::abs(box.zmax())});
  const double margin = longest > 0 ? longest / 10 : 1 + farthest;
  const CGAL::Bbox_3 wide(box.xmin() - margin, box.ymin() - margin, box.zmin() - margin, box.xmax() + margin,
                          box.ymax() + margin, box.zmax() + margin);
  return 2 * (std::hypot(wide.x_span(), wide.y_span(), wide.z_span()) / 50);
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Fits polynomials to the vertices of a triangle mesh, as Fitted_function_traits_3 does, and remeshes the mesh on
/// the fit with remesh_on_fit(). Also returns the fit. The result is that of `equiaffine mesh --fit FILE`.
///
/// A scale chosen from the data may be too large for parts of the shape: then more than 5 % of the vertices are off
/// the fit. Up to four scales, each smaller by the square root of 2, are tried while they leave fewer vertices off
/// the fit, and while the affine area density and the affine Gaussian curvature stay known to 50 % at about as many
/// of the data, with a loss of at most 10 % of them. A fit at a smaller scale is used if it leaves a third fewer
/// vertices off it.
///
/// The feature angle of `fit_options` defines the creases of the fit, and that of `remesh_options` the edges that
/// are kept; usually both are the same.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `edge_is_constrained_map` | writable property map | none | from edges to bool: edges to keep |
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points |
/// | `vertex_normal_map` | property map | computed from the faces | from vertices to normals, for the fit |
/// | `vertex_outcome_map` | writable property map | none | from vertices of the result to Fit_outcome |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
///
/// Takes the time of remesh_on_fit(), and of up to five fits. CGAL::Parallel_tag gives the same numbers.
/// \throw Input_error and std::invalid_argument as fitted_structures() and remesh_on_fit() do. The mesh is unchanged
/// then.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, internal::Parameter_chain... Parameters>
Remesh_by_fit<internal::Kernel_of_vertices<Mesh, internal::Joined_parameters<Parameters...>>>
remesh_by_fit(Mesh& mesh, const Fit_options& fit_options = {}, const Remesh_options& remesh_options = {},
              const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_remesh_parameters<Joined, internal::Vertex_normal_tag>();
  using Kernel_of_mesh = internal::Kernel_of_vertices<Mesh, Joined>;
  const Joined parameters = internal::joined_parameters(given...);
  const internal::Fit_data_3 data = internal::fit_data_of_graph(mesh, parameters);
  std::vector<typename Kernel_of_mesh::Point_3> points;
  for (const auto& p : data.points) points.emplace_back(p[0], p[1], p[2]);
  const double height = internal::height_of_remesh(points);
  const auto fit_with = [&](const Fit_options& options) {
    return Fitted_function_traits_3<Kernel_of_mesh>(
               internal::fitted_function(runs_in_threads<ConcurrencyTag>(), data, options))
        .in_band(height);
  };
  Remesh_by_fit<Kernel_of_mesh> result = {fit_with(fit_options), {}};
  result.report = internal::remesh_on_best_fit<ConcurrencyTag>(mesh, result.fit, fit_options, points, fit_with,
                                                               remesh_options, parameters);
  return result;
}

} // namespace equiaffine

#endif
