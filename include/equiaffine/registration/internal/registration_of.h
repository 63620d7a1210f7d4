// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Surface_registration_3.h>
#include <equiaffine/registration/internal/requests.h>
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The coordinates of a range of CGAL's points, as doubles.
template <class Points>
std::vector<Eigen::Vector3d> vectors_of(const Points& points) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : points) result.push_back(coordinates_of(p));
  return result;
}

// Results of searches become those of another kernel.

template <class Kernel>
typename Kernel::Aff_transformation_3 in_kernel(const Kernel_of_searches::Aff_transformation_3& map) {
  const auto m = [&](int i, int j) { return typename Kernel::FT(map.m(i, j)); };
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2), m(2, 3)};
}

template <class Kernel>
Pair_of_frames_3<Kernel> in_kernel(const Pair_of_frames_3<Kernel_of_searches>& pair) {
  using FT = typename Kernel::FT;
  Pair_of_frames_3<Kernel> result;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& p = pair.points[side];
    result.points[side] = typename Kernel::Point_3(FT(p.x()), FT(p.y()), FT(p.z()));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = pair.frames[side][k];
      result.frames[side][k] = typename Kernel::Vector_3(FT(v.x()), FT(v.y()), FT(v.z()));
    }
  }
  return result;
}

template <class Kernel>
Surface_registration_3<Kernel> in_kernel(Surface_registration_3<Kernel_of_searches> found) {
  Surface_registration_3<Kernel> result;
  for (const auto& m : found.maps) {
    auto& copy = result.maps.emplace_back();
    copy = {in_kernel<Kernel>(m.map), m.log10_false_alarms, m.inliers, m.rms, {}, m.contradictions};
    if (m.pair) copy.pair = in_kernel<Kernel>(*m.pair);
  }
  result.hypotheses = found.hypotheses;
  result.equally_good = found.equally_good;
  result.size = found.size;
  result.next_best_rms = found.next_best_rms;
  result.slippage = std::move(found.slippage);
  result.reason = std::move(found.reason);
  return result;
}

template <class Kernel>
std::vector<Affine_symmetry_3<Kernel>> in_kernel(const std::vector<Affine_symmetry_3<Kernel_of_searches>>& maps) {
  std::vector<Affine_symmetry_3<Kernel>> result;
  for (const auto& m : maps) result.push_back({in_kernel<Kernel>(m.map), m.rms, m.greatest});
  return result;
}

template <class Kernel>
Affine_symmetries_3<Kernel> in_kernel(Affine_symmetries_3<Kernel_of_searches> found) {
  Affine_symmetries_3<Kernel> result{found.verdict, std::move(found.reason)};
  for (const auto& level : found.levels)
    result.levels.push_back({in_kernel<Kernel>(level.maps), level.rms, level.greatest});
  result.maps = in_kernel<Kernel>(found.maps);
  result.continuous = std::move(found.continuous);
  result.is_decided = found.is_decided;
  result.kind = found.kind;
  result.complete_to = found.complete_to;
  result.spacing = found.spacing;
  result.order_in_box = found.order_in_box;
  return result;
}

template <class ConcurrencyTag, class Source, class Points, class Target, class Target_points, class Parameters>
Registration_of_functions_3 registration_of(const Source& source, const Points& source_points, const Target& target,
                                            const Target_points& target_points, const Parameters& parameters) {
  const auto function = Any_function_3::make(source), target_function = Any_function_3::make(target);
  Refined_surface_3 from = {{function, vectors_of(source_points)}, function};
  Refined_surface_3 to = {{target_function, vectors_of(target_points)}, target_function};
  if constexpr (has_parameter<Refined_functions_tag, Parameters>) {
    const auto& [refined_source, refined_target] = given_parameter<Refined_functions_tag>(parameters);
    from.refined = Any_function_3::make(refined_source);
    to.refined = Any_function_3::make(refined_target);
  }
  return registration_of_functions(runs_in_threads<ConcurrencyTag>(), from, to, registration_request(parameters));
}

} // namespace equiaffine::internal

#endif
