// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of functions at points, and random functions.
#ifndef EQUIAFFINE_TEST_GEOMETRY_RANDOM_SURFACES_H
#define EQUIAFFINE_TEST_GEOMETRY_RANDOM_SURFACES_H

#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace random_surfaces {

using namespace equiaffine;
using Jet = Jet_3<double>;
using Vector = std::array<double, 3>;

template <class Function>
Jet expand(const Function& f, const Vector& p) {
  return equiaffine::expand<4, double>(f, p[0], p[1], p[2]);
}

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector times(double s, const Vector& v) { return {s * v[0], s * v[1], s * v[2]}; }
inline double distance(const Vector& a, const Vector& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
inline double relative_difference(const Vector& a, const Vector& b) { return distance(a, b) / std::sqrt(dot(b, b)); }

/// S = |K| + H^2 + |K_e|^(3/2): errors of K are parts of S, those of H and J parts of sqrt(S).
inline double scale(const Local_structure_3<double>& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature +
         std::pow(std::abs(s.euclidean.gaussian_curvature), 1.5);
}

// A polynomial of degree 5 with all terms and a random gradient: nothing about it is special.
struct Random_surface {
  std::array<double, 56> c;

  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    T sum(0.0);
    std::size_t n = 0;
    T xi(1.0);
    for (int i = 0; i <= 5; ++i, xi = xi * x) {
      T yj(1.0);
      for (int j = 0; i + j <= 5; ++j, yj = yj * y) {
        T zk(1.0);
        for (int k = 0; i + j + k <= 5; ++k, zk = zk * z) sum = sum + c[n++] * xi * yj * zk;
      }
    }
    return sum;
  }
};

template <class Visitor>
void for_random_surfaces(Visitor visit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  int regular = 0;
  for (int n = 0; n < 200; ++n) {
    Random_surface f;
    for (double& c : f.c) c = unit(random);
    const Vector p = {unit(random), unit(random), unit(random)};
    // Not near the parabolic curve nor a singular point, where the quantities themselves are ill-conditioned.
    const auto s = local_structure(expand(f, p));
    if (s.status != Point_status::REGULAR || std::abs(s.euclidean.gaussian_curvature) < 0.1) continue;
    ++regular;
    visit(f, p, s, random);
  }
  EXPECT_GT(regular, 100);
}

} // namespace random_surfaces

#endif
