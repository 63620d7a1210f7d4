// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace analytic_functions_test {

using namespace equiaffine;
using namespace equiaffine::analytic_functions;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Real = boost::multiprecision::cpp_bin_float_50;

/// A functor and its formula as the literature writes it, read by Expression_3.
template <class Function>
struct Formula;
#define EQUIAFFINE_FORMULA(Function, text, is_closed_)                                                                 \
  template <>                                                                                                          \
  struct Formula<Function> {                                                                                           \
    static Expression_3 expression() { return Expression_3(text); }                                                    \
    static constexpr bool is_closed = is_closed_;                                                                      \
  };
EQUIAFFINE_FORMULA(Sphere, "x^2+y^2+z^2 = 1", true)
EQUIAFFINE_FORMULA(Ellipsoid, "(x/1.5)^2 + y^2 + (2*z)^2 = 1", true)
EQUIAFFINE_FORMULA(Elliptic_paraboloid, "z = (x^2+y^2)/2", false)
EQUIAFFINE_FORMULA(Hyperbolic_paraboloid, "z = (x^2-y^2)/2", false)
EQUIAFFINE_FORMULA(Hyperboloid_of_one_sheet, "x^2+y^2-z^2 = 1", false)
EQUIAFFINE_FORMULA(Hyperboloid_of_two_sheets, "z^2-x^2-y^2 = 1", false)
EQUIAFFINE_FORMULA(Torus, "z^2+(sqrt(x^2+y^2)-0.5)^2 = 0.2^2", true)
EQUIAFFINE_FORMULA(Blobby, "(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6 = 0", true)
EQUIAFFINE_FORMULA(Sine_surface, "2*z^2 = sin(5*x+3*y^2-1)", false)
EQUIAFFINE_FORMULA(Tanglecube, "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", true)
EQUIAFFINE_FORMULA(Gyroid, "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", false)
EQUIAFFINE_FORMULA(Cayley_cubic, "x^2+y^2+z^2-2*x*y*z = 1", false)
EQUIAFFINE_FORMULA(Chmutov_sextic, "32*(x^6+y^6+z^6)-48*(x^4+y^4+z^4)+18*(x^2+y^2+z^2)-3", true)
EQUIAFFINE_FORMULA(Barth_sextic,
                   "4*(((1+5^0.5)/2*x)^2-y^2)*(((1+5^0.5)/2*y)^2-z^2)*(((1+5^0.5)/2*z)^2-x^2)"
                   "-(2+5^0.5)*(x^2+y^2+z^2-1)^2",
                   false)
EQUIAFFINE_FORMULA(Metaballs,
                   "0.4-exp(-4*((x+0.55)^2+(y+0.45)^2+(z+0.5)^2))-exp(-4*((x-0.5)^2+(y+0.55)^2+(z+0.4)^2))"
                   "-exp(-4*((x+0.45)^2+(y-0.5)^2+(z+0.55)^2))-exp(-4*((x-0.6)^2+(y-0.45)^2+(z+0.5)^2))"
                   "-exp(-4*((x+0.5)^2+(y+0.6)^2+(z-0.45)^2))-exp(-4*((x-0.45)^2+(y+0.5)^2+(z-0.55)^2))"
                   "-exp(-4*((x+0.6)^2+(y-0.55)^2+(z-0.5)^2))-exp(-4*((x-0.55)^2+(y-0.6)^2+(z-0.6)^2))",
                   true)
#undef EQUIAFFINE_FORMULA

/// A grid over the box; with an even number of nodes none lies on an axis, where the torus has no derivatives.
std::vector<Point_3> nodes(const CGAL::Bbox_3& box) {
  const Lattice_3<Kernel> lattice({10, 10, 10}, box);
  std::vector<Point_3> points;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i) points.push_back(lattice.point(i, j, k));
  return points;
}

/// The largest error of a sum of a few dozen terms, relative to their size: 1000 roundings.
constexpr double rounding = 1000 * std::numeric_limits<double>::epsilon();

double size(const Jet_3<double>& jet) {
  double sum = 1;
  for (const double coefficient : jet.coefficients()) sum += std::abs(coefficient);
  return sum;
}

template <class Function>
class Analytic_functions : public ::testing::Test {};
using Functions = ::testing::Types<Sphere, Ellipsoid, Elliptic_paraboloid, Hyperbolic_paraboloid,
                                   Hyperboloid_of_one_sheet, Hyperboloid_of_two_sheets, Torus, Blobby, Sine_surface,
                                   Tanglecube, Gyroid, Metaballs, Cayley_cubic, Chmutov_sextic, Barth_sextic>;
TYPED_TEST_SUITE(Analytic_functions, Functions);

TYPED_TEST(Analytic_functions, the_functor_is_the_formula_with_all_its_derivatives) {
  const TypeParam f;
  const auto code = make_analytic_traits<Kernel>(f, f.box());
  const auto text = make_analytic_traits<Kernel>(Formula<TypeParam>::expression(), f.box());
  for (const Point_3& p : nodes(f.box())) {
    const auto a = code.taylor(p), b = text.taylor(p);
    for (std::size_t n = 0; n < 35; ++n)
      EXPECT_NEAR(a.coefficients()[n], b.coefficients()[n], rounding * size(b)) << p << ' ' << n;
  }
}

