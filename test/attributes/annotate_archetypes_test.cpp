// SPDX-License-Identifier: GPL-3.0-or-later
// annotate() and annotate_by_fit() ask for no more of functions, meshes, ranges and property maps than they say: each
// is an archetype.
#include "support/archetypes.h"
#include "support/graph_archetypes.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <vector>

namespace annotate_archetypes_test {

using namespace equiaffine;
using Kernel_of_meshes = CGAL::Exact_predicates_inexact_constructions_kernel;
using Key = archetypes::Vertex;
constexpr double radius_of_band = 1.25;
template <class Value>
using Written = std::map<Key, Value>;
template <class Value>
auto writable(Written<Value>& values) {
  return archetypes::Writable_map<Key, Value>(values);
}

/// A band of a sphere around the z axis, with quads between its vertices, as an archetype.
class Band {
public:
  Band() : graph(size, polygons()) {
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        const double latitude = 0.08 * (double(i) - 0.5 * double(rows - 1));
        const double longitude = 2 * std::numbers::pi * double(j) / double(columns);
        const Kernel_of_meshes::Point_3 p(radius_of_band * std::cos(latitude) * std::cos(longitude),
                                          radius_of_band * std::cos(latitude) * std::sin(longitude),
                                          radius_of_band * std::sin(latitude));
        points_.emplace(Key(i * columns + j), p);
      }
  }

  const Kernel_of_meshes::Point_3& point(Key v) const { return points_.at(v); }
  auto points() const {
    return archetypes::readable_map<Key>([this](const Key& v) { return point(v); });
  }

  static constexpr std::size_t rows = 9, columns = 60, size = rows * columns;
  archetypes::Graph graph;

private:
  static std::vector<std::vector<std::size_t>> polygons() {
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t i = 0; i + 1 < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        const std::size_t k = i * columns, right = (j + 1) % columns;
        result.push_back({k + j, k + right, k + columns + right, k + columns + j});
      }
    return result;
  }

  std::map<Key, Kernel_of_meshes::Point_3> points_;
};

TEST(Annotate_archetypes, of_meshes_and_maps_are_enough) {
  const archetypes::Implicit_function<CGAL::Simple_cartesian<double>> traits{archetypes::Sphere()};
  const Band band;
  Written<double> K;
  Written<float> pick_invariant;
  Written<archetypes::Vector> normal;
  Written<std::array<double, 6>> metric;
  Written<Point_status> status;
  Written<Local_structure_3<double>> structure;
  annotate(band.graph, traits,
           parameters::vertex_point_map(band.points())
               .vertex_affine_Gaussian_curvature_map(writable(K))
               .vertex_pick_invariant_map(writable(pick_invariant))
               .vertex_affine_normal_map(writable(normal))
               .vertex_affine_metric_map(writable(metric))
               .vertex_status_map(writable(status))
               .vertex_structure_map(writable(structure)));
  ASSERT_EQ(K.size(), Band::size);
  for (const auto& [v, value] : K) {
    EXPECT_NEAR(value, std::pow(radius_of_band, -3), 1e-13);
    EXPECT_NEAR(pick_invariant.at(v), 0, 1e-13);
    const auto& p = band.point(v);
    EXPECT_NEAR(normal.at(v).product_with(p.x(), p.y(), p.z()), std::sqrt(radius_of_band), 1e-13);
    EXPECT_EQ(metric.at(v), structure.at(v).affine.metric);
    EXPECT_EQ(status.at(v), Point_status::REGULAR);
  }
  const auto one = annotate(Key(5), band.graph, traits, parameters::vertex_point_map(band.points()));
  EXPECT_EQ(one.affine.gaussian_curvature, K.at(Key(5)));
}

TEST(Annotate_archetypes, of_ranges_are_enough) {
  const archetypes::Implicit_function<CGAL::Simple_cartesian<double>> traits{archetypes::Sphere()};
  const Band band;
  archetypes::Points elements(100);
  Written<double> H;
  annotate<CGAL::Parallel_if_available_tag>(
      elements, traits, parameters::point_map(band.points()).vertex_affine_mean_curvature_map(writable(H)));
  ASSERT_EQ(H.size(), 100U);
  for (const auto& [v, value] : H) EXPECT_NEAR(value, -std::pow(radius_of_band, -1.5), 1e-13);
}

TEST(Annotate_archetypes, of_meshes_and_ranges_are_enough_for_fits) {
  const Band band;
  archetypes::Points elements(Band::size);
  Written<double> mean, mean_of_points, error;
  annotate_by_fit(band.graph, {.scale = 0.4},
                  parameters::vertex_point_map(band.points())
                      .vertex_mean_curvature_map(writable(mean))
                      .vertex_mean_curvature_error_map(writable(error)));
  const auto normals = archetypes::readable_map<Key>([&](const Key& v) { return band.point(v) - CGAL::ORIGIN; });
  annotate_by_fit(
      elements, {.scale = 0.4},
      parameters::point_map(band.points()).normal_map(normals).vertex_mean_curvature_map(writable(mean_of_points)));
  ASSERT_EQ(mean.size(), Band::size);
  ASSERT_EQ(mean_of_points.size(), Band::size);
  for (const auto& [v, value] : mean) {
    EXPECT_NEAR(value, 1 / radius_of_band, 1e-3) << "the sign is that of CGAL";
    EXPECT_NEAR(mean_of_points.at(v), 1 / radius_of_band, 1e-3);
  }
  const auto one = annotate_by_fit(Key(70), band.graph, {.scale = 0.4}, parameters::vertex_point_map(band.points()));
  EXPECT_NEAR(one.structure.euclidean.mean_curvature, -1 / radius_of_band, 1e-3);
}

} // namespace annotate_archetypes_test
