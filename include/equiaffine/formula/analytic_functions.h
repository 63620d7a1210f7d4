// SPDX-License-Identifier: GPL-3.0-or-later
// Well-known surfaces {f = 0} as functors f for Analytic_function_traits_3, callable with any number type. Parameters
// and expressions of parameters are doubles, so that every number type evaluates the same function. Intermediate
// results are `auto`, so that jets omit derivatives that are zero by structure.
#ifndef EQUIAFFINE_FORMULA_ANALYTIC_FUNCTIONS_H
#define EQUIAFFINE_FORMULA_ANALYTIC_FUNCTIONS_H

#include <equiaffine/base/internal/compiler.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace equiaffine::internal {

/// The box centered at the origin with the given half sides.
inline CGAL::Bbox_3 centered_box(double x, double y, double z) { return CGAL::Bbox_3(-x, -y, -z, x, y, z); }

/// The cube centered at the origin with the given half side.
inline CGAL::Bbox_3 centered_cube(double half_side) { return centered_box(half_side, half_side, half_side); }

} // namespace equiaffine::internal

namespace equiaffine {

/// Every struct has `f(x, y, z)` and `box()`. The box contains a closed surface with a margin, or an interesting part
/// of an unbounded surface. Parameters are positive, in the unit of x, y, z unless noted otherwise.
namespace analytic_functions {

/// The square of a number. Jets and intervals have better overloads, found by argument-dependent lookup.
template <class T>
auto square(const T& x) {
  return x * x;
}

/// x^2 + y^2 + z^2 - r^2. K = r^-3, H = -r^(-3/2), J = 0.
struct Sphere {
  double radius = 1; ///< r

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    return square(x) + square(y) + square(z) - radius * radius;
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1.25 * radius); } ///< the box to look at
};

/// (x/a)^2 + (y/b)^2 + (z/c)^2 - 1. K = 1 / (a b c), H = -(a b c)^(-1/2), J = 0.
struct Ellipsoid {
  double a = 1.5, ///< the semi-axis along x
      b = 1,      ///< the semi-axis along y
      c = 0.5;    ///< the semi-axis along z

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    return square(x / a) + square(y / b) + square(z / c) - 1.0;
  }
  CGAL::Bbox_3 box() const { return internal::centered_box(1.25 * a, 1.25 * b, 1.25 * c); } ///< the box to look at
};

/// z - (x^2 + y^2) / 2. K = H = J = 0: an improper affine sphere with constant affine normal (Andrade, Lewiner 2012,
/// figure 4).
struct Elliptic_paraboloid {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const { return z - (square(x) + square(y)) * 0.5; }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1); } ///< the box to look at
};

/// z - (x^2 - y^2) / 2. K = H = J = 0 and the affine normal is constant, like Elliptic_paraboloid.
struct Hyperbolic_paraboloid {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const { return z - (square(x) - square(y)) * 0.5; }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1); } ///< the box to look at
};

/// x^2 + y^2 - z^2 - 1. K = 1, H = -1, J = 0.
struct Hyperboloid_of_one_sheet {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const { return square(x) + square(y) - square(z) - 1.0; }
  CGAL::Bbox_3 box() const { return internal::centered_cube(2); } ///< the box to look at
};

/// z^2 - x^2 - y^2 - 1. K = 1, H = -1, J = 0.
struct Hyperboloid_of_two_sheets {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const { return square(z) - square(x) - square(y) - 1.0; }
  CGAL::Bbox_3 box() const { return internal::centered_cube(2); } ///< the box to look at
};

/// (sqrt(x^2 + y^2) - R)^2 + z^2 - r^2, not differentiable on the z-axis. Andrade, Lewiner 2012, figure 11, whose
/// formula lacks r.
struct Torus {
  double major_radius = 0.5, ///< R
      minor_radius = 0.2;    ///< r

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::sqrt;
    return square(sqrt(square(x) + square(y)) - major_radius) + square(z) - minor_radius * minor_radius;
  }
  /// The box to look at.
  CGAL::Bbox_3 box() const {
    const double side = major_radius + 1.25 * minor_radius;
    return internal::centered_box(side, side, 1.25 * minor_radius);
  }
};

/// (3x)^4 + (3y)^4 + (3z)^4 - 45 x^2 - 45 y^2 - 45 z^2 + 6: a sphere-like surface inside a cube-like one. Andrade,
/// Lewiner 2012, figure 3.
struct Blobby {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto term = [](const auto& t) {
      const auto t2 = square(t);
      return 81.0 * square(t2) - 45.0 * t2;
    };
    return term(x) + term(y) + term(z) + 6.0;
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1); } ///< the box to look at
};

/// 2 z^2 - sin(5 x + 3 y^2 - 1). Andrade, Lewiner 2012, figure 9.
struct Sine_surface {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::sin;
    return 2.0 * square(z) - sin(5.0 * x + 3.0 * square(y) - 1.0);
  }
  CGAL::Bbox_3 box() const { return CGAL::Bbox_3(-1.1, -1.1, -2, 1, 1.2, 2); } ///< the box to look at
};

