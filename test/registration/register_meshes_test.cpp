// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of meshes of planes, as wholes and piece by piece, which needs no curvature.
#include "support/fit_data.h"
#include "support/formulas.h"
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include "support/solids.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/is_affinely_equivalent.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace register_meshes_test {

using namespace equiaffine;
using namespace registration_cases;
using namespace solids;
using Vector_3 = Kernel::Vector_3;

constexpr Registration_options rigid = {.kind = Map_kind::RIGID};

/// What register_surfaces() does with meshes that have no map by curvature.
Surface_registration_3<Kernel> registered(const Solid& source, const Solid& target, const Registration_options& options,
                                          bool in_threads = runs_in_threads<CGAL::Parallel_if_available_tag>()) {
  const auto triangles = [](const Solid& solid) { return internal::triangles_of_soup(solid.points, solid.polygons); };
  return internal::registration_of_triangles(in_threads, triangles(source), triangles(target), options);
}

/// The greatest distance between images of points of a solid.
double greatest_distance(const Map& a, const Map& b, const Solid& solid) {
  double greatest = 0;
  for (const Point_3& p : solid.points) greatest = std::max(greatest, std::sqrt(CGAL::squared_distance(a(p), b(p))));
  return greatest;
}

TEST(Register_meshes, a_whole_without_curvature_is_found_by_every_kind_of_map) {
  Random random(5);
  const Solid source = cube_without_corner(.7);
  struct Case {
    Map_kind kind;
    Map map;
  };
  const Eigen::Vector3d shift(3, -1, 2);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  const std::vector<Case> cases = {{Map_kind::RIGID, map_of(mirror * random_rotation(random), shift)},
                                   {Map_kind::SIMILARITY, map_of(2.5 * random_rotation(random), shift)},
                                   {Map_kind::EQUIAFFINE, random_map(random, 4, 1)},
                                   {Map_kind::AFFINE, random_map(random, 6, 3)}};
  for (const auto& [kind, map] : cases) {
    const Solid target = moved(source, map);
    const auto found = registered(source, target, {.kind = kind, .number_of_maps = 6});
    ASSERT_EQ(found.maps.size(), 6u) << int(kind) << ": the solid has six symmetries";
    double least = 1;
    for (const auto& each : found.maps) {
      least = std::min(least, greatest_distance(each.map, map, source));
      EXPECT_LT(each.rms, 1e-9) << int(kind);
      EXPECT_LT(each.log10_false_alarms, -100) << int(kind);
      EXPECT_EQ(each.inliers[0], 1) << int(kind);
      EXPECT_FALSE(each.pair);
    }
    EXPECT_LT(least, 1e-9) << int(kind);
    EXPECT_EQ(found.slippage.dimension(), 0u);
  }
}

template <class Kernel_of_points>
class Register_meshes_of_kernels_long : public testing::Test {};
using Kernels = testing::Types<CGAL::Exact_predicates_inexact_constructions_kernel, CGAL::Simple_cartesian<float>>;
TYPED_TEST_SUITE(Register_meshes_of_kernels_long, Kernels);

