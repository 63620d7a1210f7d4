// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/random_surfaces.h"
#include "support/reference.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_frame.h>
#include <equiaffine/geometry/reference_estimators.h>

#include <CGAL/Simple_cartesian.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace affine_structure_test {

using namespace equiaffine;
using namespace random_surfaces;
using Kernel = CGAL::Simple_cartesian<double>;

TEST(Affine_structure, every_row_of_the_reference_is_within_its_limit) {
  const auto rows = read_reference(EQUIAFFINE_TEST_DATA "/affine_structure.csv");
  ASSERT_EQ(rows.size(), 200u);
  std::vector<double> errors;
  for (const Reference_row& row : rows) {
    const auto s = local_structure(expand(Expression_3(row.expression), row.point));
    ASSERT_EQ(s.status, Point_status::REGULAR) << row.surface;
    const double S = std::abs(row.affine_K) + row.affine_H * row.affine_H + std::pow(std::abs(row.euclidean_K), 1.5);
    const std::array<double, 7> row_errors = {
        std::abs(s.affine.gaussian_curvature - row.affine_K) / S,
        std::abs(s.affine.mean_curvature - row.affine_H) / std::sqrt(S),
        std::abs(s.affine.pick_invariant - row.pick_J) / std::max(std::sqrt(S), std::abs(row.pick_J)),
        relative_difference(s.affine.conormal, row.nu),
        relative_difference(s.affine.normal, row.xi),
        std::abs(s.euclidean.gaussian_curvature - row.euclidean_K) / std::abs(row.euclidean_K),
        std::abs(s.euclidean.mean_curvature - row.euclidean_H) /
            std::max(std::sqrt(std::abs(row.euclidean_K)), std::abs(row.euclidean_H))};
    for (std::size_t n = 0; n < row_errors.size(); ++n)
      EXPECT_LE(row_errors[n], row.limit) << row.surface << ", quantity " << n;
    errors.insert(errors.end(), row_errors.begin(), row_errors.end());
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  EXPECT_LE(errors[errors.size() / 2], 1e-14);
}

TEST(Affine_structure, a_conjugate_basis_changes_nothing_but_rounding) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto&) {
    const Monge_chart_3<double> chart(expand(f, p));
    if (std::abs(chart.quadratic[0]) < 0.05) return;
    const auto before = internal::structure_in_basis(chart),
               after = internal::structure_in_basis(chart.conjugate(true));
    const double S = scale(s), tolerance = 1e-9;
    EXPECT_NEAR(after.gaussian_curvature, before.gaussian_curvature, tolerance * S);
    EXPECT_NEAR(after.mean_curvature, before.mean_curvature, tolerance * std::sqrt(S));
    EXPECT_NEAR(after.pick_invariant, before.pick_invariant, tolerance * std::sqrt(S));
    EXPECT_LE(relative_difference(after.normal, before.normal), tolerance);
    EXPECT_LE(relative_difference(after.conormal, before.conormal), tolerance);
    EXPECT_NEAR(after.quadric_defect, before.quadric_defect, tolerance * (1 + before.quadric_defect));
    for (std::size_t n = 0; n < 6; ++n)
      EXPECT_NEAR(after.metric[n], before.metric[n], tolerance * (1 + std::abs(before.metric[n])));
    const Affine_frame_3<double> frame = affine_frame(after), expected = affine_frame(before);
    if (expected.quality < 1e-3) return;
    EXPECT_LE(relative_difference(frame.e1, expected.e1), 1e-6);
    EXPECT_LE(relative_difference(frame.e2, expected.e2), 1e-6);
  });
}

