// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace affine_symmetries_test {

using namespace equiaffine;
using namespace registration_cases;

static_assert(internal::origin_of<Formula> == internal::Surface_origin::FUNCTION);
static_assert(internal::origin_of<Transformed_function_traits_3<Sampled_function_traits_3<Kernel>>> ==
              internal::Surface_origin::SPLINE);
static_assert(internal::origin_of<Level_set_traits_3<Fitted_function_traits_3<Kernel>>> ==
              internal::Surface_origin::FIT);

struct Expected {
  std::string formula;
  CGAL::Bbox_3 box;
  std::size_t number; ///< of symmetries, or the dimension of the continuous ones
};

const std::string icosahedral =
    "x^2+y^2+z^2-1+.35*(2.618033988749895*x^2-y^2)*(2.618033988749895*y^2-z^2)*(2.618033988749895*z^2-x^2)";

/// The symmetries of a surface, or of its image under a map.
Affine_symmetries_3<Kernel> symmetries(const Expected& e, const std::optional<Map>& map, std::size_t nodes) {
  const Formula formula = Surface{"", e.formula, e.box}.traits();
  if (!map) return affine_symmetries(formula, points_on_surface(formula, nodes));
  const Image image(formula, *map);
  return affine_symmetries(image, points_on_surface(image, nodes));
}

TEST(Affine_symmetries, finite_groups_are_complete_for_originals_and_affine_images) {
  const std::vector<Expected> cases = {{"x^6+2*y^6+.5*z^6-1", cube(1.3), 48},
                                       {"x^6+1.5*y^6+.7*z^6+.8*x^2*y^2-1", cube(1.3), 16},
                                       {"x^4+y^4+z^4+1.2*x*y*z-1", cube(1.6), 24},
                                       {"(x^2*(1-x^2)-y^2)^2+.5*z^2-.03", CGAL::Bbox_3(-1.4, -1, -.6, 1.4, 1, .6), 8},
                                       {icosahedral, cube(1.6), 120},
                                       {generic_surfaces()[0].formula, cube(1.8), 1}};
  Random random(4);
  for (const Expected& e : cases)
    for (const auto& map : {std::optional<Map>(), std::optional<Map>(random_map(random, 5, 2))}) {
      const auto result = symmetries(e, map, 30);
      EXPECT_EQ(result.order(), e.number) << e.formula;
      EXPECT_EQ(error_of(result.maps.front().map, Map(CGAL::IDENTITY)), 0);
      for (const auto& s : result.maps) EXPECT_LT(s.rms, 1e-12);
      for (const auto& a : result.maps) {
        const auto is_square = [&](const auto& b) { return error_of(b.map, a.map * a.map) < 1e-9; };
        EXPECT_TRUE(std::any_of(result.maps.begin(), result.maps.end(), is_square)) << "the group is closed";
      }
    }
}

TEST(Affine_symmetries_long, a_group_is_complete_where_the_box_cuts_off_images_of_generic_points) {
  for (const std::size_t nodes : {36u, 40u, 46u})
    EXPECT_EQ(symmetries({icosahedral, cube(1.6), 120}, std::nullopt, nodes).order(), 120u) << nodes << " nodes";
}

// Moments of lines are off by more than it differs from an ellipsoid.
TEST(Affine_symmetries_long, a_near_ellipsoid_has_those_of_what_tells_it_from_one) {
  const auto result = symmetries({"x^2+2*y^2+3*z^2-1+1e-3*(x^4+4*y^4)", cube(2), 16}, {}, 30);
  EXPECT_EQ(result.order(), 16u);
  EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT);
}

TEST(Affine_symmetries, continuous_ones_have_generators) {
  const std::vector<Expected> cases = {{"x^2+2*y^2+3*z^2+.3*x*y-1", cube(1.2), 3},
                                       {"x^2+2*y^2-z^2-.5", cube(1.2), 3},
                                       {"z-x^2-.5*y^2", CGAL::Bbox_3(-1, -1, -.5, 1, 1, 1), 4},
                                       {"(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)", cube(1.6), 1},
                                       {"x*y*z-1", CGAL::Bbox_3(.3, .3, .3, 2, 2, 2), 2},
                                       {"z-x*y+x^3/3", cube(1), 3},
                                       {"x*sin(z)-y*cos(z)", CGAL::Bbox_3(.3, .3, 0, 1.5, 1.5, 1.5), 2}};
  Random random(5);
  for (const Expected& e : cases)
    for (const auto& map : {std::optional<Map>(), std::optional<Map>(random_map(random, 5, 2))}) {
      const auto result = symmetries(e, map, 20);
      EXPECT_EQ(result.continuous.dimension(), e.number) << e.formula;
      EXPECT_EQ(result.order(), std::nullopt);
      EXPECT_EQ(result.maps.size(), 1u) << "the identity";
    }
}

/// The symmetries of a kind of the image of a surface under a similarity.
Affine_symmetries_3<Kernel> symmetries_of_kind(const Expected& e, Map_kind kind, bool with_reflections) {
  Random random(6);
  const Formula formula = Surface{"", e.formula, e.box}.traits();
  const Image image(formula, map_of(1.3 * random_rotation(random), Eigen::Vector3d(1, 2, 3)));
  return affine_symmetries(image, points_on_surface(image, 24), {.kind = kind, .reflections = with_reflections});
}

