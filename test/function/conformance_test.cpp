// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the conformance suite for every model of the library and for an archetype, and lists models and non-models of
// every concept.
#include "support/archetypes.h"
#include "support/conformance.h"
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/expand.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace conformance_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

const CGAL::Bbox_3 unit_box(-1, -1, -1, 1, 1, 1);

std::vector<Point_3> inner_points() {
  return {Point_3(0.1, 0.2, 0.3), Point_3(-0.45, 0.31, 0.62), Point_3(0.7, -0.13, -0.28), Point_3(0.02, -0.5, 0.41)};
}

// No derivative of exp(x) sin(2 y) + x z^2 / (2 + x y) - 0.3 vanishes.
struct Auto_function {
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    using std::exp;
    using std::sin;
    return exp(x) * sin(2.0 * y) + x * z * z / (2.0 + x * y) - 0.3;
  }
};

struct Fixed_type_function {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return Auto_function()(x, y, z);
  }
};

template <class Function>
struct Analytic_model {
  using Traits = Analytic_function_traits_3<Kernel, Function>;
  static Traits make() { return Traits(Function(), unit_box); }
  static std::vector<Point_3> points() { return inner_points(); }
  static constexpr double length = 0.5;
};

struct Expression_model {
  using Traits = Analytic_function_traits_3<Kernel, Expression_3>;
  static Traits make() { return Traits(Expression_3("exp(x)*sin(2*y) + x*z^2/(2+x*y) = c", {{"c", 0.3}}), unit_box); }
  static std::vector<Point_3> points() { return inner_points(); }
  static constexpr double length = 0.5;
};

/// A function that is cheaper on small boxes: the least of many.
struct Union_model {
  using Traits = Analytic_function_traits_3<Kernel, Expression_3>;
  static Traits make() {
    std::string text = "x^2 + y^2 + z^2 - 0.2";
    for (int n = 0; n < 20; ++n)
      text = "min(" + text + ", (x - " + std::to_string(2 + n) + ")^2 + exp(y*z) + z^2 - 0.3)";
    return Traits(Expression_3(text), unit_box);
  }
  static std::vector<Point_3> points() { return {{-0.3, -0.25, 0.2}, {-0.1, 0.2, -0.1}, {-0.6, -0.3, 0.4}}; }
  static constexpr double length = 0.2;
};

template <int Degree>
struct Sampled_model {
  using Traits = Sampled_function_traits_3<Kernel>;
  static Traits make() {
    const Lattice_3<Kernel> lattice({24, 20, 22}, unit_box);
    Volume_3<Kernel> volume{lattice, {}};
    for (std::size_t k = 0; k < 22; ++k)
      for (std::size_t j = 0; j < 20; ++j)
        for (std::size_t i = 0; i < 24; ++i) {
          const Point_3 p = lattice.point(double(i), double(j), double(k));
          volume.values.push_back(Auto_function()(p.x(), p.y(), p.z()));
        }
    return Traits(volume, {.spline_degree = Degree});
  }
  static std::vector<Point_3> points() { return inner_points(); }
  static constexpr double length = 0.1; // a voxel, beyond which the spline is another polynomial
};

struct Fitted_model {
  using Traits = Fitted_function_traits_3<Kernel>;
  static double height(double x, double y) { return x * x + 0.5 * y * y + 0.2 * std::sin(x + y); }
  static Traits make() {
    std::vector<Point_3> samples;
    for (int i = -7; i <= 7; ++i)
      for (int j = -7; j <= 7; ++j) samples.emplace_back(i / 7., j / 7., height(i / 7., j / 7.));
    return Traits(samples, {.scale = 0});
  }
  static std::vector<Point_3> points() {
    std::vector<Point_3> result;
    for (const auto& [x, y, z] : {std::array{0.1, 0.2, 0.05}, {-0.31, 0.12, -0.06}, {0.22, -0.41, 0.04}})
      result.emplace_back(x, y, height(x, y) + z);
    return result;
  }
  static constexpr double length = 0.1;
  static constexpr bool is_unbounded = true;
  static constexpr double disagreement = 0.03; ///< of the polynomials, at points a third of the spacing above the data
};

