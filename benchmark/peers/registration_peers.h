// SPDX-License-Identifier: GPL-3.0-or-later
// Short implementations of methods that register points by affine maps without affine frames.
#ifndef EQUIAFFINE_BENCHMARK_REGISTRATION_PEERS_H
#define EQUIAFFINE_BENCHMARK_REGISTRATION_PEERS_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

using Vectors = std::vector<Eigen::Vector3d>;
using Signatures = std::vector<Eigen::Matrix<double, 5, 1>>;

/// Iterative closest points with least-squares affine maps from the given number of starts. The first start matches
/// only the mean and the size of the points; the others also rotate or reflect them. Returns the map with the smallest
/// median distance.
Eigen::Affine3d affine_icp(const Vectors& source, const Vectors& target, int starts);

/// Normalizes the covariances of both surfaces to 1, so that an orthogonal map remains. The 20 best of random
/// orthogonal maps are refined by iterative closest points.
Eigen::Affine3d whitening_with_rotations(const Vectors& source, const Vectors& target, int rotations);

/// Matches each point with that of the nearest signature. Of the maps of four random matches, the one with the most
/// matches within a hundredth of the size of the target is refined by iterative closest points.
Eigen::Affine3d four_point_ransac(const Vectors& source, const Signatures& signatures, const Vectors& target,
                                  const Signatures& target_signatures, int samples);

#endif
