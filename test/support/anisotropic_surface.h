// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces whose curvatures differ by orders of magnitude: 100 x^2 + y^2 + 0.01 z^2 + 0.05 sin(3xyz) = 1, and a surface
// stretched by a given factor.
#ifndef EQUIAFFINE_TEST_SUPPORT_ANISOTROPIC_SURFACE_H
#define EQUIAFFINE_TEST_SUPPORT_ANISOTROPIC_SURFACE_H

#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

struct Anisotropic_surface {
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::sin;
    return 100 * x * x + y * y + 0.01 * z * z + 0.05 * sin(3 * x * y * z) - 1;
  }

  using Kernel = CGAL::Simple_cartesian<double>;
  auto traits() const { return equiaffine::make_analytic_traits<Kernel>(*this, CGAL::Bbox_3(-1, -2, -20, 1, 2, 20)); }

  /// Points distributed like points on a sphere.
  std::vector<Kernel::Point_3> points(std::size_t n) const {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<Kernel::Point_3> result;
    while (result.size() < n) {
      const double u = normal(random), v = normal(random), w = normal(random), r = 1 / std::hypot(u, v, w);
      result.push_back(
          equiaffine::project_to_surface(traits(), Kernel::Point_3(0.1 * u * r, v * r, 10 * w * r), 1.0).point);
    }
    return result;
  }
};

/// The surface of s = 1 with x divided and z multiplied by s: an affine map of determinant 1.
struct Stretched_surface {
  double s;

  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto X = s * x;
    const auto Z = z / s;
    return X * X + y * y + Z * Z + 0.3 * (x * y * z) + 0.2 * (Z * Z * Z) + 0.1 * (X * X * X * X);
  }

  /// Points on level sets near 1, distributed like points on the sphere before it is stretched.
  std::vector<std::array<double, 3>> points(std::size_t n) const {
    std::mt19937 random(23);
    std::normal_distribution<double> normal;
    std::vector<std::array<double, 3>> result;
    while (result.size() < n) {
      const double u = normal(random), v = normal(random), w = normal(random), r = 1 / std::hypot(u, v, w);
      result.push_back({u * r / s, v * r, w * r * s});
    }
    return result;
  }
};

#endif