TEST(Affine_symmetries_long, rigid_ones_are_finite_groups_where_affine_ones_are_continuous_or_more) {
  const CGAL::Bbox_3 scherk(-1.4, -1.4, -1.4, 1.4, 1.4, 1.4), octant(.3, .3, .3, 2, 2, 2);
  const std::vector<Expected> cases = {{"x^2+2*y^2+3*z^2-1", cube(1.2), 8},
                                       {"x^2+2*y^2-z^2-.5", cube(1.2), 8},
                                       {"z-x^2+.5*y^2", cube(1), 4},
                                       {"z-x^2+y^2", cube(1), 8},
                                       {"x*y*z-1", octant, 6},
                                       {"(x^2/2+y^2+z^2+.84)^2-4*(x^2/2+y^2)", cube(2.2), 8},
                                       {"exp(z)*cos(x)-cos(y)", scherk, 8},
                                       {"x^4+y^4+z^4-1", cube(1.2), 48},
                                       {"x^6+2*y^6+.5*z^6-1", cube(1.3), 8},
                                       {"x^4+y^4+z^4+1.2*x*y*z-1", cube(1.6), 24}};
  for (const Expected& e : cases)
    for (const auto& [kind, with_reflections] :
         {std::pair(Map_kind::RIGID, true), {Map_kind::RIGID, false}, {Map_kind::SIMILARITY, true}}) {
      const auto result = symmetries_of_kind(e, kind, with_reflections);
      EXPECT_EQ(result.order(), with_reflections ? e.number : e.number / 2) << e.formula;
      for (const auto& s : result.maps) {
        EXPECT_LT(s.rms, 1e-12);
        const Eigen::Matrix3d matrix = matrix_of(s.map);
        EXPECT_LT((matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12) << e.formula;
        EXPECT_TRUE(with_reflections || matrix.determinant() > 0);
      }
    }
  const Expected nearly_round = {"x^2+y^2+z^2-1+1e-4*x*y*z", cube(1.2), 24};
  EXPECT_EQ(symmetries_of_kind(nearly_round, Map_kind::RIGID, true).order(), nearly_round.number);
}

TEST(Affine_symmetries, the_dimension_of_continuous_ones_is_that_of_their_kind) {
  const auto dimension = [](const Expected& e, Map_kind kind) {
    return symmetries_of_kind(e, kind, true).continuous.dimension();
  };
  const Expected torus = {"(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)", cube(1.6), 0}, sphere = {"x^2+y^2+z^2-1", cube(1.2), 0},
                 cone = {"x^2+2*y^2-3*z^2", cube(1), 0}, ellipsoid = {"x^2+2*y^2+3*z^2-1", cube(1.2), 0};
  EXPECT_EQ(dimension(torus, Map_kind::RIGID), 1u);
  EXPECT_EQ(dimension(sphere, Map_kind::RIGID), 3u);
  EXPECT_EQ(dimension(cone, Map_kind::RIGID), 0u);
  EXPECT_EQ(dimension(cone, Map_kind::SIMILARITY), 1u);
  EXPECT_EQ(dimension(ellipsoid, Map_kind::SIMILARITY), 0u);
  EXPECT_EQ(dimension(ellipsoid, Map_kind::EQUIAFFINE), 3u);
}

TEST(Affine_symmetries, generators_are_tangent_to_the_surface) {
  const Formula torus(Expression_3("(sqrt(x^2+y^2)-2)^2+(z-1)^2-.49"), CGAL::Bbox_3(-3, -3, 0, 3, 3, 2));
  const auto result = affine_symmetries(torus, points_on_surface(torus, 20));
  ASSERT_EQ(result.continuous.dimension(), 1u);
  const auto& [matrix, translation] = result.continuous.generators[0];
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(0, 1) = -matrix(1, 0);
  turn(1, 0) = matrix(1, 0);
  EXPECT_LT((matrix - turn).norm(), 1e-12 * matrix.norm()) << "it turns about the z axis";
  EXPECT_LT(translation.norm(), 1e-12 * matrix.norm());
}

TEST(Affine_symmetries_long, a_slightly_disturbed_surface_has_those_within_the_tolerance) {
  const Expected disturbed = {"x^6+2*y^6+.5*z^6-1+.0001*(x^3+.7*y^3*x-.4*z^3*y+.5*x*y*z)", cube(1.3), 48};
  EXPECT_EQ(symmetries(disturbed, {}, 30).order(), 1u);
  const Formula formula = Surface{"", disturbed.formula, disturbed.box}.traits();
  EXPECT_EQ(affine_symmetries(formula, points_on_surface(formula, 30), {.tolerance = 1e-3}).order(), 48u);
}

Affine_symmetries_3<Kernel> rigid_symmetries(const Expected& e) {
  const Formula formula = Surface{"", e.formula, e.box}.traits();
  return affine_symmetries<CGAL::Parallel_if_available_tag>(formula, points_on_surface(formula, 31),
                                                            {.kind = Map_kind::RIGID});
}

TEST(Affine_symmetries_long, a_small_bump_leaves_those_that_keep_it) {
  for (const std::string height : {"1e-6", "1e-7"}) {
    const auto result = rigid_symmetries({"x^8+y^8+z^8-1+" + height + "*exp(-30*((x-1)^2+y^2+z^2))", cube(2), 8});
    EXPECT_EQ(result.order(), 8u) << height;
    EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT) << height;
    ASSERT_EQ(result.levels.size(), 2u) << height;
    EXPECT_EQ(result.levels[1].order(), 48u) << height;
    EXPECT_NEAR(result.levels[1].greatest, std::stod(height) / 10, std::stod(height) / 50);
  }
}