TYPED_TEST(Register_meshes_of_kernels_long, results_are_of_the_kernel_of_the_points) {
  using FT = typename TypeParam::FT;
  const Solid solid = cube_without_corner(.75); // whose coordinates are floats
  std::vector<typename TypeParam::Point_3> points;
  for (const Point_3& p : solid.points) points.emplace_back(FT(p.x()), FT(p.y()), FT(p.z()));
  const Registration_options options = {.kind = Map_kind::RIGID, .number_of_maps = 3};

  const Surface_registration_3<TypeParam> found =
      register_surfaces(points, solid.polygons, points, solid.polygons, options);
  const auto expected = register_surfaces<CGAL::Parallel_if_available_tag>(solid.points, solid.polygons, solid.points,
                                                                           solid.polygons, options);
  ASSERT_EQ(found.maps.size(), expected.maps.size());
  ASSERT_EQ(found.maps.size(), 3);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto& a = found.maps[n];
    const auto& b = expected.maps[n];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) EXPECT_EQ(a.map.m(i, j), FT(b.map.m(i, j)));
    EXPECT_EQ(a.log10_false_alarms, b.log10_false_alarms);
    EXPECT_EQ(a.inliers, b.inliers);
    EXPECT_EQ(a.rms, b.rms);
    EXPECT_EQ(a.contradictions, b.contradictions);
    EXPECT_FALSE(a.pair);
  }
  EXPECT_EQ(found.hypotheses, expected.hypotheses);
  EXPECT_EQ(found.size, expected.size);
  EXPECT_EQ(found.next_best_rms, expected.next_best_rms);

  const Affine_symmetries_3<TypeParam> symmetries = affine_symmetries(points, solid.polygons);
  const auto all = affine_symmetries(solid.points, solid.polygons);
  EXPECT_EQ(symmetries.verdict, all.verdict);
  EXPECT_EQ(symmetries.order(), all.order());
  EXPECT_EQ(symmetries.complete_to, all.complete_to);
  ASSERT_EQ(symmetries.levels.size(), all.levels.size());
  ASSERT_FALSE(all.levels.empty());
  for (std::size_t n = 0; n < all.levels.size(); ++n) {
    EXPECT_EQ(symmetries.levels[n].rms, all.levels[n].rms);
    ASSERT_EQ(symmetries.levels[n].order(), all.levels[n].order());
    for (std::size_t k = 0; k < all.levels[n].order(); ++k) {
      EXPECT_EQ(symmetries.levels[n].maps[k].rms, all.levels[n].maps[k].rms);
      EXPECT_EQ(symmetries.levels[n].maps[k].map.m(1, 2), FT(all.levels[n].maps[k].map.m(1, 2)));
    }
  }
}

TYPED_TEST(Register_meshes_of_kernels_long, frames_and_slippage_are_those_that_were_found) {
  using FT = typename TypeParam::FT;
  Surface_registration_3<Kernel> found;
  auto& m = found.maps.emplace_back(Registered_map_3<Kernel>{Map(), -9, {0.5, 0.25}, 0.125, {}, {}});
  m.pair.emplace();
  m.pair->points = {Point_3(1, 2, 3), Point_3(4, 5, 6)};
  m.pair->frames[1][2] = Vector_3(7, 8, 9);
  found.slippage.generators.emplace_back();
  found.reason = "a reason";
  found.scales = {{0.5, 0.25}};
  found.is_by_triangles = true;
  found.maps_left_out = 7;
  found.advice = {Registration_advice::SAME_SCALE};
  const auto copy = internal::in_kernel<TypeParam>(found);
  ASSERT_TRUE(copy.maps.at(0).pair);
  EXPECT_EQ(copy.maps[0].pair->points[1], typename TypeParam::Point_3(FT(4), FT(5), FT(6)));
  EXPECT_EQ(copy.maps[0].pair->frames[1][2], typename TypeParam::Vector_3(FT(7), FT(8), FT(9)));
  EXPECT_EQ(copy.slippage.generators.size(), 1);
  EXPECT_EQ(copy.reason, "a reason");
  EXPECT_EQ(copy.scales, found.scales);
  EXPECT_TRUE(copy.is_by_triangles);
  EXPECT_EQ(copy.maps_left_out, 7u);
  EXPECT_EQ(copy.advice, found.advice);
}

TEST(Register_meshes, another_triangulation_is_the_same_surface) {
  Solid source = L(), target = L();
  for (auto& polygon : target.polygons)
    if (polygon.size() == 4) std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
  const Point_3 center(.2, .2, 0); // a point of the lower face, which becomes a fan around it
  const auto face = target.polygons.back();
  target.polygons.pop_back();
  for (std::size_t k = 0; k < face.size(); ++k)
    target.polygons.push_back({face[k], face[(k + 1) % face.size()], target.points.size()});
  target.points.push_back(center);
  Random random(9);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, 2, 3));
  const auto found = registered(source, moved(target, map), rigid);
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_LT(found.best().rms, 1e-6);
}

