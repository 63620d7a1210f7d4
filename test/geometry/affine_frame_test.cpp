// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/geometry/affine_frame.h>
#include <equiaffine/number/Pack.h>
#include <equiaffine/surface/internal/affine_gradients.h>

#include <CGAL/Simple_cartesian.h>
#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace affine_frame_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Frame = Affine_frame_3<double>;

struct Wavy {
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::cos;
    using std::sin;
    return sin(1.3 * x + 0.4 * y) + cos(0.9 * y - 0.7 * z + 0.2) * x + sin(1.1 * z + 0.5 * x * y) + 0.3 * y * z;
  }
};
const auto wavy = make_analytic_traits<Kernel>(Wavy(), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));

template <class Traits>
Frame frame_at(const Traits& traits, const Point_3& p) {
  return affine_frame(local_structure(traits.taylor(p)).affine);
}

Eigen::Map<const Eigen::Vector3d> vector(const std::array<double, 3>& x) { return {x.data(), 3}; }

/// The columns e1, e2, xi.
Eigen::Matrix3d basis(const Frame& frame) {
  Eigen::Matrix3d m;
  m << vector(frame.e1), vector(frame.e2), vector(frame.xi);
  return m;
}

/// Points in general position, whose frames are determined well enough.
std::vector<Point_3> generic_points(std::size_t count, bool is_elliptic) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Point_3> points;
  while (points.size() < count) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    const Frame frame = frame_at(wavy, {x, y, z});
    if (frame.quality > 0.05 && frame.is_elliptic == is_elliptic) points.emplace_back(x, y, z);
  }
  return points;
}

Eigen::Matrix3d random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const Eigen::Matrix3d m = Eigen::Matrix3d::NullaryExpr([&] { return normal(random); });
    const auto values = m.jacobiSvd().singularValues();
    if (values[0] < 10 * values[2]) return m;
  }
}

Kernel::Aff_transformation_3 map_of(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), 0.3, m(1, 0), m(1, 1), m(1, 2), -0.2, m(2, 0), m(2, 1), m(2, 2), 0.7};
}

void expect_equal_signatures(const Frame& a, const Frame& b) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.signature[i], b.signature[i], 1e-10) << i;
  EXPECT_NEAR(a.quality, b.quality, 1e-10);
}

TEST(Affine_frame, one_pair_of_points_gives_the_map_reflections_included) {
  std::mt19937 random(1);
  int reflections = 0;
  for (const bool is_elliptic : {true, false})
    for (const Point_3& p : generic_points(60, is_elliptic)) {
      const Eigen::Matrix3d matrix = random_matrix(random);
      const double a = std::abs(matrix.determinant());
      reflections += matrix.determinant() < 0;
      const auto map = map_of(matrix);
      const Frame before = frame_at(wavy, p), after = frame_at(Transformed_function_traits_3(wavy, map), map(p));
      EXPECT_EQ(after.is_elliptic, is_elliptic);
      expect_equal_signatures(before, after);
      EXPECT_NEAR(before.scale / after.scale / std::sqrt(a), 1, 1e-10);
      const Eigen::Vector3d weights(std::pow(a, 0.25), std::pow(a, 0.25), std::sqrt(a));
      const Eigen::Matrix3d found = basis(after) * weights.asDiagonal() * basis(before).inverse();
      EXPECT_LT((found - matrix).norm(), 1e-10 * matrix.norm());
    }
  EXPECT_GT(reflections, 20);
}

TEST(Affine_frame, belongs_to_the_surface_whichever_way_the_gradient_points) {
  const Level_set_traits_3 reversed(wavy, 0., Orientation_of_level_set::AGAINST_GRADIENT);
  for (const bool is_elliptic : {true, false})
    for (const Point_3& p : generic_points(20, is_elliptic)) {
      const Frame frame = frame_at(wavy, p), other = frame_at(reversed, p);
      expect_equal_signatures(frame, other);
      EXPECT_LT((basis(frame) - basis(other)).norm(), 1e-10 * basis(frame).norm());
      EXPECT_GE(frame.signature[1], 0) << "J is not negative";
    }
}

TEST(Affine_frame, is_orthonormal_or_null_in_the_metric_and_has_determinant_one) {
  for (const bool is_elliptic : {true, false})
    for (const Point_3& p : generic_points(20, is_elliptic)) {
      const auto s = local_structure(wavy.taylor(p)).affine;
      const Frame frame = affine_frame(s);
      Eigen::Matrix3d metric;
      metric << s.metric[0], s.metric[1], s.metric[2], s.metric[1], s.metric[3], s.metric[4], s.metric[2], s.metric[4],
          s.metric[5];
      const double side = vector(frame.xi).dot(vector(s.normal)) > 0 ? 1 : -1;
      const Eigen::Matrix3d products = side * (basis(frame).transpose() * metric * basis(frame));
      Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
      if (is_elliptic) expected(0, 0) = expected(1, 1) = 1;
      else expected(0, 1) = expected(1, 0) = 1;
      const double terms = basis(frame).squaredNorm() * metric.norm(); // that add up to a product
      EXPECT_LT((products - expected).norm(), 1e-14 * terms + 1e-13);
      EXPECT_NEAR(std::abs(basis(frame).determinant()), 1, 1e-10);
      const double r2 = frame.scale * frame.scale, d = frame.signature[2] * std::abs(frame.signature[2]) * r2;
      EXPECT_NEAR(d, s.mean_curvature * s.mean_curvature - s.gaussian_curvature, 1e-11 * r2);
    }
}