/// x^4 - 5 x^2 + y^4 - 5 y^2 + z^4 - 5 z^2 + 11.8: a closed surface of genus 5. Banchoff: Computer graphics tools for
/// rendering algebraic surfaces and for geometry of order, 1991.
struct Tanglecube {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto term = [](const auto& t) {
      const auto t2 = square(t);
      return square(t2) - 5.0 * t2;
    };
    return term(x) + term(y) + term(z) + 11.8;
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(3); } ///< the box to look at
};

/// sin x cos y + sin y cos z + sin z cos x, close to the minimal surface of Schoen: Infinite periodic minimal surfaces
/// without self-intersections, 1970. The period is 2 pi; the box is one period cell.
struct Gyroid {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::cos;
    using std::sin;
    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(std::numbers::pi); } ///< the box to look at
};

/// 2 y (y^2 - 3 x^2) (1 - z^2) + (x^2 + y^2)^2 - (9 z^2 - 1) (1 - z^2): a closed surface of genus 2, with other sheets
/// outside the box. Palais: The visualization of mathematics, 1999.
struct Genus_two {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto x2 = square(x);
    const auto y2 = square(y);
    const auto z2 = square(z);
    return 2.0 * (y * (y2 - 3.0 * x2) * (1.0 - z2)) + square(x2 + y2) - (9.0 * z2 - 1.0) * (1.0 - z2);
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(2); } ///< the box to look at
};

/// The union of a ball of radius R centered at the origin and a smaller one: min(|p|^2 - R^2, |p - c|^2 - r^2).
struct Two_spheres {
  double radius = 1;                              ///< R
  std::array<double, 3> center = {1.3, 0.2, 0.1}; ///< c
  double small_radius = 0.1;                      ///< r

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::min;
    return min(square(x) + square(y) + square(z) - radius * radius,
               square(x - center[0]) + square(y - center[1]) + square(z - center[2]) - small_radius * small_radius);
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(2 * radius); } ///< the box to look at
};

/// t - sum of exp(-|p - c_i|^2 / s^2) over eight centers c_i: transcendental, positive outside, without symmetry.
/// Blinn: A generalization of algebraic surface drawing, 1982.
struct Metaballs {
  /// The centers c_i.
  std::array<std::array<double, 3>, 8> centers = {{{-0.55, -0.45, -0.5},
                                                   {0.5, -0.55, -0.4},
                                                   {-0.45, 0.5, -0.55},
                                                   {0.6, 0.45, -0.5},
                                                   {-0.5, -0.6, 0.45},
                                                   {0.45, -0.5, 0.55},
                                                   {-0.6, 0.55, 0.5},
                                                   {0.55, 0.6, 0.6}}};
  double size = 0.5;      ///< s
  double threshold = 0.4; ///< t, dimensionless

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto ball = [&](const std::array<double, 3>& c) {
      using std::exp;
      return exp((square(x - c[0]) + square(y - c[1]) + square(z - c[2])) * (-1.0 / (size * size)));
    };
    return [&]<std::size_t... I>(std::index_sequence<I...>) { return threshold - (ball(centers[I]) + ...); }
    (std::make_index_sequence<8>());
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1.5); } ///< the box to look at
};

/// x^2 + y^2 + z^2 - 2 x y z - 1: Cayley's cubic, with four nodes at (1, 1, 1), (1, -1, -1), (-1, 1, -1) and (-1, -1,
/// 1). The closed part between them bounds the 3 x 3 correlation matrices (Laurent, Poljak: On a positive semidefinite
/// relaxation of the cut polytope, 1995).
struct Cayley_cubic {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    return square(x) + square(y) + square(z) - 2.0 * (x * y * z) - 1.0;
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1.75); } ///< the box to look at
};

/// T(x) + T(y) + T(z) with the Chebyshev polynomial T(t) = 32 t^6 - 48 t^4 + 18 t^2 - 1: closed and smooth. Banchoff
/// 1991, after Chmutov: Examples of projective surfaces with many singularities, 1992.
struct Chmutov_sextic {
  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto chebyshev = [](const auto& t) {
      const auto t2 = square(t);
      return ((32.0 * t2 - 48.0) * t2 + 18.0) * t2 - 1.0;
    };
    return chebyshev(x) + chebyshev(y) + chebyshev(z);
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(1.1); } ///< the box to look at
};

/// 4 (g^2 x^2 - y^2) (g^2 y^2 - z^2) (g^2 z^2 - x^2) - (1 + 2 g) (x^2 + y^2 + z^2 - 1)^2 + c with the golden ratio g.
/// If c = 0, the surface has 65 nodes, 15 of them at infinity; one is (1, 0, 0). A small c > 0 opens them, which makes
/// the surface smooth and connected. Barth: Two projective surfaces with many nodes, admitting the symmetries of the
/// icosahedron, 1996.
struct Barth_sextic {
  double c = 0; ///< the constant term

  /// f(x, y, z).
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    constexpr double g = std::numbers::phi, g2 = g * g;
    const auto x2 = square(x);
    const auto y2 = square(y);
    const auto z2 = square(z);
    return 4.0 * ((g2 * x2 - y2) * (g2 * y2 - z2) * (g2 * z2 - x2)) - (1.0 + 2.0 * g) * square(x2 + y2 + z2 - 1.0) + c;
  }
  CGAL::Bbox_3 box() const { return internal::centered_cube(2); } ///< the box to look at
};

} // namespace analytic_functions

} // namespace equiaffine

#endif