TEST(Register_meshes, polygons_may_begin_at_any_corner) {
  const Solid source = L(.8);
  Random random(2);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, 2, 3));
  for (std::ptrdiff_t first = 0; first < 6; ++first) {
    Solid target = moved(source, map);
    for (auto& polygon : target.polygons)
      std::rotate(polygon.begin(), polygon.begin() + first % std::ptrdiff_t(polygon.size()), polygon.end());
    const auto found = registered(source, target, rigid);
    ASSERT_TRUE(found.found()) << first << ": " << found.reason;
    EXPECT_LT(found.best().rms, 1e-9) << first;
    EXPECT_EQ(*found.best().contradictions, (std::array{0., 0.})) << first;
  }
}

TEST(Register_meshes, small_units_are_as_good_as_large_ones) {
  const Map smaller = map_of(1e-9 * Eigen::Matrix3d::Identity(), Eigen::Vector3d(1, 2, 3) * 1e-9);
  const Solid tiny = moved(L(.8), smaller);
  const auto found = registered(tiny, tiny, rigid);
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_LT(found.best().rms / found.size, 1e-9);
  for (const auto& [source, target] : {std::pair(tiny, box(1, 2, 3)), {box(1, 2, 3), tiny}}) {
    const auto none = registered(source, target, rigid);
    EXPECT_FALSE(none.found());
    EXPECT_NE(none.reason.find("50 times as large"), std::string::npos) << none.reason;
  }
}

TEST(Register_meshes_long, small_differences_of_planes_are_seen_unless_they_are_tolerated) {
  for (const double difference : {.001, .005})
    EXPECT_FALSE(registered(box(1, .7, .4), box(1, .7, .4 + difference), rigid).found()) << difference;
  const auto found = registered(box(1, .7, .4), box(1, .7, .405), {.kind = Map_kind::RIGID, .tolerance = .01});
  ASSERT_TRUE(found.found());
  EXPECT_GT(found.best().rms / found.size, 1e-4);
  EXPECT_LT(found.best().rms / found.size, .01);
}

TEST(Register_meshes, the_min_overlap_does_not_change_what_lies_on_the_other_surface) {
  const auto few = registered(box(1, .7, .4), box(1, .7, .4), {.kind = Map_kind::RIGID, .min_overlap = 0}),
             all = registered(box(1, .7, .4), box(1, .7, .4), {.kind = Map_kind::RIGID, .min_overlap = 1});
  ASSERT_TRUE(few.found() && all.found());
  EXPECT_EQ(few.best().inliers, all.best().inliers);
  EXPECT_EQ(few.best().inliers[0], 1);
}

TEST(Register_meshes, points_of_vertices_may_be_anywhere) {
  using Mesh = CGAL::Surface_mesh<Point_3>;
  Mesh source, target;
  CGAL::make_hexahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 2, 0), Point_3(0, 2, 0), Point_3(0, 2, 3),
                        Point_3(0, 0, 3), Point_3(1, 0, 3), Point_3(1, 2, 3), source);
  target = source;
  const auto place = target.add_property_map<Mesh::Vertex_index, Point_3>("v:place").first;
  for (const auto v : target.vertices()) {
    place[v] = target.point(v) + Vector_3(5, 6, 7);
    target.point(v) = CGAL::ORIGIN;
  }
  const auto there = register_surfaces(source, target, rigid, {}, parameters::vertex_point_map(place));
  ASSERT_TRUE(there.found()) << there.reason;
  const Point_3 center(.5, 1, 1.5);
  EXPECT_LT(CGAL::squared_distance(there.best().map(center), center + Vector_3(5, 6, 7)), 1e-18);
  const auto back = register_surfaces(target, source, rigid, parameters::vertex_point_map(place));
  ASSERT_TRUE(back.found()) << back.reason;
  EXPECT_LT(CGAL::squared_distance(back.best().map(center + Vector_3(5, 6, 7)), center), 1e-18);
}

