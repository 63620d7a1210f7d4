// SPDX-License-Identifier: GPL-3.0-or-later
// Other libraries' values and derivatives of a B-spline of degree 5 at points of a grid, in lattice coordinates. Each
// library has a translation unit of its own.
#ifndef EQUIAFFINE_BENCHMARK_SPLINE_PEERS_H
#define EQUIAFFINE_BENCHMARK_SPLINE_PEERS_H

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

using Lattice_points = std::vector<std::array<double, 3>>;

/// Evaluates at all points; gives something that depends on every result.
using Spline_evaluation = std::function<double(const Lattice_points&)>;

/// Teem's gage: value, gradient and Hessian, the samples being the coefficients.
Spline_evaluation gage_spline(const std::vector<double>& samples, std::size_t nodes_per_axis);

/// ITK's BSplineInterpolateImageFunction: value and gradient.
Spline_evaluation itk_spline(const std::vector<double>& samples, std::size_t nodes_per_axis);

#endif
