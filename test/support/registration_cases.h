// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces in general position, with random maps and points, for tests and benchmarks of registration.
#ifndef EQUIAFFINE_TEST_SUPPORT_REGISTRATION_CASES_H
#define EQUIAFFINE_TEST_SUPPORT_REGISTRATION_CASES_H

#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>

#include <CGAL/Simple_cartesian.h>
#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace registration_cases {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Map = Kernel::Aff_transformation_3;
using Formula = equiaffine::Analytic_function_traits_3<Kernel, equiaffine::Expression_3>;
using Image = equiaffine::Transformed_function_traits_3<Formula>;

struct Surface {
  std::string name, formula;
  CGAL::Bbox_3 box;

  Formula traits() const { return Formula(equiaffine::Expression_3(formula), box); }
};

/// Random numbers for formulas and maps, the same with every compiler.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) { engine_.discard(10); }

  double uniform(double from, double to) { return from + (to - from) * double(engine_() - 1) / 2147483646.; }
  double normal() { return std::sqrt(-2 * std::log(uniform(1e-9, 1))) * std::cos(uniform(0, 6.283185307179586)); }

private:
  std::minstd_rand engine_;
};

/// A sum of `count` waves of the given amplitude.
inline std::string waves(unsigned seed, int count, double amplitude, double frequency = 2.2) {
  Random random(seed);
  std::ostringstream text;
  for (int n = 0; n < count; ++n) {
    text << " + " << amplitude * random.uniform(0.5, 1) << "*sin(";
    for (const char* variable : {"x", "y", "z"})
      text << "(" << frequency * random.normal() << ")*" << variable << " + ";
    text << random.uniform(0, 6.28) << ")";
  }
  return text.str();
}

inline std::string blobs(unsigned seed, int count, double level, double spread) {
  Random random(seed);
  std::ostringstream text;
  text << level;
  for (int n = 0; n < count; ++n) {
    text << " - " << random.uniform(0.6, 1.2) << "*exp(-";
    text << random.uniform(2.5, 6) << "*(0";
    for (const char* variable : {"x", "y", "z"})
      text << " + " << random.uniform(0.6, 1.8) << "*(" << variable << " - (" << random.uniform(-spread, spread)
           << "))^2";
    text << " + " << random.uniform(-0.3, 0.3) << "*x*y + " << random.uniform(-0.3, 0.3) << "*y*z))";
  }
  return text.str();
}

inline CGAL::Bbox_3 cube(double r) { return CGAL::Bbox_3(-r, -r, -r, r, r, r); }

/// Twelve surfaces without any symmetry.
inline std::vector<Surface> generic_surfaces() {
  return {
      {"quartic",
       "x^4+y^4+z^4-1+.31*x^3-.22*x^2*y+.13*x^2*z+.27*x*y^2-.35*x*y*z+.18*x*z^2+.2*y^3-.11*y^2*z+.24*y*z^2-.3*z^3"
       "+.1*x^3*y-.14*x*y^3+.08*y^2*z^2+.12*x^2*y*z",
       cube(1.8)},
      {"blobs5", blobs(3, 5, 0.3, 0.7), cube(1.7)},
      {"blobs8", blobs(5, 8, 0.35, 0.8), cube(1.8)},
      {"waves", "0.1" + waves(11, 6, 1), cube(1.2)},
      {"ellipsoid+", "x^2+2*y^2+4*z^2-1" + waves(13, 4, 0.15), cube(1.5)},
      {"torus+", "(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)" + waves(17, 4, 0.12), cube(1.8)},
      {"gyroid+", "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)" + waves(19, 3, 0.08), cube(2.2)},
      {"tangle+", "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8" + waves(23, 4, 0.6, 1.3), cube(3)},
      {"graph", "z-(.5*x^2+.35*y^2+.31*x^3-.27*x^2*y+.2*x*y^2+.24*y^3+.1*x^4-.13*x^3*y+.17*x^2*y^2+.09*y^4)",
       CGAL::Bbox_3(-1, -1, -.6, 1, 1, 1.6)},
      {"heart+", "(x^2+1.8*y^2+z^2-1)^3-.8*x^2*z^3-.1*y^2*z^3" + waves(31, 4, 0.06), cube(1.6)},
      {"genus2+", "(x^2*(1-x^2)-y^2)^2+.5*z^2-.03" + waves(37, 4, 0.006, 2.8), CGAL::Bbox_3(-1.4, -1, -.6, 1.4, 1, .6)},
      {"sextic", "x^6+1.5*y^6+.7*z^6+.8*x^2*y^2-1" + waves(41, 5, 0.1), cube(1.5)}};
}

inline Eigen::Matrix3d random_rotation(Random& random) {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = random.normal();
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

inline Map map_of(const Eigen::Matrix3d& m, const Eigen::Vector3d& t) {
  return Map(m(0, 0), m(0, 1), m(0, 2), t[0], m(1, 0), m(1, 1), m(1, 2), t[1], m(2, 0), m(2, 1), m(2, 2), t[2]);
}

inline Eigen::Matrix3d matrix_of(const Map& map) {
  return Eigen::Matrix3d::NullaryExpr([&](Eigen::Index i, Eigen::Index j) { return map.m(int(i), int(j)); });
}

/// A map with the given ratio of singular values and |det|; every second map is a reflection.
inline Map random_map(Random& random, double condition, double determinant) {
  const double middle = random.uniform(-0.5, 0.5), mean = middle / 3;
  const Eigen::Vector3d logs = std::log(condition) * Eigen::Vector3d(0.5 - mean, middle - mean, -0.5 - mean);
  Eigen::Vector3d values = logs.array().exp() * std::cbrt(determinant);
  if (random.uniform(0, 1) < 0.5) values[0] = -values[0];
  const Eigen::Matrix3d u = random_rotation(random), v = random_rotation(random);
  const Eigen::Vector3d translation(random.normal(), random.normal(), random.normal());
  return map_of(u * values.asDiagonal() * v, translation);
}

/// |A - B| / |B| of the matrices of two maps, in the Frobenius norm.
inline double error_of(const Map& found, const Map& truth) {
  return (matrix_of(found) - matrix_of(truth)).norm() / matrix_of(truth).norm();
}

} // namespace registration_cases

#endif