TEST(Register_meshes_long, a_coarse_scan_of_the_same_object_is_alike_by_the_one_map_that_stands_out) {
  const auto registered_as_similar = [](const test::Fit_mesh& source, const test::Fit_mesh& target) {
    const auto triangles = [](const test::Fit_mesh& mesh) {
      return internal::triangles_of_graph(mesh, internal::No_parameters());
    };
    return internal::registration_of_triangles(true, triangles(source), triangles(target),
                                               {.kind = Map_kind::SIMILARITY});
  };
  Random random(3);
  const Map map = map_of(9.8 * random_rotation(random), Eigen::Vector3d(1, 2, 3));
  const auto animal = test::formula(
      ".5-exp(-3*(x^2+2*y^2+z^2))-exp(-6*((x-.7)^2+(y-.2)^2+z^2))-exp(-9*((x+.6)^2+y^2+(z-.5)^2))",
      CGAL::Bbox_3(-1.5, -1.5, -1.5, 1.5, 1.5, 1.5));
  const auto mesh_with = [](const auto& traits, std::size_t nodes) {
    return to_surface_mesh(test::surface_of(traits, {.resolution = nodes}));
  };
  const test::Fit_mesh fine = mesh_with(animal, 50);
  test::Fit_mesh coarse = mesh_with(animal, 20);
  test::add_noise(coarse, .012);
  for (const auto v : coarse.vertices()) coarse.point(v) = map(coarse.point(v));
  const auto found = registered_as_similar(fine, coarse);
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_GT(found.best().rms / found.size, .01) << "it is not equal";
  for (const auto v : fine.vertices())
    EXPECT_LT(std::sqrt(CGAL::squared_distance(found.best().map(fine.point(v)), map(fine.point(v)))), .05 * 9.8);

  const auto ellipsoid = test::formula("x^2+y^2/.64+z^2/.36-1", CGAL::Bbox_3(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1));
  const test::Fit_mesh smooth = mesh_with(ellipsoid, 12);
  test::Fit_mesh rough = smooth;
  test::add_noise(rough, .015);
  EXPECT_FALSE(registered_as_similar(smooth, rough).found()) << "eight maps are as good";
}

TEST(Register_meshes, reflections_and_sizes_are_as_asked_for) {
  const Solid source = {{{0, 0, 0}, {2, 0, 0}, {.3, 1.1, 0}, {.2, .4, 1.6}}, tetrahedron().polygons};
  const Solid mirrored = moved(source, map_of(Eigen::Vector3d(1, 1, -1).asDiagonal(), Eigen::Vector3d(1, 0, 0)));
  const Solid larger = moved(source, map_of(1.5 * Eigen::Matrix3d::Identity(), Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE(registered(source, mirrored, rigid).found());
  EXPECT_FALSE(registered(source, mirrored, {.kind = Map_kind::RIGID, .reflections = false}).found());
  EXPECT_FALSE(registered(source, larger, rigid).found());
  EXPECT_TRUE(registered(source, larger, {.kind = Map_kind::SIMILARITY}).found());
}

TEST(Register_meshes_long, solids_that_differ_have_no_map) {
  for (const auto& [source, target] : {std::pair(box(1, .7, .4), box(1, .75, .4)),
                                       {L(), cube_without_corner(.5)},
                                       {tetrahedron(), prism(regular(6), 1.3)}})
    EXPECT_FALSE(registered(source, target, {.kind = Map_kind::SIMILARITY}).found());
}

TEST(Register_meshes, planes_have_no_evidence) {
  const Solid square = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}};
  for (const Map_kind kind : {Map_kind::RIGID, Map_kind::AFFINE})
    EXPECT_FALSE(registered(square, square, {.kind = kind}).found());
}

