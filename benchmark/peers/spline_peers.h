// SPDX-License-Identifier: GPL-3.0-or-later
// Values and derivatives of a B-spline of degree 5 by other libraries, at points in lattice coordinates. Each library
// has a separate translation unit.
#ifndef EQUIAFFINE_BENCHMARK_SPLINE_PEERS_H
#define EQUIAFFINE_BENCHMARK_SPLINE_PEERS_H

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

using Lattice_points = std::vector<std::array<double, 3>>;

/// Evaluates at all points; returns a number that depends on every result.
using Spline_evaluation = std::function<double(const Lattice_points&)>;

/// Teem's gage: value, gradient and Hessian. The samples are used as coefficients.
Spline_evaluation gage_spline(const std::vector<double>& samples, std::size_t nodes_per_axis);

/// ITK's BSplineInterpolateImageFunction: value and gradient.
Spline_evaluation itk_spline(const std::vector<double>& samples, std::size_t nodes_per_axis);

#endif
