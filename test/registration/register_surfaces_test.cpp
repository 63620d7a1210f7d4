// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include "support/registration_traits.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/registration/is_affinely_equivalent.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace register_surfaces_test {

using namespace equiaffine;
using namespace registration_cases;
using Result = Surface_registration_3<Kernel>;

Surface named(const std::string& name) {
  for (const Surface& s : generic_surfaces())
    if (s.name == name) return s;
  throw std::invalid_argument(name);
}

/// A surface and its image under a map, each with points of its own.
struct Pair {
  Formula source;
  Map map;
  Image target;
  std::vector<Point_3> points, target_points;

  Pair(const Surface& surface, const Map& m)
      : source(surface.traits()), map(m), target(source, m), points(points_on_surface(source, 24)),
        target_points(points_on_surface(target, 27)) {}

  Result result(const Registration_options& options = {}) const {
    return register_surfaces(source, points, target, target_points, options);
  }
};

void expect_map(const Result& result, const Map& map) {
  ASSERT_TRUE(result.found());
  EXPECT_LT(error_of(result.best().map, map), 1e-12);
  EXPECT_LT(result.best().log10_false_alarms, -50);
  EXPECT_LE(result.hypotheses, 4u);
  EXPECT_LT(result.best().rms, 1e-12);
  EXPECT_EQ(result.slippage.dimension(), 0u);
}

TEST(Register_surfaces, one_pair_of_points_gives_the_affine_map_reflections_included) {
  Random random(1);
  const Map mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  for (const char* name : {"quartic", "torus+", "graph"}) {
    const Map map = random_map(random, 10, random.uniform(0.2, 5));
    for (const Map& m : {map, map * mirror}) {
      SCOPED_TRACE(name);
      const Result result = Pair(named(name), m).result();
      expect_map(result, m);
      EXPECT_GT(result.best().inliers[0], 0.9);
      EXPECT_GT(result.best().inliers[1], 0.8) << "less than 1 where the surface goes on beyond its box";
    }
  }
}

