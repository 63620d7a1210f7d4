// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace rounding_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Traits = Sampled_function_traits_3<Kernel>;

/// Samples may be rounded to float and smoothed before they become a spline.
struct Treatment {
  bool are_floats = false;
  double smoothing = 0;
};
constexpr Treatment treatments[] = {{}, {true}, {true, 2}};

template <class Function>
Traits sampled(const Function& f, int degree, Spline_scheme scheme, const Treatment& treatment = {}) {
  const Lattice_3<Kernel> lattice({24, 25, 26}, Point_3(-1, -1.1, -0.9),
                                  {Vector_3(0.08, 0.02, 0), Vector_3(-0.02, 0.09, 0), Vector_3(0, 0, 0.07)});
  Volume_3<Kernel> volume{lattice, {}};
  for (std::size_t k = 0; k < 26; ++k)
    for (std::size_t j = 0; j < 25; ++j)
      for (std::size_t i = 0; i < 24; ++i) {
        const Point_3 p = lattice.point(double(i), double(j), double(k));
        const double value = f(p.x(), p.y(), p.z());
        volume.values.push_back(treatment.are_floats ? double(float(value)) : value);
      }
  return Traits(std::move(volume),
                {.smoothing = treatment.smoothing, .spline_scheme = scheme, .spline_degree = degree});
}

template <class Function>
Point_status status(const Function& function, const Point_3& p) {
  return local_structure(function.taylor(p), {p.x(), p.y(), p.z()}, equiaffine::rounding(function, p)).status;
}

std::vector<Point_3> points_of(const Lattice_3<Kernel>& lattice) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point_3> points;
  for (int n = 0; n < 500; ++n)
    points.push_back(lattice.point(23 * unit(random), 24 * unit(random), 25 * unit(random)));
  for (const double u : {0.0, 0.1, 22.9, 23.0}) points.push_back(lattice.point(u, 12.3, 0.5));
  return points;
}

template <class Function>
void expect_status(const Function& f, Point_status expected, const Treatment& treatment = {}) {
  for (const auto scheme : {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::INTERPOLATION})
    for (const int degree : {5, 7, 9}) {
      const Traits traits = sampled(f, degree, scheme, treatment);
      const CGAL::Aff_transformation_3<Kernel> map(0.9, 0, 0.9, 0.1, 0, 2, 0, 0, 1.1, 0, 0.6, 0);
      const Transformed_function_traits_3 image(Level_set_traits_3(traits, 0.1), map);
      for (const Point_3& p : points_of(traits.lattice())) {
        EXPECT_EQ(status(traits, p), expected) << degree << ' ' << p;
        EXPECT_EQ(status(image, map(p)), expected) << degree << ' ' << p;
      }
    }
}

TEST(Rounding, planes_and_cylinders_given_as_samples_are_parabolic_stored_as_floats_and_smoothed_too) {
  for (const Treatment& treatment : treatments) {
    expect_status([](double x, double y, double z) { return 0.3 * x - 0.7 * y + 1.1 * z + 0.2; },
                  Point_status::PARABOLIC, treatment);
    expect_status([](double x, double y, double) { return (x + 3) * (x + 3) + (y - 2) * (y - 2) - 1; },
                  Point_status::PARABOLIC, treatment);
  }
}

TEST(Rounding, a_slight_curvature_is_none_of_rounding) {
  expect_status([](double x, double y, double z) { return z + 1e-4 * (x * x + y * y + x * y); }, Point_status::REGULAR);
}

TEST(Rounding, that_of_floats_hides_no_curvature_inside) {
  const auto f = [](double x, double y, double z) { return z + 0.02 * (x * x + y * y + x * y); };
  for (const Treatment& treatment : treatments) {
    const Traits traits = sampled(f, 7, Spline_scheme::QUASI_INTERPOLATION, treatment);
    for (const Point_3& p : {Point_3(0, 0, 0), Point_3(-0.3, 0.2, 0.1), Point_3(0.4, 0.1, -0.2)})
      EXPECT_EQ(status(traits, p), Point_status::REGULAR) << p;
  }
}

TEST(Rounding, that_of_floats_is_of_the_samples_around_a_point) {
  // The samples are up to 2e5 in a corner, and less than 1 around the points.
  const auto f = [](double x, double y, double z) {
    return z + 0.02 * (x * x + y * y + x * y) + 1e9 * std::pow((x + y + z) / 4, 24);
  };
  const Traits traits = sampled(f, 7, Spline_scheme::QUASI_INTERPOLATION, {true});
  for (const Point_3& p : {Point_3(0, 0, 0), Point_3(-0.3, 0.2, 0.1), Point_3(0.4, 0.1, -0.2)})
    EXPECT_EQ(status(traits, p), Point_status::REGULAR) << p;
}

TEST(Rounding, second_derivatives_err_by_no_more_and_not_by_much_less) {
  const auto f = [](double x, double y, double z) { return x * x * y - 2 * y * z + z * x * x * z + 3 * x; };
  for (const Treatment& treatment : treatments)
    for (const int degree : {5, 7, 9}) {
      const Traits traits = sampled(f, degree, Spline_scheme::QUASI_INTERPOLATION, treatment);
      double worst = 0;
      for (const Point_3& p : points_of(traits.lattice())) {
        const auto jet = traits.taylor(p);
        const double error =
            std::max({std::abs(jet.derivative(2, 0, 0) - 2 * p.y() - 2 * p.z() * p.z()),
                      std::abs(jet.derivative(1, 1, 0) - 2 * p.x()), std::abs(jet.derivative(0, 2, 0)),
                      std::abs(jet.derivative(0, 1, 1) + 2), std::abs(jet.derivative(0, 0, 2) - 2 * p.x() * p.x())});
        EXPECT_LE(error, traits.rounding(p)) << degree << ' ' << p;
        worst = std::max(worst, error / traits.rounding(p));
      }
      EXPECT_GE(worst, 1e-3) << degree;
    }
}

TEST(Rounding, a_function_that_says_nothing_has_none) {
  struct Silent : Traits {
    using Traits::Traits;
    void rounding() const = delete;
  };
  static_assert(HasRounding<Traits> && HasRounding<Level_set_traits_3<Traits>>);
  static_assert(HasRounding<Transformed_function_traits_3<Traits>>);
  static_assert(!HasRounding<Silent>);
}

} // namespace rounding_test
