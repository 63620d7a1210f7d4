// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of the library ask for no more than the concepts of their arguments promise: each is called with an
// archetype of the concept. conformance_test.cpp does that for delaunay_surface(), which takes long to compile.
#include "support/archetypes.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/isosurfacing_fields.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>
#include <equiaffine/surface/parabolic_curves.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace archetypes_test {

using namespace equiaffine;
using archetypes::Sphere, archetypes::Torus;
using Kernel = CGAL::Simple_cartesian<double>;
using Other_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Floats = CGAL::Simple_cartesian<float>;

using Function = archetypes::Implicit_function<Kernel>;
using Bounded = archetypes::Bounded_function<Kernel>;
using First_order_bounded = archetypes::First_order_bounded_function<Kernel>;
using Second_order_bounded = archetypes::Second_order_bounded_function<Kernel>;
using Restrictable = archetypes::Restrictable_function<Kernel>;
using First_order = archetypes::First_order_function<Kernel>;
using Batch = archetypes::Batch_function<Kernel>;
using First_order_batch = archetypes::First_order_batch_function<Kernel>;
using Packs = archetypes::Pack_function<Kernel>;
using On_lattice = archetypes::Lattice_function<Kernel>;
using Capable = archetypes::Capable_function<Kernel>;

template <class T>
constexpr bool is_only_copied = std::copy_constructible<T> && !std::is_default_constructible_v<T> &&
                                !std::is_copy_assignable_v<T> && !std::is_move_assignable_v<T>;
static_assert(is_only_copied<Function> && is_only_copied<Restrictable> && is_only_copied<On_lattice>);
static_assert(ImplicitFunctionTraits_3<Function> && ImplicitFunctionTraits_3<archetypes::Implicit_function<Floats>>);
static_assert(BoundedImplicitFunctionTraits_3<Bounded> && !FirstOrderBoundedImplicitFunctionTraits_3<Bounded>);
static_assert(FirstOrderBoundedImplicitFunctionTraits_3<First_order_bounded> &&
              !SecondOrderBoundedImplicitFunctionTraits_3<First_order_bounded>);
static_assert(SecondOrderBoundedImplicitFunctionTraits_3<Second_order_bounded>);
static_assert(RestrictableImplicitFunctionTraits_3<Restrictable> && FirstOrderImplicitFunctionTraits_3<First_order>);
static_assert(BatchImplicitFunctionTraits_3<Batch> && !FirstOrderBatchImplicitFunctionTraits_3<Batch>);
static_assert(FirstOrderBatchImplicitFunctionTraits_3<First_order_batch> && PackImplicitFunctionTraits_3<Packs>);
static_assert(LatticeImplicitFunctionTraits_3<On_lattice>);
static_assert(HasSamplingLattice<Capable> && HasTightFirstOrderBounds<Capable> && HasKnownBounds<Capable> &&
              HasFifthOrder<Capable> && HasRounding<Capable> && HasCertainty<Capable> && HasIntersectSegment<Capable>);

/// Expects a mesh of the unit sphere, whose vertices are on it.
template <class Surface>
void expect_sphere(const Surface& surface, double tolerance = 1e-12) {
  EXPECT_GT(surface.triangles.size(), 100U);
  EXPECT_EQ(2 * surface.points.size(), surface.triangles.size() + 4);
  for (const auto& p : surface.points) EXPECT_NEAR(std::hypot(p.x(), p.y(), p.z()), 1, tolerance);
}

template <class Traits>
class Archetypes : public testing::Test {};
using Functions = testing::Types<Function, Bounded, First_order_bounded, Second_order_bounded, Restrictable,
                                 First_order, Batch, First_order_batch, Packs, On_lattice, Capable>;
TYPED_TEST_SUITE(Archetypes, Functions);

TYPED_TEST(Archetypes, are_enough_for_marching_cubes) {
  const TypeParam traits{Sphere()};
  expect_sphere(marching_cubes(traits, {.resolution = 12}));
}

TYPED_TEST(Archetypes, are_enough_for_the_structure_at_points) {
  const TypeParam traits{Sphere()};
  const double r = 1.25; // affine curvatures of a sphere are r^-3 and -r^(-3/2)
  const std::vector<Kernel::Point_3> points(9, Kernel::Point_3(0.75, -1, 0));
  const auto structure = local_structure_at(traits, points[0]);
  EXPECT_NEAR(structure.affine.gaussian_curvature, std::pow(r, -3), 1e-13);
  const auto attributes =
      compute_attributes(traits, points, select_attributes("affine_mean_curvature,pick_invariant_gradient"));
  ASSERT_GT(attributes.columns.size(), 1U);
  for (const double H : attributes.columns[0].values) EXPECT_NEAR(H, -std::pow(r, -1.5), 1e-13);
}