TEST(Affine_structure, unimodular_maps_leave_curvatures_and_carry_normals_along) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    std::array<double, 9> m;
    double determinant;
    do {
      for (double& x : m) x = unit(random);
      determinant = CGAL::determinant(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]);
    } while (std::abs(determinant) < 0.3);
    const double factor = 1 / std::cbrt(determinant); // determinant 1: orientation-reversing maps become preserving
    for (double& x : m) x *= factor;
    const Kernel::Aff_transformation_3 map(m[0], m[1], m[2], 0.3, m[3], m[4], m[5], -1, m[6], m[7], m[8], 2);
    const Transformed_function_traits_3 image(make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)), map);
    const auto t = local_structure(image.taylor(map(Kernel::Point_3(p[0], p[1], p[2]))));
    ASSERT_EQ(t.status, Point_status::REGULAR);
    const double S = std::max(scale(s), scale(t)), tolerance = 1e-9;
    EXPECT_NEAR(t.affine.gaussian_curvature, s.affine.gaussian_curvature, tolerance * S);
    EXPECT_NEAR(t.affine.mean_curvature, s.affine.mean_curvature, tolerance * std::sqrt(S));
    EXPECT_NEAR(t.affine.pick_invariant, s.affine.pick_invariant,
                tolerance * std::max(std::sqrt(S), std::abs(s.affine.pick_invariant)));
    const auto carried = [&](const Vector& v) {
      const auto w = map(Kernel::Vector_3(v[0], v[1], v[2]));
      return Vector{w.x(), w.y(), w.z()};
    };
    EXPECT_LE(relative_difference(t.affine.normal, carried(s.affine.normal)), tolerance);
    // The co-normal is a covector: its values on carried vectors stay.
    for (const Vector& e : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}})
      EXPECT_NEAR(dot(t.affine.conormal, carried(e)), dot(s.affine.conormal, e),
                  tolerance * (1 + std::sqrt(dot(s.affine.conormal, s.affine.conormal))));
  });
}

TEST(Affine_structure, other_maps_scale_by_powers_of_the_determinant) {
  const auto f = [](const auto& x, const auto& y, const auto& z) {
    return x * x + 2.0 * y * y + z * z * z + x * y * z;
  };
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6); // the paper's figure 8, det = -0.9
  const double a = 0.9;
  const Kernel::Point_3 p(0.4, -0.3, 0.8);
  const auto base = make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto s = local_structure(base.taylor(p));
  const auto t = local_structure(Transformed_function_traits_3(base, map).taylor(map(p)));
  EXPECT_NEAR(t.affine.gaussian_curvature * a, s.affine.gaussian_curvature, 1e-13 * scale(s));
  EXPECT_NEAR(t.affine.mean_curvature * std::sqrt(a), s.affine.mean_curvature, 1e-13 * std::sqrt(scale(s)));
  EXPECT_NEAR(t.affine.pick_invariant * std::sqrt(a), s.affine.pick_invariant, 1e-13 * std::sqrt(scale(s)));
  const auto image = map(Kernel::Vector_3(s.affine.normal[0], s.affine.normal[1], s.affine.normal[2])) / std::sqrt(a);
  EXPECT_LE(relative_difference(t.affine.normal, {image.x(), image.y(), image.z()}), 1e-13);
}

TEST(Affine_structure, reversing_f_reverses_normals_and_mean_curvatures_only) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto&) {
    const auto r = local_structure(-expand(f, p));
    EXPECT_EQ(r.affine.gaussian_curvature, s.affine.gaussian_curvature);
    EXPECT_EQ(r.affine.mean_curvature, -s.affine.mean_curvature);
    EXPECT_EQ(r.affine.pick_invariant, -s.affine.pick_invariant);
    EXPECT_EQ(r.affine.conormal, times(-1, s.affine.conormal));
    EXPECT_EQ(r.affine.normal, times(-1, s.affine.normal));
    EXPECT_EQ(r.euclidean.gaussian_curvature, s.euclidean.gaussian_curvature);
    EXPECT_EQ(r.euclidean.mean_curvature, -s.euclidean.mean_curvature);
    for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(r.affine.metric[n], -s.affine.metric[n]);
  });
}

