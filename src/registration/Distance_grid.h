// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_DISTANCE_GRID_H
#define EQUIAFFINE_SRC_REGISTRATION_DISTANCE_GRID_H

#include "registration/Surface_distances.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// The distances from a surface at the nodes of a cube around the origin, interpolated linearly between them: fast and
/// good to about a third of a step, which is what a search for rotations needs.
class Distance_grid {
public:
  static Distance_grid of(bool in_threads, const Surface_distances& distances, double radius) {
    Distance_grid grid(radius);
    parallel_for(in_threads, 0, nodes * nodes, [&](std::size_t row) {
      for (std::size_t i = 0; i < nodes; ++i) {
        const Eigen::Vector3d p = Eigen::Vector3d(double(i), double(row % nodes), double(row / nodes)) / grid.scale_;
        grid.values_[row * nodes + i] = float(distances.about(p - Eigen::Vector3d::Constant(radius)));
      }
    });
    return grid;
  }

  double step() const { return 1 / scale_; }

  double operator()(const Eigen::Vector3d& p) const {
    std::size_t cell[3];
    float part[3];
    for (int a = 0; a < 3; ++a) {
      const double x = std::clamp((p[a] + radius_) * scale_, 0.0, double(nodes - 1) - 1e-6);
      cell[a] = std::size_t(x);
      part[a] = float(x - double(cell[a]));
    }
    const float* v = &values_[(cell[2] * nodes + cell[1]) * nodes + cell[0]];
    const auto along_x = [&](const float* w) { return w[0] + part[0] * (w[1] - w[0]); };
    const auto in_plane = [&](const float* w) {
      const float a = along_x(w), b = along_x(w + nodes);
      return a + part[1] * (b - a);
    };
    const float low = in_plane(v), high = in_plane(v + nodes * nodes);
    return double(low + part[2] * (high - low));
  }

private:
  static constexpr std::size_t nodes = 64;

  explicit Distance_grid(double radius)
      : radius_(radius), scale_(double(nodes - 1) / (2 * radius)), values_(nodes * nodes * nodes) {}

  double radius_, scale_;
  std::vector<float> values_;
};

} // namespace equiaffine::internal

#endif
