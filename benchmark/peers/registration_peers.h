// SPDX-License-Identifier: GPL-3.0-or-later
// How points are registered by affine maps without affine frames, in few lines each.
#ifndef EQUIAFFINE_BENCHMARK_REGISTRATION_PEERS_H
#define EQUIAFFINE_BENCHMARK_REGISTRATION_PEERS_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

using Vectors = std::vector<Eigen::Vector3d>;
using Signatures = std::vector<Eigen::Matrix<double, 5, 1>>;

/// Iterated closest points with affine maps by least squares, from the given number of starts: the first one moves
/// the mean and the size of the points alone, the others rotate, or reflect, too. The best map is that with the least
/// median distance.
Eigen::Affine3d affine_icp(const Vectors& source, const Vectors& target, int starts);

/// Makes the covariances of both surfaces 1, whereupon an orthogonal map is left. The 20 best of random ones are refined
/// by iterated closest points.
Eigen::Affine3d whitening_with_rotations(const Vectors& source, const Vectors& target, int rotations);

/// Matches each point with that of the nearest signature. The map of four random matches that has most matches within
/// a hundredth of the size of the target is refined by iterated closest points.
Eigen::Affine3d four_point_ransac(const Vectors& source, const Signatures& signatures, const Vectors& target,
                                  const Signatures& target_signatures, int samples);

#endif