TEST(Register_surfaces, maps_of_fewer_parameters_are_of_their_kind) {
  Random random(2);
  const Map equiaffine_map = random_map(random, 5, 1);
  expect_map(Pair(named("heart+"), equiaffine_map).result({.kind = Map_kind::EQUIAFFINE}), equiaffine_map);
  const Eigen::Matrix3d rotation = random_rotation(random);
  for (const auto& [kind, scale] : {std::pair(Map_kind::RIGID, -1.0), std::pair(Map_kind::SIMILARITY, 1.7)}) {
    const Map map = map_of(scale * rotation, Eigen::Vector3d(1, 2, 3));
    const Result result = Pair(named("ellipsoid+"), map).result({.kind = kind});
    expect_map(result, map);
    const Eigen::Matrix3d found = matrix_of(result.best().map) / scale;
    EXPECT_LT((found * found.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  }
}

TEST(Register_surfaces_long, a_mirror_image_is_found_by_a_reflection_only) {
  const Pair mirrored(named("quartic"), map_of(-Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()));
  expect_map(mirrored.result(), mirrored.map);
  const Result none = mirrored.result({.reflections = false});
  EXPECT_FALSE(none.found());
  EXPECT_TRUE(none.maps.empty());
}

TEST(Register_surfaces, surfaces_that_have_nothing_in_common_have_no_map) {
  Random random(3);
  const Pair one(named("quartic"), random_map(random, 3, 1)), other(named("blobs5"), random_map(random, 3, 1));
  const Result result = register_surfaces(one.source, one.points, other.target, other.target_points);
  EXPECT_FALSE(result.found());
}

// Flat caps are near to each other to a high order.
TEST(Register_surfaces, flat_caps_that_are_near_each_other_are_no_map) {
  const Formula tapered = Surface{"", "(x/(1+.3*z))^4+(y/(1+.3*z))^4+z^4-1", cube(2)}.traits(),
                straight = Surface{"", "x^4+y^4+z^4-1", cube(2)}.traits();
  const Result result =
      register_surfaces(tapered, points_on_surface(tapered, 24), straight, points_on_surface(straight, 27));
  EXPECT_FALSE(result.found());
}

TEST(Register_surfaces, each_pair_of_points_is_tried_once_where_none_gives_a_map) {
  const Formula source = named("blobs5").traits(), target = named("blobs8").traits();
  const Result result = register_surfaces(source, points_on_surface(source, 8), target, points_on_surface(target, 8));
  EXPECT_FALSE(result.found());
  EXPECT_GT(result.hypotheses, 150u) << "pairs that are less alike are tried, too";
  EXPECT_LT(result.hypotheses, 250u) << "there are 218 of different pairs, and 286 if those that are alike come twice";
}

TEST(Register_surfaces_long, much_noise_makes_no_map_between_surfaces_that_have_nothing_in_common) {
  const auto surfaces = generic_surfaces();
  for (const std::size_t i : {std::size_t(0), surfaces.size() - 2}) {
    const auto source = surfaces[i].traits(), target = surfaces[i + 1].traits();
    Random random(7);
    auto points = points_on_surface(source, 24);
    for (Point_3& p : points)
      p = Point_3(p.x() + 0.02 * random.normal(), p.y() + 0.02 * random.normal(), p.z() + 0.02 * random.normal());
    EXPECT_FALSE(register_surfaces(source, points, target, points_on_surface(target, 24)).found()) << surfaces[i].name;
  }
}

TEST(Register_surfaces, a_piece_is_found_in_the_whole_with_few_points) {
  Random random(4);
  const Map map = random_map(random, 5, 2);
  const Pair pair(named("tangle+"), map);
  const CGAL::Bbox_3 corner(0, 0, -3, 3, 3, 3);
  const Formula piece(pair.source.function(), corner);
  const auto points = points_on_surface(piece, 24);
  const std::vector<Point_3> few(pair.target_points.begin(), pair.target_points.begin() + 100);
  const Result result = register_surfaces(piece, points, pair.target, few);
  ASSERT_TRUE(result.found());
  EXPECT_LT(error_of(result.best().map, map), 1e-12);
  EXPECT_GT(result.best().inliers[0], 0.95) << "the whole piece lies on the target";
  EXPECT_LT(result.best().inliers[1], 0.6) << "the piece covers a part of the target";
}

TEST(Register_surfaces_long, wrong_derivatives_take_more_hypotheses_but_change_no_map) {
  Random random(500);
  for (const char* name : {"ellipsoid+", "heart+"}) {
    SCOPED_TRACE(name);
    const Pair pair(named(name), random_map(random, 10, 2));
    const Disturbed<Formula> source{pair.source, 0.1, 0.05, 1};
    const Disturbed<Image> target{pair.target, 0.1, 0.05, 2};
    const Result result = register_surfaces(source, pair.points, target, pair.target_points);
    ASSERT_TRUE(result.found());
    EXPECT_LT(error_of(result.best().map, pair.map), 1e-12);
  }
}

TEST(Register_surfaces, all_maps_are_found_when_asked) {
  // A surface with one symmetry, the reflection of x: two maps lead to its image.
  const Surface symmetric = {"", "x^4+y^4+z^4-1+.3*x^2*y-.2*x^2*z+.25*y^3+.3*y*z+.15*z^3-.2*y*z^2", cube(1.6)};
  Random random(5);
  const Map map = random_map(random, 4, 1.5);
  const Pair pair(symmetric, map);
  const Result result = pair.result({.number_of_maps = 5});
  ASSERT_EQ(result.maps.size(), 2u);
  const Map mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  const double first = error_of(result.maps[0].map, map), second = error_of(result.maps[1].map, map);
  EXPECT_LT(std::min(first, second), 1e-12);
  EXPECT_LT(std::min(error_of(result.maps[0].map, map * mirror), error_of(result.maps[1].map, map * mirror)), 1e-12);
  ASSERT_TRUE(result.next_best_rms);
  EXPECT_LT(*result.next_best_rms, 1e-12);
}

TEST(Register_surfaces, threads_give_the_same_bits) {
  Random random(6);
  const Pair pair(named("sextic"), random_map(random, 5, 2));
  const Result one = pair.result();
  const Result many =
      register_surfaces<CGAL::Parallel_if_available_tag>(pair.source, pair.points, pair.target, pair.target_points);
  ASSERT_TRUE(one.found() && many.found());
  EXPECT_EQ(matrix_of(one.best().map), matrix_of(many.best().map));
  EXPECT_EQ(one.best().log10_false_alarms, many.best().log10_false_alarms);
  EXPECT_EQ(one.best().rms, many.best().rms);
  EXPECT_EQ(one.hypotheses, many.hypotheses);
}

TEST(Register_surfaces, quadrics_have_generators_and_one_map_of_many) {
  const std::vector<std::pair<Surface, std::size_t>> cases = {
      {{"ellipsoid", "x^2+2*y^2+3*z^2+.3*x*y+.2*x-1", cube(1.3)}, 3},
      {{"hyperboloid", "x^2+2*y^2-z^2-.5", cube(1.2)}, 3},
      {{"paraboloid", "z-x^2-.5*y^2", CGAL::Bbox_3(-1, -1, -.5, 1, 1, 1)}, 4}};
  Random random(8);
  for (const auto& [surface, dimension] : cases) {
    SCOPED_TRACE(surface.name);
    const Result result = Pair(surface, random_map(random, 4, 2)).result();
    EXPECT_EQ(result.slippage.dimension(), dimension);
    ASSERT_TRUE(result.found());
    EXPECT_LT(result.best().rms, 1e-12);
    EXPECT_GT(result.best().inliers[0], 0.1) << "the other points leave the box";
  }
}

TEST(Register_surfaces, quadrics_whose_axes_differ_have_rigid_maps_from_pairs_of_points) {
  Random random(10);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, 2, 3));
  const Pair ellipsoids({"", "x^2+2*y^2+3*z^2-1", cube(1.2)}, map);
  const Result result = ellipsoids.result({.kind = Map_kind::RIGID, .number_of_maps = 20});
  EXPECT_EQ(result.maps.size(), 8u) << "an ellipsoid has as many rigid symmetries";
  EXPECT_EQ(result.slippage.dimension(), 0u);
  for (const auto& found : result.maps) {
    EXPECT_LT(found.rms, 1e-12);
    ASSERT_TRUE(found.pair);
    const auto& [points, frames] = *found.pair;
    EXPECT_LT(std::sqrt(CGAL::squared_distance(found.map(points[0]), points[1])), 1e-6);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(std::sqrt((found.map(frames[0][k]) - frames[1][k]).squared_length()), 1e-5)
          << "frames are carried along";
  }
}

