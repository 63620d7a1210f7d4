// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/meshed_surfaces.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace delaunay_surface_sizes_test {

using namespace equiaffine;
using namespace meshed_surfaces;
namespace functions = equiaffine::analytic_functions;

TEST(Delaunay_surface, every_point_of_the_surface_is_near_the_mesh) {
  const double radius = 0.08, distance = 0.004;
  const auto surface = delaunay_surface(traits_of(functions::Sphere()), {.radius = radius, .distance = distance});
  for (const auto& t : surface.triangles) {
    const Point_3 c = CGAL::circumcenter(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
    const double height = 1 - std::sqrt((c - CGAL::ORIGIN).squared_length());
    EXPECT_LE(height, distance);
    EXPECT_LE(CGAL::squared_distance(c, surface.points[t[0]]) + height * height, radius * radius * (1 + 1e-12));
  }
}

/// Where the surface meets the line through the circumcenter of a triangle, orthogonal to it: the center of its surface
/// Delaunay ball.
template <class Traits>
Point_3 center_of_ball(const Traits& traits, const Point_3& p, const Point_3& q, const Point_3& r) {
  const Kernel::Vector_3 normal = CGAL::cross_product(q - p, r - p);
  Point_3 center = CGAL::circumcenter(p, q, r);
  for (int n = 0; n < 20; ++n) {
    const auto c = first_order(traits, center).coefficients();
    center = center - c[0] / (Kernel::Vector_3(c[1], c[2], c[3]) * normal) * normal;
  }
  return center;
}

TEST(Delaunay_surface, facets_have_the_size_of_their_place) {
  const functions::Ellipsoid f; // its smallest radius of curvature is 1/6, at the tips of the longest axis
  const auto traits = traits_of(f);
  const double radius = 0.15, extent = Clip_domain_3(f.box()).diagonal() / 4;
  for (const Facet_sizing sizing : {Facet_sizing::UNIFORM, Facet_sizing::EUCLIDEAN, Facet_sizing::AFFINE}) {
    const auto surface = delaunay_surface(traits, {.radius = radius, .distance = 1, .sizing = sizing});
    EXPECT_EQ(topology(surface).euler_characteristic, 2);
    double largest = 0, largest_at_tip = 0;
    for (const auto& t : surface.triangles) {
      const Point_3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
      const Point_3 center = center_of_ball(traits, p, q, r);
      const auto e = local_structure_at(traits, center).euclidean;
      const double bound = sizing == Facet_sizing::UNIFORM ? radius
                           : sizing == Facet_sizing::EUCLIDEAN
                               ? 0.25 / std::max(std::abs(e.k1), std::abs(e.k2))
                               : radius * std::pow(e.gaussian_curvature * extent * extent, -0.125);
      const double size = std::sqrt(CGAL::squared_distance(center, p));
      EXPECT_LE(size, std::min(bound, radius) * (1 + 1e-9)) << center;
      largest = std::max(largest, size);
      if (std::abs(center.x()) > 1.45) largest_at_tip = std::max(largest_at_tip, size);
      if (sizing == Facet_sizing::UNIFORM) {
        // Every vertex was inserted outside of all balls of that radius, and facets are inscribed in them.
        EXPECT_GE(CGAL::squared_distance(p, q), radius * radius);
        EXPECT_LE(CGAL::squared_distance(p, q), 4 * radius * radius);
      }
    }
    EXPECT_GT(largest, 0.9 * radius) << "no smaller than asked for";
    if (sizing == Facet_sizing::UNIFORM) {
      EXPECT_GT(largest_at_tip, 0.9 * radius);
    }
  }
}

struct Affine_areas {
  double number, deviation; ///< of the facets; of their affine areas, relative to the mean
};

template <class Traits>
Affine_areas affine_areas(const Traits& traits, Facet_sizing sizing) {
  // Nowhere is the curvature so small, compared to that of a sphere in this box, that the size is cut off.
  const Clip_domain_3 domain(CGAL::Bbox_3(-12, -12, -12, 12, 12, 12));
  const auto surface = delaunay_surface(traits, {.radius = 0.1, .distance = 1, .sizing = sizing, .clip = domain});
  double sum = 0, sum_of_squares = 0;
  for (const auto& t : surface.triangles) {
    const Point_3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
    const double K_e = local_structure_at(traits, CGAL::centroid(p, q, r)).euclidean.gaussian_curvature;
    const double area = std::pow(K_e, 0.25) * std::sqrt(CGAL::squared_area(p, q, r));
    sum += area;
    sum_of_squares += area * area;
  }
  const double n = double(surface.triangles.size());
  return {n, std::sqrt(n * sum_of_squares - sum * sum) / sum};
}

TEST(Delaunay_surface, facets_of_equal_affine_area_are_as_many_on_all_affine_images_of_a_surface) {
  const auto sphere = traits_of(functions::Sphere());
  const auto ellipsoid = traits_of(functions::Ellipsoid{3, 1, 1.0 / 3});
  const Kernel::Aff_transformation_3 map(1.5, 0.3, 0, 0, 1, 0.4, 0.2, 0, 0.65066666666666662); // determinant 1
  const Transformed_function_traits_3 sheared(sphere, map);
  const auto expected = affine_areas(sphere, Facet_sizing::AFFINE);
  const auto uniform = affine_areas(ellipsoid, Facet_sizing::UNIFORM);
  for (const auto& image :
       {affine_areas(ellipsoid, Facet_sizing::AFFINE), affine_areas(sheared, Facet_sizing::AFFINE)}) {
    EXPECT_NEAR(image.number, expected.number, 0.02 * expected.number);
    EXPECT_LT(image.deviation - expected.deviation, 0.1 * (uniform.deviation - expected.deviation));
  }
  EXPECT_GT(uniform.deviation, 2 * expected.deviation) << "the test shows nothing";
}

} // namespace delaunay_surface_sizes_test
