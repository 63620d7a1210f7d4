// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetries of solids with faces, edges and corners, which have no curvature to go by, as formulas and as meshes.
#include "support/formulas.h"
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include "support/solids.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <vector>

namespace solid_symmetries_test {

using namespace equiaffine;
using namespace registration_cases;
using namespace solids;

constexpr Symmetry_options rigid_maps = {.kind = Map_kind::RIGID};

Affine_symmetries_3<Kernel> symmetries(const Solid& solid, const Symmetry_options& options) {
  return affine_symmetries<CGAL::Parallel_if_available_tag>(solid.points, solid.polygons, options);
}

/// Checks that maps are a group, and that each moves the corners of a solid onto its corners.
void expect_group_of_corners(const Solid& solid, const Affine_symmetries_3<Kernel>& result, const std::string& name) {
  const auto is_corner = [&](const Point_3& p) {
    return std::any_of(solid.points.begin(), solid.points.end(),
                       [&](const Point_3& q) { return CGAL::squared_distance(p, q) < 1e-12; });
  };
  for (const auto& symmetry : result.maps)
    for (const Point_3& p : solid.points) ASSERT_TRUE(is_corner(symmetry.map(p))) << name;
}

struct Solid_with_symmetries {
  std::string name;
  Solid solid;
  std::size_t rigid;                 ///< the number of symmetries
  std::optional<std::size_t> affine; ///< of an affine image, if they are to be tried
};

std::vector<Solid_with_symmetries> solids() {
  return {{"box", box(1, .7, .4), 8, 48},
          {"cube", box(1, 1, 1), 48, {}},
          {"tetrahedron", tetrahedron(), 24, {}},
          {"hexagonal prism", prism(regular(6), 1.3), 24, 24},
          {"square frustum", prism(regular(4), 1, .6), 8, {}},
          {"L", L(), 2, 2},
          {"cube without a corner", cube_without_corner(.5), 6, {}},
          {"no symmetry", {{{0, 0, 0}, {2, 0, 0}, {.3, 1.1, 0}, {.2, .4, 1.6}}, tetrahedron().polygons}, 1, 24}};
}

TEST(Solid_symmetries, meshes_have_exactly_those_of_their_corners) {
  Random random(8);
  for (const Solid_with_symmetries& e : solids()) {
    const Solid turned = moved(e.solid, map_of(1.7 * random_rotation(random), Eigen::Vector3d(1, -2, 3)));
    const auto rigid = symmetries(turned, rigid_maps);
    EXPECT_EQ(rigid.order(), e.rigid) << e.name;
    EXPECT_EQ(rigid.verdict, e.rigid > 1 ? Symmetry_verdict::EXACT : Symmetry_verdict::NONE) << e.name;
    expect_group_of_corners(turned, rigid, e.name);
    if (!e.affine) continue;
    const Solid sheared = moved(e.solid, random_map(random, 4, 2));
    const auto affine = symmetries(sheared, {});
    EXPECT_EQ(affine.order(), e.affine) << e.name;
    expect_group_of_corners(sheared, affine, e.name);
  }
}

/// The number of rigid symmetries, each of which moves the corners onto themselves.
std::optional<std::size_t> exact_order(const Solid& solid, const std::string& name) {
  const auto result = symmetries(solid, rigid_maps);
  EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT) << name;
  expect_group_of_corners(solid, result, name);
  return result.order();
}

TEST(Solid_symmetries_long, solids_with_many_sides_have_those_of_their_corners) {
  for (const std::size_t n : {14u, 17u, 24u, 60u}) {
    const std::string name = std::to_string(n);
    EXPECT_EQ(exact_order(prism(regular(n), 1), name), 4 * n) << "prism";
    EXPECT_EQ(exact_order(prism(regular(n), 1, .6), name), 2 * n) << "frustum";
    EXPECT_EQ(exact_order(twisted_prism(regular(n), 1, .5), name), 4 * n) << "antiprism";
    EXPECT_EQ(exact_order(twisted_prism(regular(n), 1, .3), name), 2 * n) << "twisted antiprism";
  }
}

TEST(Solid_symmetries, sides_that_are_nearly_equal_are_told_apart) {
  const double side = .70710678;
  for (const auto& [solid, exact, near] :
       {std::tuple(box(.7071, side, side), 16u, 48u), {box(.7071, side, .4), 8u, 16u}}) {
    const auto result = symmetries(solid, rigid_maps);
    EXPECT_EQ(result.order(), exact);
    ASSERT_EQ(result.levels.size(), 2u);
    EXPECT_EQ(result.levels[1].order(), near);
    EXPECT_GT(result.levels[1].greatest, 6e-6);
    EXPECT_LT(result.levels[1].greatest, 1e-5);
  }
}