template <class Base>
struct Transformed_model {
  using Traits = Transformed_function_traits_3<typename Base::Traits>;
  static Kernel::Aff_transformation_3 map() {
    return Kernel::Aff_transformation_3(0.9, 0, 0.9, 0.5, 0, 2, 0.1, -1, 1.1, 0, 0.6, 2); // det < 0
  }
  static Traits make() { return Traits(Base::make(), map()); }
  static std::vector<Point_3> points() {
    std::vector<Point_3> images;
    for (const Point_3& p : Base::points()) images.push_back(map()(p));
    return images;
  }
  static constexpr double length = Base::length / 2;
};

template <class Base>
struct Level_set_model : Base {
  using Traits = Level_set_traits_3<typename Base::Traits>;
  static Traits make() { return Traits(Base::make(), 0.25, Orientation_of_level_set::AGAINST_GRADIENT); }
};

template <class Base>
struct Batch_model : Base {
  using Traits = Batch_function_traits_3<typename Base::Traits>;
  static Traits make() { return Traits(Base::make()); }
};

template <class Base>
struct Any_model : Base {
  using Traits = Any_function_3;
  static Traits make() { return Traits::make(Base::make()); }
};

/// A function that has each capability, with answers that no fallback gives.
class Capable_function : public Analytic_function_traits_3<Kernel, Auto_function> {
  using Base = Analytic_function_traits_3<Kernel, Auto_function>;

public:
  Capable_function() : Base(Auto_function(), unit_box) {}

  double certainty(const Point_3&) const { return 0.25; }
  double rounding(const Point_3&) const { return 1e-9; }
  Known_bounds known_bounds() const { return {true, false}; }
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const { return first_order_bounds(box); }
  Lattice_3<Kernel> lattice(const Lattice_3<Kernel>::Size& size) const {
    return Lattice_3<Kernel>(size, Point_3(1, 1, 1),
                             {Vector_3(-2. / double(size[0] - 1), 0, 0), Vector_3(0, -2. / double(size[1] - 1), 0),
                              Vector_3(0, 0, -2. / double(size[2] - 1))});
  }
  Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const {
    auto found = equiaffine::intersect_segment(static_cast<const Base&>(*this), a, b, fa, fb);
    found.evaluations += 1000;
    return found;
  }
};

struct Capable_model {
  using Traits = Capable_function;
  static Traits make() { return Traits(); }
  static std::vector<Point_3> points() { return inner_points(); }
  static constexpr double length = 0.5;
};

// The archetype has no members but those that the concept requires.
class Archetype {
public:
  using FT = double;
  using Point_3 = conformance_test::Point_3;
  using Vector_3 = Kernel::Vector_3;
  Archetype(const Archetype&) = default;
  Archetype& operator=(const Archetype&) = delete;
  static Archetype make() { return Archetype(); }
  FT value(const Point_3& p) const { return Auto_function()(p.x(), p.y(), p.z()); }
  Jet_3<FT> taylor(const Point_3& p) const { return expand<4, FT>(Auto_function(), p.x(), p.y(), p.z()); }
  CGAL::Bbox_3 bbox() const { return unit_box; }

private:
  Archetype() = default;
};

struct Archetype_model {
  using Traits = Archetype;
  static Traits make() { return Archetype::make(); }
  static std::vector<Point_3> points() { return inner_points(); }
  static constexpr double length = 0.5;
};

using Sparse = Analytic_model<Auto_function>;
using Models =
    ::testing::Types<Archetype_model, Sparse, Analytic_model<Fixed_type_function>, Expression_model, Sampled_model<5>,
                     Sampled_model<7>, Fitted_model, Transformed_model<Sparse>, Transformed_model<Sampled_model<7>>,
                     Level_set_model<Sparse>, Level_set_model<Transformed_model<Sampled_model<5>>>, Batch_model<Sparse>,
                     Capable_model, Transformed_model<Capable_model>, Any_model<Sparse>, Union_model,
                     Transformed_model<Union_model>, Level_set_model<Transformed_model<Union_model>>>;

