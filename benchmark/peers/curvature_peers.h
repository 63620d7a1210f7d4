// SPDX-License-Identifier: GPL-3.0-or-later
// Euclidean curvatures of meshes and points estimated by other libraries, each in a separate translation unit.
#ifndef EQUIAFFINE_BENCHMARK_CURVATURE_PEERS_H
#define EQUIAFFINE_BENCHMARK_CURVATURE_PEERS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

struct Plain_mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Mean and Gaussian curvature at each vertex. The sign of the mean curvature is not specified.
struct Euclidean_curvatures {
  std::vector<double> mean, gaussian;
};

/// CGAL 6's interpolated corrected curvatures over balls of the given radius, or over the adjacent triangles for 0.
Euclidean_curvatures corrected_curvatures(const Plain_mesh& mesh, double radius);

/// PCL's moving least squares with polynomials of the given degree over balls of the given radius.
Euclidean_curvatures moving_least_squares(const Plain_mesh& mesh, double radius, int degree);

#endif