TEST(Solid_symmetries, coordinates_with_few_digits_have_exact_ones_to_within_these) {
  Solid solid = prism(regular(17), 1);
  for (Point_3& p : solid.points) p = Point_3(std::round(1e6 * p.x()) / 1e6, std::round(1e6 * p.y()) / 1e6, p.z());
  const auto result = symmetries(solid, rigid_maps);
  EXPECT_EQ(result.order(), 68u);
  EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT);
}

TEST(Solid_symmetries_long, formulas_with_edges_have_theirs) {
  struct Case {
    const char* formula;
    std::size_t rigid;
  };
  const std::vector<Case> cases = {{"max(max(abs(x)-1, abs(y)-.7), abs(z)-.4)", 8},
                                   {"min(max(x^2+y^2-.16, abs(z)-1), max(x^2+z^2-.16, abs(y)-1))", 16},
                                   {"max(abs(z)-.3, max(abs(x), abs(y)) - .8 + .5*z)", 8},
                                   {"max(max(abs(x)+abs(y), abs(y)+abs(z)), abs(x)+abs(z)) - 1", 48}};
  for (const auto& [formula, rigid] : cases) {
    const Formula traits = Surface{"", formula, cube(1.5)}.traits();
    const auto result =
        affine_symmetries<CGAL::Parallel_if_available_tag>(traits, points_on_surface(traits, 20), rigid_maps);
    EXPECT_EQ(result.order(), rigid) << formula;
    EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT) << formula;
  }
}

TEST(Solid_symmetries, all_rotations_are_searched_where_that_is_asked_for) {
  const Formula traits = Surface{"", "(x^2*(1-x^2)-y^2)^2+.5*z^2-.03", cube(2)}.traits();
  const auto points = points_on_surface(traits, 20);
  for (const Map_kind kind : {Map_kind::RIGID, Map_kind::AFFINE}) {
    const auto by_frames = affine_symmetries<CGAL::Parallel_if_available_tag>(traits, points, {.kind = kind});
    EXPECT_EQ(by_frames.order(), 8u);
    EXPECT_FALSE(by_frames.complete_to);
    const auto complete =
        affine_symmetries<CGAL::Parallel_if_available_tag>(traits, points, {.kind = kind, .complete = true});
    EXPECT_EQ(complete.order(), 8u);
    ASSERT_TRUE(complete.complete_to);
    EXPECT_GT(*complete.complete_to, kind == Map_kind::RIGID ? .01 : .005) << "a lower bound for affine maps";
  }
}

TEST(Solid_symmetries_long, a_greater_tolerance_never_finds_fewer) {
  const Solid cube = cube_without_corner(.5);
  const auto all = symmetries(cube, rigid_maps);
  ASSERT_EQ(all.levels.size(), 2u);
  EXPECT_EQ(all.levels[0].order(), 6u);
  EXPECT_EQ(all.levels[1].order(), 48u);
  EXPECT_GT(all.levels[1].rms, 1e-3);
  std::size_t before = 1;
  for (const double tolerance : {1e-6, .002, .02, .09}) {
    const auto result = symmetries(cube, {.kind = Map_kind::RIGID, .tolerance = tolerance});
    if (!result.order()) continue;
    EXPECT_GE(*result.order(), before) << tolerance;
    before = *result.order();
  }
  EXPECT_EQ(before, 48u);
}

TEST(Solid_symmetries_long, nothing_is_said_of_a_tolerance_that_other_maps_reach) {
  const Solid nearly_square = box(1, 1.08, .3);
  const auto order = [&](double tolerance) {
    return symmetries(nearly_square, {.kind = Map_kind::RIGID, .tolerance = tolerance}).order();
  };
  EXPECT_EQ(order(1e-3), 8u);
  EXPECT_NE(order(.06), 8u) << "a turn by a right angle moves the box by less";
  const Solid prism16 = prism(regular(16), 1);
  EXPECT_EQ(symmetries(prism16, {.kind = Map_kind::RIGID, .tolerance = 1e-6}).order(), 64u);
  EXPECT_EQ(symmetries(prism16, {.kind = Map_kind::RIGID, .tolerance = .03}).continuous.dimension(), 1u);
}

/// A cube with a pyramid on each face.
Solid star(double height) {
  Solid solid = box(.5, .5, .5);
  const auto faces = std::exchange(solid.polygons, {});
  for (const auto& face : faces) {
    Kernel::Vector_3 sum(0, 0, 0);
    for (const std::size_t i : face) sum = sum + (solid.points[i] - CGAL::ORIGIN) / 4;
    const Kernel::Vector_3 outward = 2 * (sum - Kernel::Vector_3(0, 0, .5));
    const std::size_t tip = solid.points.size();
    solid.points.push_back(CGAL::ORIGIN + sum + height * outward);
    for (std::size_t k = 0; k < 4; ++k) solid.polygons.push_back({face[k], face[(k + 1) % 4], tip});
  }
  return solid;
}