using Analytic = Sparse::Traits;
using Sampled = Sampled_model<7>::Traits;

static_assert(ImplicitFunctionTraits_3<Archetype> && ImplicitFunctionTraits_3<Analytic> &&
              ImplicitFunctionTraits_3<Sampled>);
static_assert(BoundedImplicitFunctionTraits_3<Analytic> && BoundedImplicitFunctionTraits_3<Sampled>);
static_assert(!BoundedImplicitFunctionTraits_3<Archetype>);
static_assert(FirstOrderBoundedImplicitFunctionTraits_3<Analytic>);
static_assert(FirstOrderBoundedImplicitFunctionTraits_3<Level_set_traits_3<Transformed_function_traits_3<Analytic>>>);
static_assert(!FirstOrderBoundedImplicitFunctionTraits_3<Archetype>);
static_assert(FirstOrderBoundedImplicitFunctionTraits_3<Sampled>);
static_assert(SecondOrderBoundedImplicitFunctionTraits_3<Level_set_traits_3<Transformed_function_traits_3<Analytic>>>);
static_assert(!SecondOrderBoundedImplicitFunctionTraits_3<Sampled>);
static_assert(BatchImplicitFunctionTraits_3<Batch_function_traits_3<Archetype>>);
static_assert(!BatchImplicitFunctionTraits_3<Archetype>);
static_assert(FirstOrderImplicitFunctionTraits_3<Analytic> && !FirstOrderImplicitFunctionTraits_3<Archetype>);
static_assert(LatticeImplicitFunctionTraits_3<Sampled> && !LatticeImplicitFunctionTraits_3<Analytic>);
static_assert(LatticeImplicitFunctionTraits_3<Transformed_function_traits_3<Sampled>>);
static_assert(LatticeImplicitFunctionTraits_3<Level_set_traits_3<Sampled>>);
static_assert(!LatticeImplicitFunctionTraits_3<Transformed_function_traits_3<Analytic>>);

struct Without_value : Archetype {
  double value(const Point_3& p) const = delete;
};
struct With_low_order : Archetype {
  Jet_3<double, 2> taylor(const Point_3&) const;
};
struct Without_box : Archetype {
  void bbox() const;
};
struct Not_const : Archetype {
  double value(const Point_3& p);
};
struct With_wide_bounds : Archetype {
  double bounds(const CGAL::Bbox_3&) const;
};
static_assert(!ImplicitFunctionTraits_3<int> && !ImplicitFunctionTraits_3<Auto_function>);
static_assert(!ImplicitFunctionTraits_3<Without_value> && !ImplicitFunctionTraits_3<With_low_order>);
static_assert(!ImplicitFunctionTraits_3<Without_box> && !ImplicitFunctionTraits_3<Not_const>);
static_assert(!BoundedImplicitFunctionTraits_3<With_wide_bounds>);

TEST(Concepts, the_archetype_is_enough_for_delaunay_surface) {
  const archetypes::Implicit_function<Kernel> sphere{archetypes::Sphere()};
  const auto surface = delaunay_surface(sphere, {.radius = 0.2, .distance = 0.1});
  EXPECT_GT(surface.triangles.size(), 100u);
  for (const Point_3& p : surface.points) EXPECT_NEAR(std::hypot(p.x(), p.y(), p.z()), 1, 1e-12);
  EXPECT_FALSE(surface.is_certified);
  EXPECT_EQ(surface.undecided_boxes.size(), 1u);
}

} // namespace conformance_test

namespace conformance {
INSTANTIATE_TYPED_TEST_SUITE_P(Models, Conformance, conformance_test::Models);
}