TEST(Register_meshes, a_map_of_a_surface_that_turns_is_one_of_a_family) {
  constexpr std::size_t rings = 80, sides = 40;
  Solid torus;
  for (std::size_t i = 0; i < rings; ++i)
    for (std::size_t j = 0; j < sides; ++j) {
      const double u = 2 * std::numbers::pi * double(i) / rings, v = 2 * std::numbers::pi * double(j) / sides;
      const double r = 1 + .4 * std::cos(v);
      torus.points.emplace_back(r * std::cos(u), r * std::sin(u), .4 * std::sin(v));
      const auto vertex = [](std::size_t ring, std::size_t side) { return ring % rings * sides + side % sides; };
      torus.polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  const auto of_torus = registered(torus, torus, {.kind = Map_kind::RIGID, .number_of_maps = 3});
  ASSERT_TRUE(of_torus.found());
  EXPECT_EQ(of_torus.slippage.dimension(), 1u);
  EXPECT_LT(of_torus.slippage.rms, 2e-3);
  EXPECT_EQ(of_torus.maps.size(), 1u);
}

TEST(Register_meshes, a_prism_of_many_sides_has_many_maps_and_does_not_turn) {
  CGAL::Surface_mesh<Point_3> prism;
  CGAL::make_regular_prism(40, prism, Point_3(0, 0, 0), 2., 1., true);
  const auto triangles = internal::triangles_of_graph(prism, internal::No_parameters());
  const auto of_prism =
      internal::registration_of_triangles(true, triangles, triangles, {.kind = Map_kind::RIGID, .number_of_maps = 3});
  ASSERT_TRUE(of_prism.found());
  EXPECT_EQ(of_prism.slippage.dimension(), 0u);
  EXPECT_EQ(of_prism.maps.size(), 3u);
  EXPECT_GE(of_prism.equally_good, 79u);
  EXPECT_LT(of_prism.equally_good, 160u) << "there are 160 symmetries";
}

TEST(Register_meshes, what_makes_no_sense_is_refused) {
  const Solid solid = tetrahedron();
  Solid empty = solid, wrong = solid;
  empty.polygons.clear();
  wrong.polygons[0][0] = 7;
  const auto register_both = [](const Solid& source, const Solid& target, const Registration_options& options = {}) {
    return register_surfaces(source.points, source.polygons, target.points, target.polygons, options);
  };
  EXPECT_THROW(register_both(empty, solid), std::invalid_argument);
  EXPECT_THROW(register_both(solid, empty), std::invalid_argument);
  EXPECT_THROW(register_both(solid, wrong), std::invalid_argument);
  EXPECT_THROW(register_both(solid, solid, {.tolerance = .5}), Input_error);
}

TEST(Register_meshes, formulas_with_planes_only_are_matched_as_wholes) {
  const Formula box = Surface{"", "max(max(abs(x)-1, abs(y)-.7), abs(z)-.4)", cube(1.5)}.traits();
  Random random(4);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, -2, .5));
  const Image image(box, map);
  const auto points = points_on_surface(box, 20), points_of_image = points_on_surface(image, 20);
  const auto found = register_surfaces<CGAL::Parallel_if_available_tag>(box, points, image, points_of_image,
                                                                        {.kind = Map_kind::RIGID, .number_of_maps = 8});
  EXPECT_EQ(found.maps.size(), 8u);
  EXPECT_LT(found.best().rms, 1e-9);
  EXPECT_TRUE(
      is_affinely_equivalent<CGAL::Parallel_if_available_tag>(box, points, image, points_of_image, rigid).is_certain());
}

/// A solid without any symmetry.
Solid wedge() { return L(.8); }

const Vector_3 oblique(.6, .64, .48);

TEST(Register_pieces_long, a_piece_is_found_in_the_whole) {
  Random random(3);
  const Solid piece = clipped(wedge(), oblique, .9);
  const Eigen::Vector3d shift(3, -1, 2);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  const Map turn = map_of(random_rotation(random), shift), reflection = map_of(mirror * random_rotation(random), shift),
            similarity = map_of(2.5 * random_rotation(random), shift);
  for (const auto& [kind, map] :
       {std::pair(Map_kind::RIGID, turn), {Map_kind::RIGID, reflection}, {Map_kind::SIMILARITY, similarity}}) {
    const auto found = registered(piece, moved(wedge(), map), {.kind = kind});
    ASSERT_TRUE(found.found()) << found.reason;
    EXPECT_LT(greatest_distance(found.best().map, map, wedge()), 1e-9);
    EXPECT_LT(found.best().rms, 1e-9);
    EXPECT_GT(found.best().inliers[0], .99);
    EXPECT_LT(found.best().inliers[1], .8);
    EXPECT_LT(found.best().log10_false_alarms, -30);
    EXPECT_FALSE(found.best().pair);
  }
  EXPECT_FALSE(registered(piece, moved(wedge(), reflection), {.kind = Map_kind::RIGID, .reflections = false}).found());
}