TEST(Affine_structure, increasing_functions_of_f_have_the_same_level_sets) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto&) {
    for (const Jet& jet : {7.5 * expand(f, p), exp(expand(f, p)) - 1.0}) {
      const auto t = local_structure(jet);
      EXPECT_NEAR(t.affine.gaussian_curvature, s.affine.gaussian_curvature, 1e-9 * scale(s));
      EXPECT_NEAR(t.affine.mean_curvature, s.affine.mean_curvature, 1e-9 * std::sqrt(scale(s)));
      EXPECT_LE(relative_difference(t.affine.normal, s.affine.normal), 1e-9);
    }
  });
}

TEST(Affine_structure, the_size_of_f_does_not_matter) {
  const auto f = [](const auto& x, const auto& y, const auto& z) { return x * x + 2.0 * y * y + z * z * z - x * y; };
  const Jet jet = expand(f, {0.4, -0.3, 0.8});
  const auto s = local_structure(jet);
  for (const auto way : {Estimator::COMPACT, Estimator::TRANSFORMATION, Estimator::DIRECT, Estimator::DIRECT_Z})
    for (double c : {1e-150, 1e-60, 1e-20, 1e20, 1e60, 1e150}) {
      const auto t = local_structure(c * jet, {0.4, -0.3, 0.8}, 0.0, way);
      ASSERT_EQ(t.status, Point_status::REGULAR) << c;
      EXPECT_NEAR(t.affine.gaussian_curvature, s.affine.gaussian_curvature, 1e-13 * scale(s)) << c << ' ' << int(way);
      EXPECT_NEAR(t.affine.mean_curvature, s.affine.mean_curvature, 1e-13 * std::sqrt(scale(s))) << c;
    }
}

TEST(Affine_structure, conormal_and_normal_are_dual_and_the_metric_vanishes_along_the_normal) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto&) {
    const Jet jet = expand(f, p);
    EXPECT_NEAR(dot(s.affine.conormal, s.affine.normal), 1, 1e-12);
    const auto& m = s.affine.metric;
    const auto& xi = s.affine.normal;
    const double size = std::sqrt(dot(xi, xi)) * (std::abs(m[0]) + std::abs(m[3]) + std::abs(m[5]));
    EXPECT_NEAR(m[0] * xi[0] + m[1] * xi[1] + m[2] * xi[2], 0, 1e-12 * size);
    EXPECT_NEAR(m[1] * xi[0] + m[3] * xi[1] + m[4] * xi[2], 0, 1e-12 * size);
    // On the tangent plane it is |K_e|^(-1/4) times the second fundamental form.
    const double factor = std::pow(std::abs(s.euclidean.gaussian_curvature), -0.25);
    const auto form = [&](const Vector& v) {
      return m[0] * v[0] * v[0] + m[3] * v[1] * v[1] + m[5] * v[2] * v[2] +
             2 * (m[1] * v[0] * v[1] + m[2] * v[0] * v[2] + m[4] * v[1] * v[2]);
    };
    EXPECT_NEAR(form(s.euclidean.direction1), factor * s.euclidean.k1, 1e-11 * (factor + size));
    EXPECT_NEAR(form(s.euclidean.direction2), factor * s.euclidean.k2, 1e-11 * (factor + size));
    EXPECT_GT(std::abs(jet.coefficient(1, 0, 0)) + std::abs(jet.coefficient(0, 1, 0)), 0);
  });
}

// The Gaussian curvature of the metric E du^2 + 2 F du dv + G dv^2 by its derivatives (Brioschi).
template <class Number, class Metric_jet>
Number gaussian_curvature(const Metric_jet& E, const Metric_jet& F, const Metric_jet& G) {
  const auto half = [](const Number& x) { return Number(x / 2); };
  const Number E_u = E.derivative(1, 0, 0), E_v = E.derivative(0, 1, 0), F_u = F.derivative(1, 0, 0);
  const Number F_v = F.derivative(0, 1, 0), G_u = G.derivative(1, 0, 0), G_v = G.derivative(0, 1, 0);
  const Number second = F.derivative(1, 1, 0) - half(E.derivative(0, 2, 0)) - half(G.derivative(2, 0, 0));
  const Number e = E.value(), f = F.value(), g = G.value(), zero = 0, area = e * g - f * f;
  using Row = std::array<Number, 3>;
  const Number first_determinant = internal::determinant(Row{second, half(E_u), Number(F_u - half(E_v))},
                                                         Row{Number(F_v - half(G_u)), e, f}, Row{half(G_v), f, g});
  const Number second_determinant =
      internal::determinant(Row{zero, half(E_v), half(G_u)}, Row{half(E_v), e, f}, Row{half(G_u), f, g});
  return (first_determinant - second_determinant) / (area * area);
}