TEST(Register_surfaces, equivalent_surfaces_are_moved_onto_each_other_all_of_them) {
  Random random(9);
  const auto are_equivalent = [](const auto& source, const auto& points, const Pair& pair) {
    return is_affinely_equivalent(source, points, pair.target, pair.target_points);
  };
  const Pair pair(named("quartic"), random_map(random, 5, 2));
  EXPECT_TRUE(are_equivalent(pair.source, pair.points, pair));
  const Formula piece(pair.source.function(), CGAL::Bbox_3(0, -2, -2, 2, 2, 2));
  EXPECT_FALSE(are_equivalent(piece, points_on_surface(piece, 24), pair)) << "a half is not the whole";
  const Pair ellipsoids({"", "x^2+2*y^2+3*z^2-1", cube(1.2)}, random_map(random, 5, 2));
  EXPECT_TRUE(are_equivalent(ellipsoids.source, ellipsoids.points, ellipsoids));
  const Pair bars(
      {"", "min(min(max(x^2+y^2-.04,abs(z)-1),max(x^2+z^2-.04,abs(y)-1)),max(y^2+z^2-.04,abs(x)-1))", cube(1.2)},
      random_map(random, 3, 2));
  const auto not_at_all = are_equivalent(ellipsoids.source, ellipsoids.points, bars);
  ASSERT_TRUE(not_at_all.is_certain()) << "no rotation moves one near the other";
  EXPECT_FALSE(not_at_all);
  const Formula cut({Expression_3("x^3 - x*y^2 + z*(1 + y) + x*z^2/3")}, cube(1));
  EXPECT_FALSE(are_equivalent(cut, points_on_surface(cut, 20), ellipsoids).is_certain()) << "it leaves its box";
}

TEST(Register_surfaces, planes_and_three_points_have_no_map) {
  const Formula plane(Expression_3("x + 2*y - z"), cube(1));
  const auto points = points_on_surface(plane, 10);
  const Result none = register_surfaces(plane, points, plane, points);
  EXPECT_FALSE(none.found());
  EXPECT_EQ(none.advice,
            (std::vector{Registration_advice::SIMILARITIES_OF_FRAMES, Registration_advice::MORE_IN_COMMON}));
  const Formula surface = named("quartic").traits();
  const auto all = points_on_surface(surface, 20);
  const std::vector<Point_3> three(all.begin(), all.begin() + 3);
  EXPECT_FALSE(register_surfaces(surface, three, surface, three).found());
}

TEST(Register_surfaces, a_surface_that_ends_does_not_slide_as_that_which_goes_on) {
  const Formula sphere = Surface{"", "x^2+y^2+z^2-1", cube(2)}.traits();
  const Formula half = Surface{"", "z-sqrt(1-x^2-y^2)", cube(2)}.traits();
  const auto points = points_on_surface(sphere, 31), points_of_half = points_on_surface(half, 31);
  EXPECT_EQ(register_surfaces(sphere, points, sphere, points).slippage.dimension(), 3u);
  EXPECT_EQ(register_surfaces(half, points_of_half, half, points_of_half).slippage.dimension(), 0u);
}

TEST(Register_surfaces, what_makes_no_sense_is_refused) {
  const Formula surface = named("quartic").traits();
  const auto points = points_on_surface(surface, 10);
  const std::vector<Point_3> none;
  EXPECT_THROW(register_surfaces(surface, none, surface, points), std::invalid_argument);
  EXPECT_THROW(register_surfaces(surface, points, surface, none), std::invalid_argument);
  const auto wrong_field = [&](const Registration_options& options) -> std::string {
    try {
      register_surfaces(surface, points, surface, points, options);
    } catch (const Input_error& error) {
      return error.field();
    }
    return "none";
  };
  EXPECT_EQ(wrong_field({.min_overlap = 2}), "min_overlap");
  EXPECT_EQ(wrong_field({.number_of_maps = 0}), "number_of_maps");
  EXPECT_EQ(wrong_field({.tolerance = -1}), "tolerance");
  EXPECT_EQ(wrong_field({.fit = {.degree = 3}}), "fit.degree");
}

} // namespace register_surfaces_test
