// SPDX-License-Identifier: GPL-3.0-or-later
// Compares other methods to register points by affine maps with ours, on the same points.
#include "../peers/registration_peers.h"
#include "runs.h"
#include "support/registration_traits.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace registration_runs {
namespace {

/// The points that have a frame, with their signatures.
std::pair<Vectors, Signatures> signed_points(const internal::Framed_surface_3& surface) {
  std::pair<Vectors, Signatures> result;
  for (const auto& usable : surface.usable)
    for (const std::size_t i : usable) {
      result.first.push_back(surface.points[i].point);
      result.second.push_back(internal::kept_invariants(surface.points[i], Map_kind::AFFINE));
    }
  return result;
}

Map map_of(const Eigen::Affine3d& map) { return registration_cases::map_of(map.linear(), map.translation()); }

/// Runs all peers, and then our method, on pairs whose source is a part of the surface.
void compare_at_part(double part, int repeats) {
  constexpr double right = 0.05; // peers match points with points, which are not images of each other
  const std::vector<const char*> names = {"ICP_1_start", "ICP_20_starts", "whitening_2000_rotations",
                                          "four_points_20000_samples", "ours"};
  std::vector<double> hits(names.size(), 0), seconds(names.size(), 0);
  Random random(1000);
  double runs = 0;
  for (int r = 0; r < repeats; ++r)
    for (const Surface& s : generic_surfaces()) {
      const Formula function = s.traits();
      const Points all = points_on_surface(function, 32);
      const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      std::vector<double> heights;
      for (const Point_3& p : all) heights.push_back(n.dot(Eigen::Vector3d(p.x(), p.y(), p.z())));
      const Piece<Formula> piece{function, n, lower_quantile(heights, part)};
      const Points points = piece.points_of(all);
      const Map map = random_map(random, 10, random_determinant(random));
      const Image image(function, map);
      const Points image_points = points_on_surface(image, 35);
      const internal::Framed_function_3 from(Any_function_3::make(piece));
      const internal::Framed_function_3 to(Any_function_3::make(image));
      const Vectors vectors = internal::vectors_of(points), target = internal::vectors_of(image_points);
      const auto framed = internal::framed_surface(false, from, from, vectors, Map_kind::AFFINE);
      const auto framed_target = internal::framed_surface(false, to, to, target, Map_kind::AFFINE);
      const auto [places, signatures] = signed_points(framed);
      const auto [target_places, target_signatures] = signed_points(framed_target);
      const std::vector<std::function<Map()>> ways = {
          [&] { return map_of(affine_icp(vectors, target, 1)); },
          [&] { return map_of(affine_icp(vectors, target, 20)); },
          [&] { return map_of(whitening_with_rotations(vectors, target, 2000)); },
          [&, &places = places, &signatures = signatures, &target_places = target_places,
           &target_signatures = target_signatures] {
            return map_of(four_point_ransac(places, signatures, target_places, target_signatures, 20000));
          },
          [&] {
            const auto result = internal::registration_of_framed(false, framed, framed_target, {}, {}).result;
            return result.found() ? result.best().map : Map(CGAL::SCALING, 1e9);
          }};
      ++runs;
      for (std::size_t k = 0; k < ways.size(); ++k) {
        const double begin = processor_clock();
        hits[k] += error_of(ways[k](), map) < right;
        seconds[k] += processor_clock() - begin;
      }
    }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name =
        "registration_part_of_" + std::to_string(int(100 * part)) + "_percent_by_" + std::string(names[k]);
    figure(name, hits[k] / runs, "of runs", "none");
    figure(name + "_seconds", seconds[k] / runs, "s", "none");
  }
}

} // namespace

void compare_with_peers(int repeats) {
  for (const double part : {1., 0.7, 0.5, 0.3}) compare_at_part(part, repeats);
}

} // namespace registration_runs