// The metric as a function of (x, y) comes from the derivatives of the graph z = g(x, y), which no formula of the
// compact kernel has to do with.
TEST(Affine_structure, the_gauss_equation_holds) {
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 200; ++n) {
    Jet_3<Number> jet;
    for (Number& c : jet.coefficients()) c = unit(random);
    const auto derivatives = internal::partial_derivatives(jet);
    const internal::Graph_derivatives<Number> graph(derivatives);
    const auto expanded = [&](std::size_t i, std::size_t j) { // g_ij to second order in (x, y)
      const auto& g = graph.g;
      using Metric_jet = Jet_3<Number, 2>;
      Metric_jet r(g[i][j]);
      r.at<Metric_jet::index(1, 0, 0)>() = g[i + 1][j];
      r.at<Metric_jet::index(0, 1, 0)>() = g[i][j + 1];
      r.at<Metric_jet::index(2, 0, 0)>() = g[i + 2][j] / 2;
      r.at<Metric_jet::index(1, 1, 0)>() = g[i + 1][j + 1];
      r.at<Metric_jet::index(0, 2, 0)>() = g[i][j + 2] / 2;
      return r;
    };
    const auto xx = expanded(2, 0), xy = expanded(1, 1), yy = expanded(0, 2), d = xx * yy - xy * xy;
    const auto factor = Number(derivatives[3] < 0 ? -1 : 1) / sqrt(sqrt(d.value() < 0 ? -d : d));
    const Number kappa = gaussian_curvature<Number>(xx * factor, xy * factor, yy * factor);
    const auto s = affine_structure(Monge_chart_3<Number>(jet));
    const Number sum = s.mean_curvature + s.pick_invariant;
    EXPECT_LE(double(abs(kappa - sum) / (1 + abs(sum))), 1e-35);
  }
}

TEST(Affine_structure, paraboloids_have_constant_affine_normals) {
  for (double sign : {1.0, -1.0}) {
    const auto f = [&](const auto& x, const auto& y, const auto& z) { return z - 0.5 * (x * x + sign * y * y); };
    for (const Vector& p : {Vector{0, 0, 0}, Vector{0.7, -0.2, 0.1}, Vector{-3, 5, 2}}) {
      const auto s = local_structure(expand(f, p));
      EXPECT_LE(distance(s.affine.normal, {0, 0, 1}), 1e-14);
      EXPECT_NEAR(s.affine.gaussian_curvature, 0, 1e-14);
      EXPECT_NEAR(s.affine.mean_curvature, 0, 1e-14);
    }
  }
}

TEST(Affine_structure, spheres_have_the_signs_and_powers_of_the_conventions) {
  const double r = 2;
  const auto f = [&](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z - r * r; };
  const Vector p = {r * 2 / 3, -r / 3, r * 2 / 3};
  const auto s = local_structure(expand(f, p));
  EXPECT_NEAR(s.affine.gaussian_curvature, std::pow(r, -3), 1e-15);
  EXPECT_NEAR(s.affine.mean_curvature, -std::pow(r, -1.5), 1e-15);
  EXPECT_NEAR(s.affine.pick_invariant, 0, 1e-15);
  EXPECT_LE(distance(s.affine.conormal, times(std::pow(r, -0.5), p)), 1e-15);
  EXPECT_LE(distance(s.affine.normal, times(std::pow(r, -1.5), p)), 1e-15);
  EXPECT_NEAR(s.euclidean.gaussian_curvature, 1 / (r * r), 1e-15);
  EXPECT_NEAR(s.euclidean.mean_curvature, -1 / r, 1e-15);
  EXPECT_NEAR(s.euclidean.k1, -1 / r, 1e-15);
  EXPECT_NEAR(s.affine.k1, -std::pow(r, -1.5), 1e-7); // a double eigenvalue: the square root of a rounding error
}