TEST(Solid_symmetries_long, rotations_that_are_drawn_to_a_symmetry_nearby_are_no_slipping) {
  for (const double height : {.48, .5, .52}) EXPECT_EQ(symmetries(star(height), rigid_maps).order(), 48u) << height;
}

TEST(Solid_symmetries, a_triangle_is_undecided) {
  const Solid triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(symmetries(triangle, rigid_maps).order(), std::nullopt);
}

TEST(Solid_symmetries, without_reflections_they_are_half_as_many) {
  const auto result = symmetries(box(1, .7, .4), {.kind = Map_kind::RIGID, .reflections = false});
  EXPECT_EQ(result.order(), 4u);
  for (const auto& symmetry : result.maps) EXPECT_GT(matrix_of(symmetry.map).determinant(), 0);
}

TEST(Solid_symmetries, noise_makes_them_approximate) {
  Random random(3);
  Solid noisy = box(1, .7, .4);
  for (Point_3& p : noisy.points)
    p = Point_3(p.x() + .003 * random.normal(), p.y() + .003 * random.normal(), p.z() + .003 * random.normal());
  const auto result = symmetries(noisy, rigid_maps);
  EXPECT_EQ(result.order(), 8u);
  EXPECT_EQ(result.verdict, Symmetry_verdict::APPROXIMATE);
  EXPECT_GT(result.levels[0].rms, 3e-4);
  EXPECT_LT(result.levels[0].rms, .01);
  const auto strict = symmetries(noisy, {.kind = Map_kind::RIGID, .tolerance = 1e-5});
  EXPECT_EQ(strict.order(), 1u) << "none is exact";
}

TEST(Solid_symmetries, meshes_of_cgal_have_theirs) {
  CGAL::Surface_mesh<Point_3> mesh;
  CGAL::make_regular_prism(5, mesh, Point_3(1, 2, 3), 1.4, 2, true);
  const auto result = affine_symmetries(mesh, rigid_maps);
  EXPECT_EQ(result.order(), 20u);
  EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT);
}

TEST(Solid_symmetries, round_ones_turn) {
  const auto ways = [](const Solid& solid) { return symmetries(solid, rigid_maps).continuous.dimension(); };
  EXPECT_EQ(ways(prism(regular(60), 1)), 1u);
  EXPECT_EQ(ways(prism(regular(4), 1)), 0u);
  Solid with_knob = prism(regular(60), 1);
  const Solid knob = box(.03, .03, .03);
  const std::size_t first = with_knob.points.size();
  for (const Point_3& p : knob.points) with_knob.points.push_back(p + Kernel::Vector_3(.995, 0, .5));
  for (auto polygon : knob.polygons) {
    for (auto& v : polygon) v += first;
    with_knob.polygons.push_back(polygon);
  }
  EXPECT_EQ(ways(with_knob), 0u) << "the rms of its turns is that of facets";
}

TEST(Solid_symmetries, open_meshes_have_rigid_ones) {
  Solid open = box(1, .7, .4);
  open.polygons.pop_back();
  const auto affine = symmetries(open, {});
  EXPECT_EQ(affine.kind, Map_kind::RIGID) << "it bounds no solid";
  EXPECT_EQ(affine.order(), 4u);
  EXPECT_EQ(symmetries(open, rigid_maps).order(), 4u) << "an open surface has a centroid";
}

/// The sides of a prism over a regular polygon, stretched along y.
Solid tube(std::size_t sides, double height, double stretch) {
  auto base = regular(sides);
  for (auto& p : base) p[1] *= stretch;
  Solid solid = prism(base, height);
  solid.polygons.resize(sides);
  return solid;
}

// Only its ends tell of a shift along a tube, which the flips would keep otherwise.
TEST(Solid_symmetries, open_tubes_are_flipped_exactly) {
  for (const auto& [sides, height, stretch, number] :
       {std::tuple(24, 2., 1., 96U), {24, 1., 1.002, 8U}, {12, 2., 1.1, 8U}, {4, 1.7, 1.3, 8U}}) {
    const auto result = symmetries(tube(std::size_t(sides), height, stretch), rigid_maps);
    ASSERT_FALSE(result.levels.empty()) << sides;
    EXPECT_EQ(result.levels.front().maps.size(), number) << sides;
    EXPECT_LT(result.levels.front().greatest, 1e-13) << sides;
    EXPECT_EQ(result.verdict, Symmetry_verdict::EXACT) << sides;
  }
}