TEST(Register_pieces, two_pieces_are_joined) {
  Random random(6);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, 2, 3));
  const Solid source = clipped(wedge(), oblique, .7), target = clipped(wedge(), -oblique, -.15);
  const auto found = registered(source, moved(target, map), rigid);
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_LT(greatest_distance(found.best().map, map, wedge()), 1e-9);
  EXPECT_LT(found.best().inliers[0], .95);
  EXPECT_LT(found.best().inliers[1], .95);
}

TEST(Register_pieces_long, those_of_other_solids_contradict_every_map) {
  const Solid piece = clipped(wedge(), oblique, .9);
  for (const auto& [kind, other] : {std::pair(Map_kind::RIGID, box(1, .7, .4)),
                                    {Map_kind::SIMILARITY, box(1, .7, .4)},
                                    {Map_kind::RIGID, cube_without_corner(.5)}}) {
    const auto found = registered(piece, other, {.kind = kind});
    EXPECT_FALSE(found.found());
    EXPECT_FALSE(found.reason.empty());
  }
}

/// Two solids in one, side by side or one on the other.
Solid joined(Solid a, const Solid& b) {
  for (auto polygon : b.polygons) {
    for (std::size_t& corner : polygon) corner += a.points.size();
    a.polygons.push_back(polygon);
  }
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  return a;
}

TEST(Register_pieces, where_solids_differ_is_told) {
  const Map above = map_of(Eigen::Matrix3d::Identity(), Eigen::Vector3d(.3, -.2, .4));
  const Solid plate = L(.8), plate_with_boss = joined(plate, moved(box(.05, .06, .04), above));
  const auto found = registered(plate, plate_with_boss, rigid);
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_EQ(found.best().contradictions->at(0), 0);
  EXPECT_GT(found.best().contradictions->at(1), .001);
  EXPECT_LT(found.best().contradictions->at(1), .02);
}

TEST(Register_pieces, the_next_best_map_is_known_whether_one_or_all_are_asked_for) {
  const Solid whole = box(1, .7, .4), piece = clipped(whole, oblique, .9);
  const auto one = registered(piece, whole, rigid),
             all = registered(piece, whole, {.kind = Map_kind::RIGID, .number_of_maps = 20});
  ASSERT_EQ(one.maps.size(), 1u) << one.reason;
  EXPECT_EQ(all.maps.size(), 8u) << "a box has eight symmetries";
  ASSERT_TRUE(one.next_best_rms);
  EXPECT_LT(*one.next_best_rms, 1e-9);
}

TEST(Register_pieces, what_slides_is_not_decided) {
  const Solid sheet = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, .7}, {1, 1, .7}},
                       {{0, 1, 2, 3}, {3, 2, 5, 4}}};
  const Solid longer = {{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}, {0, 1, .7}, {3, 1, .7}},
                        {{0, 1, 2, 3}, {3, 2, 5, 4}}};
  const auto found = registered(sheet, longer, rigid);
  EXPECT_FALSE(found.found());
  EXPECT_NE(found.reason.find("slide"), std::string::npos) << found.reason;
}

TEST(Register_pieces, other_kinds_of_maps_are_refused_with_a_reason) {
  const auto found = registered(clipped(wedge(), oblique, .9), wedge(), {});
  EXPECT_FALSE(found.found());
  EXPECT_NE(found.reason.find("similarities"), std::string::npos) << found.reason;
}

TEST(Register_pieces_long, threads_give_the_same_bits) {
  const Solid piece = clipped(wedge(), oblique, .9);
  const auto a = registered(piece, wedge(), rigid, false), b = registered(piece, wedge(), rigid);
  ASSERT_TRUE(a.found());
  ASSERT_TRUE(b.found());
  EXPECT_EQ(matrix_of(a.best().map), matrix_of(b.best().map));
  EXPECT_EQ(a.best().log10_false_alarms, b.best().log10_false_alarms);
}

} // namespace register_meshes_test