TYPED_TEST(Archetypes, are_enough_for_points_near_the_surface) {
  const TypeParam traits{Sphere()};
  const std::vector<Kernel::Point_3> points = {{0.6, 0, 0.81}, {1, 0, 0}};
  const auto foot = project_to_surface(traits, points[0], 0.1);
  EXPECT_TRUE(foot.has_converged);
  EXPECT_NEAR(std::hypot(foot.point.x(), foot.point.y(), foot.point.z()), 1, 1e-15);
  const double f = 0.36 + 0.81 * 0.81 - 1;
  EXPECT_NEAR(max_distance_to_surface(traits, points), f / (2 * std::sqrt(1 + f)), 1e-15);
  const auto zero = intersect_segment(traits, {0, 0, 0}, {0, 0, 1.5}, -1., 1.25);
  EXPECT_TRUE(zero.has_converged);
  EXPECT_NEAR(zero.point.z(), 1, 1e-15);
}

TYPED_TEST(Archetypes, are_enough_for_samples_and_fields) {
  const TypeParam traits{Sphere()};
  const Lattice_3<Kernel> lattice({3, 3, 3}, CGAL::Bbox_3(0, 0, 0, 2, 2, 2));
  const auto volume = sample_on_lattice(traits, lattice);
  EXPECT_EQ(volume(2, 1, 0), 4);
  EXPECT_EQ(sampling_lattice(traits, {4, 4, 4}).size()[0], 4U);
  const Other_kernel::Point_3 inside(0, 0, 0.5), outside(0, 0, 2);
  EXPECT_EQ(Value_of_function_3(traits)(outside), 3);
  EXPECT_EQ(Gradient_of_function_3(traits)(outside), Other_kernel::Vector_3(0, 0, 1));
  Other_kernel::Point_3 p;
  EXPECT_TRUE(Edge_intersection_of_function_3(traits)(inside, outside, -0.75, 3., 0, 1.25, p));
  EXPECT_NEAR(p.z(), 1.5, 1e-15);
}

/// Expects every member that a wrapper of `Base` has to answer for a function that is zero at (2, 0, 0), with that
/// derivative along x.
template <class Base, class Traits>
void expect_members(const Traits& traits, double slope) {
  const CGAL::Bbox_3 box(1.9, -0.1, -0.1, 2.1, 0.1, 0.1);
  const std::vector<Kernel::Point_3> points = {{2, 0, 0}};
  std::vector<double> values(1);
  std::vector<Jet_3<double>> jets(1);
  std::vector<Jet_3<double, 1>> first_orders(1);
  EXPECT_NEAR(traits.value(points[0]), 0, 1e-15);
  EXPECT_NEAR(traits.taylor(points[0]).coefficient(1, 0, 0), slope, 1e-15);
  EXPECT_NEAR(first_order(traits, points[0]).coefficients()[1], slope, 1e-15);
  EXPECT_TRUE(first_order_bounds(traits, box).coefficients()[1].contains(slope));
  EXPECT_TRUE(tight_first_order_bounds(traits, box).coefficients()[1].contains(slope));
  EXPECT_EQ(rounding(traits, points[0]) > 0, HasRounding<Base>);
  EXPECT_EQ(certainty(traits, points[0]) < 1, HasCertainty<Base>);
  EXPECT_EQ(sampling_lattice(traits, {4, 4, 4}).size()[2], 4U);
  ASSERT_EQ(fifth_order(traits, points[0]).has_value(), HasFifthOrder<Base>);
  if (const auto jet = fifth_order(traits, points[0])) {
    EXPECT_NEAR(jet->coefficient(1, 0, 0), slope, 1e-15);
  }
  if constexpr (SecondOrderBoundedImplicitFunctionTraits_3<Traits>) {
    EXPECT_TRUE(traits.second_order_bounds(box).coefficients()[1].contains(slope));
  }
  if constexpr (RestrictableImplicitFunctionTraits_3<Traits>) {
    EXPECT_NEAR(traits.restricted(box)->value(points[0]), 0, 1e-15);
  }
  if constexpr (BatchImplicitFunctionTraits_3<Traits>) {
    values[0] = 1;
    traits.values(points, values);
    traits.taylors(points, jets);
    EXPECT_NEAR(values[0], 0, 1e-15);
    EXPECT_NEAR(jets[0].coefficient(1, 0, 0), slope, 1e-15);
  }
  if constexpr (FirstOrderBatchImplicitFunctionTraits_3<Traits>) {
    traits.first_orders(points, first_orders);
    EXPECT_NEAR(first_orders[0].coefficients()[1], slope, 1e-15);
  }
  if constexpr (PackImplicitFunctionTraits_3<Traits>) {
    const std::vector<Pack<double>> x = {Pack<double>(2)}, y = {Pack<double>(0)};
    std::vector<Jet_3<Pack<double>>> packs(1);
    traits.taylor_packs(x, y, y, packs);
    EXPECT_NEAR(packs[0].coefficient(1, 0, 0)[0], slope, 1e-15);
  }
  if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
    const Lattice_3<Kernel> lattice = traits.lattice();
    const double sample = traits.sample(1, 2, 3), value = traits.value(lattice.point(1, 2, 3));
    EXPECT_NEAR(sample, value, 1e-12);
  }
}

