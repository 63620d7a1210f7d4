// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/Lattice_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace Lattice_3_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;

// Steps with small integer coordinates, so that every expected number below is exact.
Lattice_3 skew_lattice() {
  return Lattice_3({3, 4, 5}, Point_3(10, 20, 30), {Vector_3(2, 0, 1), Vector_3(-1, 3, 0), Vector_3(0, 1, 4)});
}

Lattice_3 left_handed_lattice() {
  return Lattice_3({3, 4, 5}, Point_3(10, 20, 30), {Vector_3(-1, 3, 0), Vector_3(2, 0, 1), Vector_3(0, 1, 4)});
}

TEST(Lattice_3, what_is_no_lattice_is_refused_in_every_build) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const CGAL::Bbox_3 box(0, 0, 0, 1, 1, 1);
  const std::size_t many = std::size_t(1) << 31;
  for (const Lattice_3::Size& size : {Lattice_3::Size{0, 0, 0}, {1, 2, 2}, {2, 2, 1}})
    EXPECT_THROW(Lattice_3(size, box), std::invalid_argument) << size[0];
  EXPECT_THROW(Lattice_3({many, many, 4}, box), equiaffine::Input_error);
  for (const CGAL::Bbox_3& no_box : {CGAL::Bbox_3(), CGAL::Bbox_3(-infinity, 0, 0, infinity, 1, 1),
                                     CGAL::Bbox_3(0, 0, 0, 1, 0, 1), CGAL::Bbox_3(-1e308, 0, 0, 1e308, 1, 1)})
    EXPECT_THROW(Lattice_3({3, 3, 3}, no_box), std::invalid_argument) << no_box;
  const Vector_3 x(1, 0, 0), y(0, 1, 0);
  EXPECT_THROW(Lattice_3({3, 3, 3}, Point_3(0, 0, 0), {x, y, x + y}), std::invalid_argument);
  EXPECT_NO_THROW(Lattice_3({3, 3, 3}, CGAL::Bbox_3(0, 0, 0, 1e-150, 1e-150, 1e-150)));
  EXPECT_NO_THROW(Lattice_3({3, 3, 3}, CGAL::Bbox_3(0, 0, 0, 1e150, 1e150, 1e150)));
}

TEST(Lattice_3, a_box_that_is_inside_out_is_refused) {
  EXPECT_NO_THROW(Lattice_3({2, 2, 2}, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)));
  for (const CGAL::Bbox_3& box :
       {CGAL::Bbox_3(1, -1, -1, -1, 1, 1), CGAL::Bbox_3(-1, 1, -1, 1, -1, 1), CGAL::Bbox_3(1, 1, 1, -1, -1, -1)})
    EXPECT_THROW(Lattice_3({2, 2, 2}, box), std::invalid_argument) << box;
}

TEST(Lattice_3, a_node_lies_at_the_origin_plus_its_steps) {
  const Lattice_3 lattice = skew_lattice();
  EXPECT_EQ(lattice.point(0, 0, 0), Point_3(10, 20, 30));
  EXPECT_EQ(lattice.point(1, 2, 3), Point_3(10 + 2 - 2, 20 + 6 + 3, 30 + 1 + 12));
  EXPECT_EQ(lattice.point(0.5, 0, -1), Point_3(11, 19, 26.5));
}

TEST(Lattice_3, nodes_are_numbered_without_gaps_and_with_i_fastest) {
  const Lattice_3 lattice = skew_lattice();
  std::size_t expected = 0;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(lattice.index(i, j, k), expected++);
  EXPECT_EQ(lattice.number_of_nodes(), expected);
}

TEST(Lattice_3, the_corner_nodes_of_a_box_are_its_corners) {
  const CGAL::Bbox_3 box(-1, 2, -3, 4, 7, 9);
  const Lattice_3 lattice({6, 11, 13}, box);
  EXPECT_EQ(lattice.point(0, 0, 0), Point_3(-1, 2, -3));
  EXPECT_EQ(lattice.point(5, 10, 12), Point_3(4, 7, 9));
  EXPECT_EQ(lattice.steps()[1], Vector_3(0, 0.5, 0));
  EXPECT_EQ(lattice.bbox(), box);
}

TEST(Lattice_3, the_determinant_is_the_signed_volume_of_a_cell) {
  EXPECT_EQ(skew_lattice().determinant(), 23);
  EXPECT_EQ(left_handed_lattice().determinant(), -23);
}

TEST(Lattice_3, the_box_holds_all_nodes_and_touches_the_extreme_ones) {
  // x = 10 + 2i - j, y = 20 + 3j + k, z = 30 + i + 4k with i <= 2, j <= 3, k <= 4
  EXPECT_EQ(skew_lattice().bbox(), CGAL::Bbox_3(7, 20, 30, 14, 33, 48));
}

TEST(Lattice_3, the_transformation_maps_lattice_coordinates_to_space) {
  for (const Lattice_3& lattice : {skew_lattice(), left_handed_lattice()}) {
    const auto to_space = lattice.transformation();
    for (const Point_3& p : {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(2, 3, 4), Point_3(0.5, -1, 0.25)})
      EXPECT_EQ(to_space(p), lattice.point(p.x(), p.y(), p.z()));
  }
}

TEST(Lattice_3, a_transformed_lattice_has_the_images_of_the_nodes) {
  const Kernel::Aff_transformation_3 mirror_and_shear(0, 1, 0, 5, 1, 0, 0, 6, 2, 0, 1, 7);
  const Lattice_3 lattice = skew_lattice();
  const Lattice_3 image = lattice.transform(mirror_and_shear);
  EXPECT_EQ(image.size(), lattice.size());
  EXPECT_EQ(image.determinant(), -lattice.determinant());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 5; ++k) EXPECT_EQ(image.point(i, j, k), mirror_and_shear(lattice.point(i, j, k)));
}

} // namespace Lattice_3_test
