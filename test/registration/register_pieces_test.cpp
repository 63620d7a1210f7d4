// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of pieces of solids with planes, which have no curvature to go by.
#include "support/registration_cases.h"
#include "support/solids.h"
#include <equiaffine/register_surfaces.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace {

using namespace equiaffine;
using namespace registration_cases;
using namespace solids;
using Vector_3 = Kernel::Vector_3;

template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Parameters>
Surface_registration_3<Kernel> registered(const Solid& source, const Solid& target, const Parameters& parameters) {
  return register_surfaces<ConcurrencyTag>(source.points, source.polygons, target.points, target.polygons, parameters);
}

/// How far a map moves points of a solid from where another one moves them.
double greatest_distance(const Map& a, const Map& b, const Solid& solid) {
  double greatest = 0;
  for (const Point_3& p : solid.points) greatest = std::max(greatest, std::sqrt(CGAL::squared_distance(a(p), b(p))));
  return greatest;
}

/// A solid without any symmetry.
Solid wedge() { return L(.8); }

const Vector_3 oblique(.6, .64, .48);

TEST(Register_pieces, a_piece_is_found_in_the_whole) {
  Random random(3);
  const Solid piece = clipped(wedge(), oblique, .9);
  const Eigen::Vector3d shift(3, -1, 2);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  const Map turn = map_of(random_rotation(random), shift), reflection = map_of(mirror * random_rotation(random), shift),
            similarity = map_of(2.5 * random_rotation(random), shift);
  for (const auto& [kind, map] :
       {std::pair(Map_kind::RIGID, turn), {Map_kind::RIGID, reflection}, {Map_kind::SIMILARITY, similarity}}) {
    const auto found = registered(piece, moved(wedge(), map), parameters::map_kind(kind));
    ASSERT_TRUE(found.found()) << found.reason;
    EXPECT_LT(greatest_distance(found.best().map, map, wedge()), 1e-6);
    EXPECT_GT(found.best().inliers[0], .99);
    EXPECT_LT(found.best().inliers[1], .8);
    EXPECT_LT(found.best().log10_false_alarms, -30);
    EXPECT_FALSE(found.best().pair);
  }
  EXPECT_FALSE(
      registered(piece, moved(wedge(), reflection), parameters::map_kind(Map_kind::RIGID).reflections(false)).found());
}

TEST(Register_pieces, two_pieces_are_joined) {
  Random random(6);
  const Map map = map_of(random_rotation(random), Eigen::Vector3d(1, 2, 3));
  const Solid source = clipped(wedge(), oblique, .7), target = clipped(wedge(), -oblique, -.15);
  const auto found = registered(source, moved(target, map), parameters::map_kind(Map_kind::RIGID));
  ASSERT_TRUE(found.found()) << found.reason;
  EXPECT_LT(greatest_distance(found.best().map, map, wedge()), 1e-6);
  EXPECT_LT(found.best().inliers[0], .95);
  EXPECT_LT(found.best().inliers[1], .95);
}

TEST(Register_pieces, those_of_other_solids_contradict_every_map) {
  const Solid piece = clipped(wedge(), oblique, .9);
  for (const auto& [kind, other] : {std::pair(Map_kind::RIGID, box(1, .7, .4)),
                                    {Map_kind::SIMILARITY, box(1, .7, .4)},
                                    {Map_kind::RIGID, cube_without_corner(.5)}}) {
    const auto found = registered(piece, other, parameters::map_kind(kind));
    EXPECT_FALSE(found.found());
    EXPECT_FALSE(found.reason.empty());
  }
}

TEST(Register_pieces, what_slides_is_not_decided) {
  const Solid sheet = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, .7}, {1, 1, .7}},
                       {{0, 1, 2, 3}, {3, 2, 5, 4}}};
  const Solid longer = {{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}, {0, 1, .7}, {3, 1, .7}},
                        {{0, 1, 2, 3}, {3, 2, 5, 4}}};
  const auto found = registered(sheet, longer, parameters::map_kind(Map_kind::RIGID));
  EXPECT_FALSE(found.found());
  EXPECT_NE(found.reason.find("slide"), std::string::npos) << found.reason;
}

TEST(Register_pieces, other_kinds_of_maps_are_refused_with_a_reason) {
  const auto found = registered(clipped(wedge(), oblique, .9), wedge(), parameters::map_kind(Map_kind::AFFINE));
  EXPECT_FALSE(found.found());
  EXPECT_NE(found.reason.find("similarities"), std::string::npos) << found.reason;
}

TEST(Register_pieces, threads_give_the_same_bits) {
  const Solid piece = clipped(wedge(), oblique, .9);
  const auto rigid = parameters::map_kind(Map_kind::RIGID);
  const auto a = registered<CGAL::Sequential_tag>(piece, wedge(), rigid), b = registered(piece, wedge(), rigid);
  ASSERT_TRUE(a.found());
  ASSERT_TRUE(b.found());
  EXPECT_EQ(matrix_of(a.best().map), matrix_of(b.best().map));
  EXPECT_EQ(a.best().log10_false_alarms, b.best().log10_false_alarms);
}

} // namespace