TYPED_TEST(Analytic_functions, the_surface_meets_the_box_and_is_inside_it_if_closed) {
  const TypeParam f;
  const CGAL::Bbox_3 box = f.box();
  bool has_negative = false, has_positive = false;
  for (const Point_3& p : nodes(box)) {
    const double value = f(p.x(), p.y(), p.z());
    (value < 0 ? has_negative : has_positive) = true;
    const bool is_on_boundary = p.x() == box.xmin() || p.x() == box.xmax() || p.y() == box.ymin() ||
                                p.y() == box.ymax() || p.z() == box.zmin() || p.z() == box.zmax();
    if (is_on_boundary && Formula<TypeParam>::is_closed) {
      EXPECT_GT(value, 0) << p;
    }
  }
  EXPECT_TRUE(has_negative && has_positive);
}

TYPED_TEST(Analytic_functions, full_jets_and_50_digits_and_intervals_agree_with_double) {
  const TypeParam f;
  const auto traits = make_analytic_traits<Kernel>(f, f.box());
  for (const Point_3& p : nodes(f.box())) {
    const double value = traits.value(p);
    const auto sparse = traits.taylor(p);
    using Jet = Jet_3<double>;
    const Jet full = f(Jet::variable(0, p.x()), Jet::variable(1, p.y()), Jet::variable(2, p.z()));
    for (std::size_t n = 0; n < 35; ++n)
      EXPECT_NEAR(sparse.coefficients()[n], full.coefficients()[n], rounding * size(full));
    const Real exact = f(Real(p.x()), Real(p.y()), Real(p.z()));
    EXPECT_NEAR(value, double(exact), rounding * size(full));
    const Interval bounds = traits.bounds(p.bbox());
    EXPECT_TRUE(Real(bounds.lower()) <= exact && exact <= Real(bounds.upper())) << p;
    EXPECT_LT(bounds.upper() - bounds.lower(), rounding * size(full));
  }
}

/// K and H at a point of a level set.
template <class Function>
std::pair<double, double> curvatures(const Function& f, const Point_3& p) {
  const auto s = local_structure_at(make_analytic_traits<Kernel>(f, f.box()), p);
  EXPECT_EQ(s.status, Point_status::REGULAR);
  EXPECT_NEAR(s.affine.pick_invariant, 0, 1e-14);
  return {s.affine.gaussian_curvature, s.affine.mean_curvature};
}

TEST(Analytic_functions_quadrics, curvatures_are_the_documented_ones) {
  const auto expect = [](const std::pair<double, double>& curvature, double gaussian, double mean) {
    EXPECT_NEAR(curvature.first, gaussian, 1e-13);
    EXPECT_NEAR(curvature.second, mean, 1e-13);
  };
  expect(curvatures(Sphere{2}, Point_3(2 / 3., 4 / 3., -4 / 3.)), std::pow(2, -3), -std::pow(2, -1.5));
  expect(curvatures(Ellipsoid{3, 2, 0.5}, Point_3(1, 4 / 3., -1 / 3.)), 1 / 3., -std::pow(3, -0.5));
  expect(curvatures(Elliptic_paraboloid(), Point_3(0.5, -1, 0.625)), 0, 0);
  expect(curvatures(Hyperbolic_paraboloid(), Point_3(0.5, -1, -0.375)), 0, 0);
  expect(curvatures(Hyperboloid_of_one_sheet(), Point_3(1.25, 0, 0.75)), 1, -1);
  expect(curvatures(Hyperboloid_of_two_sheets(), Point_3(0.75, 0, 1.25)), 1, -1);
}

TEST(Analytic_functions_nodes, the_documented_nodes_are_singular_points_of_the_surface) {
  const auto expect_node = [](const auto& f, const Point_3& p) {
    const auto jet = make_analytic_traits<Kernel>(f, f.box()).taylor(p);
    EXPECT_NEAR(jet.value(), 0, 1e-14);
    EXPECT_EQ(local_structure(jet, {p.x(), p.y(), p.z()}).status, Point_status::SINGULAR);
  };
  expect_node(Cayley_cubic(), Point_3(1, 1, 1));
  expect_node(Cayley_cubic(), Point_3(1, -1, -1));
  expect_node(Cayley_cubic(), Point_3(-1, 1, -1));
  expect_node(Cayley_cubic(), Point_3(-1, -1, 1));
  for (const double s : {-1., 1.}) {
    expect_node(Barth_sextic(), Point_3(s, 0, 0));
    expect_node(Barth_sextic(), Point_3(0, s, 0));
    expect_node(Barth_sextic(), Point_3(0, 0, s));
  }
}

TEST(Analytic_functions_chmutov, chebyshev_polynomial_is_the_cosine_of_six_times_the_angle) {
  const Chmutov_sextic f;
  for (const double angle : {0.1, 0.7, 1.3, 2.9})
    EXPECT_NEAR(f(std::cos(angle), 0.0, 0.0), std::cos(6 * angle) - 2, 1e-13); // T(0) = -1
}

} // namespace analytic_functions_test