/// A surface whose affine structure at the origin can be read off the coefficients.
TEST(Affine_frame, directions_are_those_of_known_forms) {
  // An elliptic graph whose cubic form is apolar, and whose quartic form makes B diagonal with different entries.
  const auto graph = [](const auto& x, const auto& y, const auto& z) {
    return z - 0.5 * (x * x + y * y) - 0.3 * (x * x * x - 3.0 * x * y * y) - 0.2 * (y * y * y - 3.0 * y * x * x) +
           0.4 * (x * x * x * x - y * y * y * y);
  };
  const auto frame = frame_at(make_analytic_traits<Kernel>(graph, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)), Point_3(0, 0, 0));
  ASSERT_TRUE(frame.is_elliptic);
  ASSERT_GT(frame.quality, 0.05);
  EXPECT_NEAR(std::abs(frame.e1[0] * frame.e1[1]), 0, 1e-12) << "e1 is along an axis";
  EXPECT_NEAR(std::abs(frame.e2[0] * frame.e2[1]), 0, 1e-12) << "e2 is along an axis";
  EXPECT_NEAR(vector(frame.e1).norm(), 1, 1e-12);
  EXPECT_NEAR(vector(frame.xi).dot(Eigen::Vector3d(0, 0, 1)), 1, 1e-12) << "xi points to the hollow side";
}

TEST(Affine_frame, has_no_quality_where_the_structure_is_symmetric) {
  const auto quality_of = [](const auto& f, const Point_3& p) {
    return frame_at(make_analytic_traits<Kernel>(f, f.box()), p).quality;
  };
  EXPECT_LT(quality_of(analytic_functions::Sphere(), Point_3(0.6, 0.48, 0.64)), 1e-7);
  EXPECT_LT(quality_of(analytic_functions::Elliptic_paraboloid(), Point_3(0.3, 0.4, 0.125)), 1e-7);
  EXPECT_LT(quality_of(analytic_functions::Hyperboloid_of_one_sheet(), Point_3(1, 0, 0)), 1e-7);
  EXPECT_LT(quality_of(analytic_functions::Torus(), Point_3(0.7 * 0.6, 0.7 * 0.8, 0)), 1e-7) << "mirror symmetric";
  const auto parabolic = make_analytic_traits<Kernel>(analytic_functions::Torus(), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  EXPECT_TRUE(std::isnan(frame_at(parabolic, Point_3(0.5, 0, 0.2)).quality));
}

TEST(Affine_frame, packs_have_the_bits_of_numbers) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using Lanes = Pack<double>;
  for (const bool is_elliptic : {true, false}) {
    const auto points = generic_points(Lanes::size - 1, is_elliptic);
    const auto point = [&](std::size_t i) {
      return i < points.size() ? points[i] : generic_points(1, !is_elliptic)[0];
    };
    Jet_3<Lanes> jet;
    for (std::size_t n = 0; n < jet.size; ++n)
      jet.coefficients()[n] = Lanes::generate([&](std::size_t i) { return wavy.taylor(point(i)).coefficients()[n]; });
    const auto pack = affine_frame(affine_structure(Monge_chart_3<Lanes>(jet)));
    for (std::size_t i = 0; i < Lanes::size; ++i) {
      const Frame frame = affine_frame(affine_structure(Monge_chart_3<double>(wavy.taylor(point(i)))));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(pack.e1[k][i], frame.e1[k]);
        EXPECT_EQ(pack.e2[k][i], frame.e2[k]);
        EXPECT_EQ(pack.xi[k][i], frame.xi[k]);
      }
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(pack.signature[k][i], frame.signature[k]);
      EXPECT_EQ(pack.scale[i], frame.scale);
      EXPECT_EQ(pack.quality[i], frame.quality);
      EXPECT_EQ(pack.is_elliptic[i], frame.is_elliptic);
    }
  }
}

TEST(Affine_frame, gradients_in_the_frame_have_their_weights_and_norms) {
  std::mt19937 random(2);
  for (const bool is_elliptic : {true, false})
    for (const Point_3& p : generic_points(5, is_elliptic)) {
      const Eigen::Matrix3d matrix = random_matrix(random);
      const auto map = map_of(matrix);
      const double weight = std::pow(std::abs(matrix.determinant()), -0.25);
      const auto before = affine_gradients(wavy, p);
      const auto after = affine_gradients(Transformed_function_traits_3(wavy, map), map(p));
      const auto norms = affine_gradient_norms(wavy, p);
      const auto expect_weight = [&](const std::array<double, 2>& a, const std::array<double, 2>& b, int power,
                                     double norm) {
        const double size = std::hypot(a[0], a[1]);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(b[i], a[i] * std::pow(weight, power), 1e-5 * size);
        EXPECT_NEAR(is_elliptic ? size : std::sqrt(std::abs(2 * a[0] * a[1])), norm, 1e-9 * size);
      };
      expect_weight(before.gaussian_curvature, after.gaussian_curvature, 5, norms[0]);
      expect_weight(before.mean_curvature, after.mean_curvature, 3, norms[1]);
      expect_weight(before.pick_invariant, after.pick_invariant, 3, norms[2]);
    }
}

} // namespace affine_frame_test