TEST(Affine_symmetries, groups_with_many_rotations_are_complete) {
  EXPECT_EQ(rigid_symmetries({"x^2+y^2+z^2-1+.2*cos(17*atan2(y,x))*(x^2+y^2)^8", cube(2), 68}).order(), 68u);
  EXPECT_EQ(rigid_symmetries({"x^2+y^2+z^2-1+.005*cos(60*atan2(y,x))*(x^2+y^2)^8", cube(1.25), 240}).order(), 240u);
}

TEST(Affine_symmetries, a_surface_that_its_box_cuts_has_those_of_its_piece) {
  const std::string gyroid = "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)";
  for (const double half : {3.2, 6.4}) {
    const auto result = rigid_symmetries({gyroid, cube(half), 6});
    EXPECT_EQ(result.order(), 6u) << half;
    EXPECT_EQ(result.order_in_box, 6u) << half;
  }
  const auto monkey_saddle = rigid_symmetries({"z-x^3+3*x*y^2", cube(1), 12});
  EXPECT_EQ(monkey_saddle.order(), 12u) << "a group, whose images in the box are on the surface";
  EXPECT_EQ(monkey_saddle.order_in_box, 4u);
  EXPECT_EQ(rigid_symmetries({"x^4+y^4+z^4-1", cube(1.2), 48}).order_in_box, std::nullopt);
}

TEST(Affine_symmetries, a_nearly_round_surface_slides_in_fewer_ways) {
  const auto result = rigid_symmetries({"x^2+y^2+1.000000001*z^2-1", cube(2), 1});
  EXPECT_EQ(result.continuous.dimension(), 1u);
  EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT);
}

// Velocities at the given points do not see the detail.
TEST(Affine_symmetries, a_round_surface_with_a_small_detail_slides_in_the_ways_that_keep_it) {
  for (const std::string formula : {"x^2+y^2+z^2-1+.05*exp(-20000*((x-.6)^2+y^2+(z-.8)^2))",
                                    "max(x^2+y^2+z^2-1,x-.9995)", "(x^2+y^2+z^2-1)*((x-1.5)^2+y^2+z^2-.0004)"}) {
    const auto result = symmetries({formula, cube(2), 1}, {}, 31);
    EXPECT_EQ(result.continuous.dimension(), 1u) << formula;
    EXPECT_TRUE(result.spacing) << formula;
  }
}

TEST(Affine_symmetries_long, parts_on_both_sides_of_a_jump_do_not_slide_onto_each_other) {
  const auto torus = symmetries({"(hypot(x,y)-1)^2+z^2-.09+.01*sign(y)", cube(2), 4}, {}, 31);
  EXPECT_EQ(torus.continuous.dimension(), 0u);
  EXPECT_EQ(torus.order(), 4u);
}

TEST(Affine_symmetries, a_surface_ends_where_its_function_is_undefined) {
  EXPECT_EQ(symmetries({"x^4+y^4+z^4-1+0*sqrt(x+.5)", cube(2), 8}, {}, 31).order(), 8u);
  const auto cap = symmetries({"z-sqrt(1-x^4-y^4)", cube(2), 8}, {}, 31);
  EXPECT_EQ(cap.order(), 8u);
  EXPECT_EQ(cap.order_in_box, std::nullopt) << "it lies in the box";
  const auto hemisphere = symmetries({"z-sqrt(1-x^2-y^2)", cube(2), 1}, {}, 31);
  EXPECT_EQ(hemisphere.continuous.dimension(), 0u) << "it turns about one axis, which no velocity tells from others";
  EXPECT_EQ(hemisphere.verdict, Symmetry_verdict::UNDECIDED);
  EXPECT_EQ(symmetries({"z-.3", cube(2), 9}, {}, 31).continuous.dimension(), 9u);
}

TEST(Affine_symmetries, what_makes_no_sense_is_refused) {
  const Formula surface = generic_surfaces()[0].traits();
  EXPECT_THROW(affine_symmetries(surface, std::vector<Point_3>()), std::invalid_argument);
  try {
    affine_symmetries(surface, points_on_surface(surface, 8), {.tolerance = 1});
    ADD_FAILURE() << "there is no error";
  } catch (const Input_error& error) {
    EXPECT_EQ(error.field(), "tolerance");
  }
}

} // namespace affine_symmetries_test
