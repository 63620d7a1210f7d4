// SPDX-License-Identifier: GPL-3.0-or-later
// A function that can be restricted to cells gives the same numbers, bit for bit, as one that cannot.
#include "support/same_bits.h"
#include "support/sample_volume.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace cellwise_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Parallel = CGAL::Parallel_if_available_tag;

/// The members that make a lattice function, and none that restricts it to cells.
template <class Base>
class Without_cells {
public:
  using FT = typename Base::FT;
  using Point_3 = typename Base::Point_3;
  using Vector_3 = typename Base::Vector_3;

  explicit Without_cells(Base base) : base_(std::move(base)) {}
  FT value(const Point_3& p) const { return base_.value(p); }
  Jet_3<FT, 1> first_order(const Point_3& p) const { return base_.first_order(p); }
  Jet_3<FT> taylor(const Point_3& p) const { return base_.taylor(p); }
  FT rounding(const Point_3& p) const { return base_.rounding(p); }
  CGAL::Bbox_3 bbox() const { return base_.bbox(); }
  Lattice_3<Kernel> lattice() const { return base_.lattice(); }
  FT sample(std::size_t i, std::size_t j, std::size_t k) const { return base_.sample(i, j, k); }

private:
  Base base_;
};

// Left-handed and sheared, of more than one tile along each axis, the last of which has a single layer of nodes.
const Lattice_3<Kernel> lattice({129, 65, 70}, Point_3(-1.3, 0.9, -1.1),
                                {Kernel::Vector_3(0.02, 0.001, 0), Kernel::Vector_3(0, -0.03, 0.002),
                                 Kernel::Vector_3(0.001, 0, 0.032)});

double gyroid(double x, double y, double z) {
  return std::sin(5 * x) * std::cos(5 * y) + std::sin(5 * y) * std::cos(5 * z) + std::sin(5 * z) * std::cos(5 * x);
}

/// Smooth, smooth with nodes that have no value, and noise, which has vertices in cells and zeros that are no zeros of
/// the spline.
std::vector<Volume_3<Kernel>> volumes() {
  std::vector<Volume_3<Kernel>> result(3, sample_volume(lattice, gyroid));
  std::mt19937 random(5);
  for (int n = 0; n < 500; ++n) result[1].values[random() % lattice.number_of_nodes()] = NAN;
  result[2] = sample_volume(lattice, gyroid, 0.7);
  return result;
}

template <class Traits>
void expect_same_surface(const Traits& function) {
  static_assert(CellwiseImplicitFunctionTraits_3<Traits>);
  static_assert(!CellwiseImplicitFunctionTraits_3<Without_cells<Traits>>);
  const auto surface = marching_cubes<Parallel>(function);
  const Without_cells whole(function);
  const auto expected = marching_cubes<Parallel>(whole);
  EXPECT_GT(surface.points.size(), 10000U);
  EXPECT_EQ(surface.points, expected.points);
  EXPECT_EQ(surface.triangles, expected.triangles);
  EXPECT_EQ(surface.vertex_status, expected.vertex_status);
  EXPECT_EQ(surface.function_evaluations, expected.function_evaluations);
  const auto selection = select_attributes("all");
  const std::span<const Point_3> points(surface.points);
  const auto columns = compute_attributes<Parallel>(function, points, selection, surface.vertex_status);
  const auto expected_columns = compute_attributes<Parallel>(whole, points, selection, surface.vertex_status);
  EXPECT_EQ(columns.status, expected_columns.status);
  for (std::size_t c = 0; c < columns.columns.size(); ++c)
    for (std::size_t n = 0; n < points.size(); ++n)
      ASSERT_TRUE(same_bits(columns.columns[c].values[n], expected_columns.columns[c].values[n]))
          << columns.columns[c].name << ' ' << n;
  EXPECT_TRUE(same_bits(max_distance_to_surface<Parallel>(function, points, surface.vertex_status),
                        max_distance_to_surface<Parallel>(whole, points, surface.vertex_status)));
}

TEST(Cellwise_long, surfaces_and_attributes_have_the_bits_of_those_of_the_whole_function) {
  for (const auto& volume : volumes()) expect_same_surface(Sampled_function_traits_3<Kernel>(volume));
}

TEST(Cellwise, level_sets_and_images_are_restricted_as_their_base) {
  const Sampled_function_traits_3<Kernel> base(volumes()[0]);
  const CGAL::Aff_transformation_3<Kernel> map(1, 0.3, 0, 2, -0.2, 0.9, 0.1, 0, 0, 0.4, 1.1, -1);
  expect_same_surface(
      Level_set_traits_3(Transformed_function_traits_3(base, map), 0.2, Orientation_of_level_set::AGAINST_GRADIENT));
}

TEST(Cellwise, blocks_are_all_points_and_each_of_them_once) {
  const Sampled_function_traits_3<Kernel> function(volumes()[0]);
  std::vector<Point_3> points;
  std::mt19937 random(3);
  const auto coordinate = [&](std::size_t nodes) {
    return double(random()) / double(random.max()) * double(nodes + 3) - 2;
  };
  for (int n = 0; n < 5000; ++n) points.push_back(lattice.point(coordinate(129), coordinate(65), coordinate(70)));
  std::vector<int> visits(points.size());
  for_each_point_block<CGAL::Sequential_tag>(
      function, std::span<const Point_3>(points), 64, 1, [&](const auto& local, std::span<const std::size_t> numbers) {
        EXPECT_LE(numbers.size(), 64U);
        for (const std::size_t n : numbers) {
          ++visits[n];
          EXPECT_TRUE(same_bits(local.value(points[n]), function.value(points[n])));
        }
      });
  EXPECT_EQ(visits, std::vector<int>(points.size(), 1));
}

TEST(Cellwise, errors_of_curvatures_are_the_same_in_a_part) {
  const Volume_3<Kernel> volume = sample_volume(lattice, gyroid, 1e-4);
  const Sampled_function_traits_3<Kernel> function(volume, {.smoothing = 2});
  const Curvature_error_3<Kernel> errors(function, volume, 2, 1e-4);
  for (const double u : {3.2, 60.5, 127.9}) {
    const Point_3 p = lattice.point(u, 31.7, 35.1);
    const auto [i, j, k] = *errors.cell_of(p);
    const auto part = errors.restricted_to_cells({{i, j, k}, {i + 1, j + 1, k + 1}});
    EXPECT_TRUE(same_bits(part(p).affine_gaussian_curvature, errors(p).affine_gaussian_curvature));
    EXPECT_TRUE(same_bits(part(p).affine_mean_curvature, errors(p).affine_mean_curvature));
  }
}

} // namespace cellwise_test
