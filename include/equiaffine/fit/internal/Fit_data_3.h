// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_DATA_3_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_DATA_3_H

#include <equiaffine/fit/Normal_orientation.h>

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// The data of a fit, as a user gave them.
struct Fit_data_3 {
  enum class Kind {
    POINTS, ///< without polygons
    MESH,   ///< vertices and faces of a manifold
    SOUP    ///< polygons that may be anything
  };

  Kind kind;
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {}; ///< of positions of points
  std::vector<Eigen::Vector3d> normals = {};             ///< one for each point, or none if they are to be estimated
  Normal_orientation orientation = Normal_orientation::ORIENTED; ///< of the normals of points without polygons
  std::optional<double> feature_angle = {};                      ///< of creases between polygons, in degrees
};

} // namespace equiaffine::internal

#endif