TYPED_TEST(Archetypes, are_enough_for_wrappers) {
  const TypeParam traits{Sphere()};
  const Level_set_traits_3<TypeParam> level_set(traits, 3.);
  expect_members<TypeParam>(level_set, 4);
  expect_members<TypeParam>(Level_set_traits_3<TypeParam>(traits, 3., Orientation_of_level_set::AGAINST_GRADIENT), -4);
  const CGAL::Aff_transformation_3<Kernel> scaling(CGAL::SCALING, 2);
  expect_members<TypeParam>(Transformed_function_traits_3<TypeParam>(traits, scaling), 1);
  expect_members<TypeParam>(Batch_function_traits_3<Level_set_traits_3<TypeParam>>(level_set), 4);
  expect_members<TypeParam>(Any_function_3::make(level_set), 4);
  expect_sphere(marching_cubes(Any_function_3::make(Batch_function_traits_3<TypeParam>(traits)), {.resolution = 12}));
}

TEST(Archetypes_of_functions, with_bounds_are_enough_to_skip_empty_space) {
  expect_sphere(marching_cubes(Bounded{Sphere()}, {.resolution = 20}));
  expect_sphere(marching_cubes(Restrictable{Sphere()}, {.resolution = 20}));
}

TEST(Archetypes_of_functions, may_have_another_kernel_or_floats) {
  expect_sphere(marching_cubes(archetypes::Implicit_function<Other_kernel>{Sphere()}, {.resolution = 12}));
  const archetypes::Implicit_function<Floats> floats{Sphere()};
  expect_sphere(marching_cubes(floats, {.resolution = 12}), 1e-6);
  EXPECT_NEAR(local_structure_at(floats, {0, 2, 0}).affine.gaussian_curvature, 0.125F, 1e-6F);
}

TEST(Archetypes_of_functions, are_enough_for_parabolic_curves) {
  const archetypes::Implicit_function<Kernel, Torus> torus{Torus()};
  const auto curves = parabolic_curves(marching_cubes(torus, {.resolution = 24}), torus);
  ASSERT_EQ(curves.polylines.size(), 2U) << "the top and the bottom circle";
  for (const auto& curve : curves.polylines)
    for (const auto& p : curve.points) EXPECT_NEAR(std::hypot(p.x(), p.y()), 1, 1e-12);
}

/// A functor that returns what can be converted to the type of its arguments.
class Functor {
public:
  explicit Functor(Sphere) {}
  Functor(const Functor&) = default;
  Functor& operator=(const Functor&) = delete;
  template <class T>
  archetypes::Convertible_to<T> operator()(const T& x, const T& y, const T& z) const {
    return archetypes::Convertible_to<T>(Sphere::at(x, y, z));
  }
};

/// What can be called with a point.
class Functor_of_points {
public:
  explicit Functor_of_points(Sphere) {}
  Functor_of_points(const Functor_of_points&) = delete;
  Functor_of_points& operator=(const Functor_of_points&) = delete;
  archetypes::Convertible_to<double> operator()(const Kernel::Point_3& p) const {
    return archetypes::Convertible_to<double>(Sphere::at(p.x(), p.y(), p.z()));
  }
};

TEST(Archetypes_of_functors, of_coordinates_are_enough_for_a_function) {
  const auto traits = make_analytic_traits<Kernel>(Functor{Sphere()}, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  expect_sphere(marching_cubes(traits, {.resolution = 12}));
  EXPECT_NEAR(local_structure_at(traits, {0, 2, 0}).affine.gaussian_curvature, 0.125, 1e-14);
  EXPECT_TRUE(traits.second_order_bounds(traits.bbox()).value().contains(11));
}

TEST(Archetypes_of_functors, of_points_are_enough_for_samples) {
  const Lattice_3<Kernel> lattice({3, 3, 3}, CGAL::Bbox_3(0, 0, 0, 2, 2, 2));
  EXPECT_EQ(sample_on_lattice(Functor_of_points{Sphere()}, lattice)(2, 1, 0), 4);
}

} // namespace archetypes_test