TEST(Solid_symmetries_long, short_coordinates_are_what_they_say_unless_many_look_rounded) {
  EXPECT_EQ(symmetries(box(1, 1, 1.00001), rigid_maps).order(), 16u);
  Solid bumped = box(1, 1, 1);
  bumped.points[0] = Kernel::Point_3(-1, -1, -1e-5);
  EXPECT_EQ(symmetries(bumped, rigid_maps).levels.front().maps.size(), 2u) << "and the mirror image along a diagonal";
  Solid dented = star(.3);
  dented.points[0] = Kernel::Point_3(-.4995, -.4995, .0005);
  const auto result = symmetries(dented, rigid_maps);
  ASSERT_EQ(result.levels.size(), 2u);
  EXPECT_EQ(result.levels[0].maps.size(), 6u);
  EXPECT_EQ(result.levels[1].maps.size(), 48u);
}

// The generators are those of finite turns, which move points as far as is said.
TEST(Solid_symmetries, a_coarse_mesh_of_an_ellipsoid_turns_as_far_from_itself_as_is_said) {
  const Formula formula(Expression_3("x^2+y^2/2+z^2/4-1"), CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));
  const auto mesh = test::surface_of(formula, {.resolution = 30});
  const auto result = affine_symmetries(mesh.points, mesh.triangles);
  ASSERT_EQ(result.continuous.dimension(), 3u);
  const double size = std::sqrt(3.5); // about
  for (const auto& generator : result.continuous.generators)
    for (const double angle : {.3, 1.1}) {
      const Eigen::Matrix4d flow = [&] {
        Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
        m.topLeftCorner<3, 3>() = angle * generator.matrix;
        m.topRightCorner<3, 1>() = angle * generator.translation;
        return Eigen::Matrix4d(m.exp());
      }();
      double sum = 0;
      for (const auto& p : mesh.points) {
        const Eigen::Vector4d q = flow * Eigen::Vector4d(p.x(), p.y(), p.z(), 1);
        sum += std::pow(formula.value({q[0], q[1], q[2]}) / 2, 2); // about the distance
      }
      EXPECT_LT(std::sqrt(sum / double(mesh.points.size())) / size, 2 * result.continuous.rms + 1e-3);
    }
}

// In coordinates in which the solid is round, the tips are a third as far off as in its own.
TEST(Solid_symmetries, affine_ones_move_points_of_a_long_solid_as_far_off_as_is_said) {
  Solid needle = {{{-5, -.5, -.5},
                   {5, -.5, -.5},
                   {5, .5, -.5},
                   {-5, .5, -.5},
                   {-5, -.5, .5},
                   {5, -.5, .5},
                   {5, .5, .5},
                   {-5, .5, .5},
                   {-5.3, 0, 0},
                   {5.36, 0, 0}},
                  {{0, 3, 2, 1},
                   {4, 5, 6, 7},
                   {0, 1, 5, 4},
                   {2, 3, 7, 6},
                   {1, 2, 9},
                   {2, 6, 9},
                   {6, 5, 9},
                   {5, 1, 9},
                   {0, 4, 8},
                   {4, 7, 8},
                   {7, 3, 8},
                   {3, 0, 8}}};
  const auto result = affine_symmetries<CGAL::Parallel_if_available_tag>(needle.points, needle.polygons);
  ASSERT_GE(result.levels.size(), 2u);
  EXPECT_EQ(result.levels[0].order(), 8u);
  EXPECT_EQ(result.levels[1].order(), 16u);
  constexpr double off = .04295, size = 3.1048; // a tip beside the image of the other one
  EXPECT_GT(result.levels[1].greatest, off / size);
  EXPECT_LT(result.levels[1].greatest, 1.4 * off / size);
  const auto greatest = std::max_element(result.levels[1].maps.begin(), result.levels[1].maps.end(),
                                         [](const auto& a, const auto& b) { return a.greatest < b.greatest; });
  EXPECT_NEAR(greatest->greatest, result.levels[1].greatest * size, 1e-3);
}

TEST(Solid_symmetries, meshes_that_make_no_sense_are_refused) {
  EXPECT_THROW(symmetries({{{0, 0, 0}}, {}}, rigid_maps), std::invalid_argument);
  EXPECT_THROW(symmetries({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}, rigid_maps), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(symmetries({{{0, 0, nan}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, rigid_maps), std::invalid_argument);
  EXPECT_THROW(symmetries(box(1, 1, 1), {.kind = Map_kind::RIGID, .tolerance = 1}), Input_error);
}

} // namespace solid_symmetries_test
