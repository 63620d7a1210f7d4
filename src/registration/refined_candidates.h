// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_REFINED_CANDIDATES_H
#define EQUIAFFINE_SRC_REGISTRATION_REFINED_CANDIDATES_H

#include "registration/Centered_map.h"
#include "registration/Rotation_search.h"
#include "registration/without_near.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Maps that differ by less than this are the same one.
constexpr double same_map = 0.03;

constexpr std::size_t points_of_rms = 1500;

/// Returns the maps below an rms, by their rms, without those that are the same as better ones.
inline std::vector<Centered_map> different(std::vector<Centered_map> maps, double greatest_rms) {
  std::stable_sort(maps.begin(), maps.end(),
                   [](const Centered_map& a, const Centered_map& b) { return a.rms < b.rms; });
  std::erase_if(maps, [&](const Centered_map& map) { return !(map.rms < greatest_rms); });
  return without_near(maps, maps.size(),
                      [](const Centered_map& a, const Centered_map& b) { return difference(a, b) < same_map; });
}

/// A map refined by least squares, judged by many points. A map between meshes keeps the centroid if it is as good then.
inline Centered_map refined_and_judged(const Centered_pair& surfaces, const Affine_map_3& map, Map_kind kind) {
  const auto refined_map = [&](const Affine_map_3& m, bool keeps_center) {
    const Centered_refinement how = {.kind = kind, .most_steps = 10, .points = 300, .keeps_center = keeps_center};
    return judged(surfaces, refined(surfaces, m, how), points_of_rms);
  };
  const Centered_map first = refined_map(map, surfaces.is_mesh_itself());
  if (surfaces.is_mesh_itself() || !surfaces.are_meshes()) return first;
  const Centered_map fixed = refined_map({first.map.matrix}, true);
  const double rounding = exact_distance(std::max(surfaces.source.rounding, surfaces.target.rounding));
  return fixed.rms <= first.rms + rounding ? fixed : first;
}

/// Maps that were refined.
struct Refined_maps {
  std::vector<Centered_map> maps; ///< the different ones, by their rms
  /// The least rms of a map that was given up since there were too many: about the rms that it would have.
  double least_left_out = std::numeric_limits<double>::infinity();

  void keep(std::size_t most) {
    if (maps.size() <= most) return;
    least_left_out = std::min(least_left_out, maps[most].rms);
    maps.resize(most);
  }
};

/// Returns what rotations, times a `scale`, become by refinement, below an rms. A few steps with a few points decide
/// which of them are worth more, the best few hundreds of them unless all are asked for.
inline Refined_maps refined_candidates(bool in_threads, const Centered_pair& surfaces,
                                       const std::vector<Rotation_candidate>& rotations, double scale, Map_kind kind,
                                       double greatest_rms, bool are_all_asked_for = false) {
  constexpr std::size_t most_after_first = 600, most_after_second = 250;
  Refined_maps result;
  auto& maps = result.maps;
  for (const Rotation_candidate& rotation : rotations) maps.push_back({{scale * rotation.matrix}});
  const auto refine = [&](int steps, std::size_t points, double gate) {
    const Centered_refinement how = {
        .kind = Map_kind::RIGID, .most_steps = steps, .points = points, .keeps_center = surfaces.is_mesh_itself()};
    parallel_for(in_threads, 0, maps.size(),
                 [&](std::size_t i) { maps[i] = judged(surfaces, refined(surfaces, maps[i].map, how), points); });
    maps = different(std::move(maps), gate);
  };
  refine(3, 40, 2 * greatest_rms);
  if (!are_all_asked_for) result.keep(most_after_first);
  refine(6, 100, greatest_rms);
  if (!are_all_asked_for) result.keep(most_after_second);
  parallel_for(in_threads, 0, maps.size(),
               [&](std::size_t i) { maps[i] = refined_and_judged(surfaces, maps[i].map, kind); });
  maps = different(std::move(maps), greatest_rms);
  return result;
}

} // namespace equiaffine::internal

#endif
