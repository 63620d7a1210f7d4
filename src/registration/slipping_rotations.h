// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_SLIPPING_ROTATIONS_H
#define EQUIAFFINE_SRC_REGISTRATION_SLIPPING_ROTATIONS_H

#include "registration/Centered_map.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/Affine_slippage_3.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// An axis about which a surface turns with little change, judged by rotations of finite angles: small ones would find
/// that a fine gear turns, too.
struct Slipping_rotation {
  Infinitesimal_map_3 generator; ///< in the coordinates of the Centered_surface_3
  double rms;                    ///< the largest of the rotations
  double own_rms;                ///< the same in the proportions of the surface
};

/// The axis of the rotation that a map nearly is, by the part of it that is antisymmetric.
inline Eigen::Vector3d axis_of(const Eigen::Matrix3d& m) {
  return Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)).normalized();
}

/// Returns three axes about which rotations move points away from the surface least, or in proportion, by their rms. The
/// rotations of a mesh keep its centroid, which is exact, and are about an axis that was refined once: refinement of each
/// would fit them to the facets.
inline std::vector<Slipping_rotation> slipping_rotations(bool in_threads, const Centered_surface_3& surface,
                                                         Map_kind kind) {
  constexpr std::array<double, 4> angles = {1.0, 0.381966, 1.618034, 2.618034};
  constexpr std::size_t points = 3000;
  constexpr double greatest_change = 0.1;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  const auto& samples = surface.samples;
  for (std::size_t i = 0; i < std::min(points, samples.points.size()); ++i) {
    const Eigen::Vector3d moment = samples.points[i].cross(samples.normals[i]);
    squares += moment * moment.transpose();
  }
  const Centered_pair itself(surface);
  const bool is_mesh = itself.is_mesh_itself();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors();
  // A rotation about an axis, changed by refinement, or as it is where it was drawn to a symmetry nearby.
  const auto refined_rotation = [&](double angle, const Eigen::Vector3d& axis) -> Affine_map_3 {
    const Affine_map_3 rotation = {Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
    const Affine_map_3 map = refined(itself, rotation, {kind, 8, 400, axis, is_mesh});
    return difference(map.matrix, rotation.matrix) < greatest_change ? map : rotation;
  };
  if (is_mesh)
    parallel_for(in_threads, 0, 3, [&](std::size_t i) {
      const Eigen::Vector3d axis = axes.col(Eigen::Index(i));
      axes.col(Eigen::Index(i)) = axis_of(refined_rotation(angles[0], axis).matrix);
    });
  std::array<Centered_map, 3 * angles.size()> maps;
  std::array<double, maps.size()> own;
  parallel_for(in_threads, 0, maps.size(), [&](std::size_t i) {
    const Eigen::Vector3d axis = axes.col(Eigen::Index(i / angles.size()));
    const double angle = angles[i % angles.size()];
    const Affine_map_3 rotation = {Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
    maps[i] = judged(itself, is_mesh ? rotation : refined_rotation(angle, axis), points);
    own[i] = own_rms(itself, maps[i].map, points, maps[i].rms);
  });
  std::vector<Slipping_rotation> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Slipping_rotation slipping = {};
    for (std::size_t k = axis * angles.size(); k < (axis + 1) * angles.size(); ++k) {
      slipping.rms = std::max(slipping.rms, maps[k].rms);
      slipping.own_rms = std::max(slipping.own_rms, own[k]);
    }
    const Affine_map_3 turn = maps[axis * angles.size()].map, back = turn.inverse();
    const double sine = std::sin(angles[0]);
    slipping.generator.matrix = (turn.matrix - back.matrix) / (2 * sine);
    // The points that the rotation fixes are those that its generator does not move.
    slipping.generator.translation = (turn.translation - back.translation) / (2 * sine);
    result.push_back(slipping);
  }
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.rms < b.rms; });
  return result;
}

/// Whether rotations of a mesh move no point further off it than facets are off the surface that they stand for, or than
/// `rounding`. A part that is not one of revolution moves further, and the rms may not tell.
inline bool keeps_to_facets(bool in_threads, const Centered_surface_3& surface, const Slipping_rotation& rotation,
                            double rounding) {
  constexpr std::array<double, 3> angles = {0.381966, 1.618034, 2.618034};
  constexpr std::size_t points = 20000;
  constexpr double factor = 3; // that of regular triangles on a sphere is 8 / 3
  const Eigen::Vector3d axis = axis_of(rotation.generator.matrix);
  std::array<double, angles.size()> greatest;
  parallel_for(in_threads, 0, angles.size(), [&](std::size_t i) {
    const Affine_map_3 map = {Eigen::AngleAxisd(angles[i], axis).toRotationMatrix()};
    greatest[i] = distances_of_moved(surface, map, points).greatest;
  });
  return *std::max_element(greatest.begin(), greatest.end()) < rounding + factor * surface.samples.greatest_facet_error;
}

/// The generators, in the coordinates of the surface, of the rotations whose rms is below a limit. Rotations about two
/// axes generate those about a third one, so that two that are small alone are less than what they would have to be.
inline Affine_slippage_3 continuous_symmetries(const Centered_surface_3& surface,
                                               const std::vector<Slipping_rotation>& rotations, double greatest_rms) {
  auto count = std::count_if(rotations.begin(), rotations.end(),
                             [&](const Slipping_rotation& r) { return r.rms < greatest_rms; });
  if (count == 2) count = 1;
  if (count == 0) return {};
  const Affine_map_3& to = surface.map;
  const Eigen::Matrix3d from = to.matrix.inverse();
  Affine_slippage_3 result;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Infinitesimal_map_3& generator = rotations[std::size_t(i)].generator;
    result.rms = std::max(result.rms, rotations[std::size_t(i)].own_rms);
    result.generators.push_back(
        {from * generator.matrix * to.matrix, from * (generator.matrix * to.translation + generator.translation)});
  }
  return result;
}

} // namespace equiaffine::internal

#endif