TEST(Affine_structure, principal_curvatures_are_the_eigenvalues_where_they_are_real) {
  int complex_pairs = 0;
  for_random_surfaces([&](const Random_surface&, const Vector&, const Local_structure_3<double>& s, auto&) {
    if (s.affine.has_real_principal_curvatures) {
      EXPECT_GE(s.affine.k1, s.affine.k2);
      EXPECT_NEAR(s.affine.k1 * s.affine.k2, s.affine.gaussian_curvature, 1e-9 * scale(s));
      EXPECT_NEAR(s.affine.k1 + s.affine.k2, 2 * s.affine.mean_curvature, 1e-9 * std::sqrt(scale(s)));
    } else {
      ++complex_pairs;
      EXPECT_LT(s.euclidean.gaussian_curvature, 0);
      EXPECT_GT(s.affine.gaussian_curvature, s.affine.mean_curvature * s.affine.mean_curvature);
      EXPECT_TRUE(std::isnan(s.affine.k1) && std::isnan(s.affine.k2));
    }
  });
  EXPECT_GT(complex_pairs, 0);
}

TEST(Affine_structure, ruled_surfaces_have_a_vanishing_pick_invariant) {
  const auto f = [](const auto& x, const auto& y, const auto& z) { return z - x * y + x * x * x / 3.0; };
  EXPECT_NEAR(local_structure(expand(f, {0.3, 0.8, 0.1})).affine.pick_invariant, 0, 1e-14);
}

TEST(Affine_structure, the_quadric_defect_vanishes_on_quadrics) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int regular = 0;
  for (int n = 0; n < 100; ++n) {
    Random_surface f{};
    std::size_t index = 0;
    for (int i = 0; i <= 5; ++i)
      for (int j = 0; i + j <= 5; ++j)
        for (int k = 0; i + j + k <= 5; ++k, ++index)
          if (i + j + k <= 2) f.c[index] = unit(random);
    const auto s = local_structure(expand(f, Vector{unit(random), unit(random), unit(random)}));
    if (s.status != Point_status::REGULAR || std::abs(s.euclidean.gaussian_curvature) < 0.01) continue;
    ++regular;
    EXPECT_LE(s.affine.quadric_defect, 1e-11);
  }
  EXPECT_GT(regular, 50);
}

TEST(Affine_structure, the_quadric_defect_tells_ruled_surfaces_from_quadrics_where_the_Pick_invariant_does_not) {
  const auto cayley = [](const auto& x, const auto& y, const auto& z) { return z - x * y + x * x * x / 3.0; };
  const auto s = local_structure(expand(cayley, Vector{0, 0, 0})).affine;
  EXPECT_NEAR(s.pick_invariant, 0, 1e-15);
  // At the origin the axes are orthonormal tangents, the second fundamental form is x y, the cubic form -x^3 / 3.
  EXPECT_NEAR(s.quadric_defect, 2. / 2, 1e-15);
}

TEST(Affine_structure, the_quadric_defect_has_no_unit_and_no_direction) {
  for_random_surfaces([](const Random_surface& f, const Vector& p, const Local_structure_3<double>& s, auto&) {
    const double c = std::cos(0.7), t = std::sin(0.7), size = 3;
    const Kernel::Aff_transformation_3 map(size * c, -size * t * 0.6, size * t * 0.8, size * t, size * c * 0.6,
                                           -size * c * 0.8, 0, size * 0.8, size * 0.6);
    const Transformed_function_traits_3 image(make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)), map);
    const auto moved = local_structure(image.taylor(map(Kernel::Point_3(p[0], p[1], p[2]))));
    EXPECT_NEAR(moved.affine.quadric_defect, s.affine.quadric_defect, 1e-9 * (1 + s.affine.quadric_defect));
  });
}

} // namespace affine_structure_test
