// SPDX-License-Identifier: GPL-3.0-or-later
// What the mesh of every sampler promises: topology, vertices on the surface, the side it faces, and the invariants.
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sampler_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

struct Named_surface {
  const char *name, *expression;
  double half_side;
  std::size_t components;
  long euler_characteristic;
};

const std::array<Named_surface, 4> surfaces = {{{"sphere", "x^2+y^2+z^2-1", 1.3, 1, 2},
                                                {"torus", "z^2+(sqrt(x^2+y^2)-0.5)^2-0.04", 0.8, 1, 0},
                                                {"blobby", "(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6", 1.2, 2, 4},
                                                {"tanglecube", "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", 3, 1, -8}}};

auto traits_of(const Named_surface& s) {
  const double b = s.half_side;
  return make_analytic_traits<Kernel>(Expression_3(s.expression), CGAL::Bbox_3(-b, -b, -b, b, b, b));
}

template <class Traits>
double diagonal(const Traits& traits) {
  return Clip_domain_3(traits.bbox()).diagonal();
}

struct Marching_cubes_sampler {
  template <class Traits>
  static Isosurface_3<Kernel> sample(const Traits& traits) {
    return marching_cubes(traits);
  }
  static constexpr double precision = 1e-13; // of the vertices, relative to the diagonal
};

struct Delaunay_sampler {
  template <class Traits>
  static Isosurface_3<Kernel> sample(const Traits& traits) {
    return delaunay_surface(traits, {.radius = diagonal(traits) / 70});
  }
  static constexpr double precision = 1e-14;
};

template <class Sampler>
class Every_sampler : public ::testing::Test {};

using Samplers = ::testing::Types<Marching_cubes_sampler, Delaunay_sampler>;
TYPED_TEST_SUITE(Every_sampler, Samplers);

TYPED_TEST(Every_sampler, makes_closed_manifolds_of_closed_surfaces_with_the_right_topology) {
  for (const Named_surface& s : surfaces) {
    const auto surface = TypeParam::sample(traits_of(s));
    const auto t = mesh_topology(surface.triangles, surface.points.size());
    EXPECT_TRUE(t.is_manifold) << s.name;
    EXPECT_EQ(t.boundary_edges, 0u) << s.name;
    EXPECT_EQ(t.components, s.components) << s.name;
    EXPECT_EQ(t.euler_characteristic, s.euler_characteristic) << s.name;
  }
}

TYPED_TEST(Every_sampler, puts_its_vertices_on_the_surface_to_rounding) {
  for (const Named_surface& s : surfaces) {
    const auto traits = traits_of(s);
    const auto surface = TypeParam::sample(traits);
    for (const Point_3& p : surface.points)
      ASSERT_LE(distance_estimate(first_order(traits, p)), TypeParam::precision * diagonal(traits))
          << s.name << " at " << p;
    ASSERT_EQ(surface.vertex_status.size(), surface.points.size());
    for (const Point_status status : surface.vertex_status) ASSERT_EQ(status, Point_status::REGULAR);
  }
}

TYPED_TEST(Every_sampler, makes_triangles_that_are_counterclockwise_seen_from_the_side_of_the_gradient) {
  const auto traits = traits_of(surfaces[0]);
  const Kernel::Aff_transformation_3 reflection(1, 0, 0, 0, 1, 0, 0, 0, -1);
  const auto volume = [](const auto& function) {
    return CGAL::Polygon_mesh_processing::volume(to_surface_mesh(TypeParam::sample(function)));
  };
  const double ball = 4 * CGAL_PI / 3;
  EXPECT_NEAR(volume(traits), ball, 0.01 * ball);
  EXPECT_NEAR(volume(Transformed_function_traits_3(traits, reflection)), ball, 0.01 * ball);
  EXPECT_NEAR(volume(Level_set_traits_3(traits, 0.0, Orientation_of_level_set::AGAINST_GRADIENT)), -ball, 0.01 * ball);
}

/// What differences of the affine curvatures are to be compared with.
double scale(double K, double H, double K_e) { return std::abs(K) + H * H + std::pow(std::abs(K_e), 1.5); }

TYPED_TEST(Every_sampler, has_the_curvatures_of_extended_precision_at_its_vertices) {
  using Number = long double;
  for (const Named_surface& s : surfaces) {
    const auto traits = traits_of(s);
    const auto surface = TypeParam::sample(traits);
    std::size_t compared = 0;
    for (const Point_3& p : surface.points) {
      const auto structure = local_structure_at(traits, p);
      const auto exact =
          local_structure(expand<4, Number>(traits.function(), Number(p.x()), Number(p.y()), Number(p.z())));
      const double K = double(exact.affine.gaussian_curvature), H = double(exact.affine.mean_curvature);
      const double K_e = double(exact.euclidean.gaussian_curvature);
      if (!(std::abs(K_e) * diagonal(traits) * diagonal(traits) > 1e-2)) continue;
      ++compared;
      const double S = scale(K, H, K_e);
      ASSERT_EQ(structure.status, Point_status::REGULAR);
      ASSERT_NEAR(structure.affine.gaussian_curvature, K, 1e-9 * S) << s.name << " at " << p;
      ASSERT_NEAR(structure.affine.mean_curvature, H, 1e-9 * std::sqrt(S)) << s.name << " at " << p;
    }
    EXPECT_GT(compared, 1000u) << s.name;
    EXPECT_GT(100 * compared, 99 * surface.points.size()) << s.name;
  }
}

TYPED_TEST(Every_sampler, has_the_invariants_of_the_surface_by_their_weights_at_the_vertices_of_an_image) {
  const double determinant = -0.9;
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6), inverse = map.inverse();
  for (const Named_surface& s : {surfaces[1], surfaces[2]}) {
    const auto traits = traits_of(s);
    const Transformed_function_traits_3 image(traits, map);
    const auto surface = TypeParam::sample(image);
    const auto t = mesh_topology(surface.triangles, surface.points.size());
    EXPECT_EQ(t.euler_characteristic, s.euler_characteristic) << s.name;
    std::size_t compared = 0;
    for (const Point_3& p : surface.points) {
      const Point_3 original = inverse(p);
      ASSERT_LE(distance_estimate(first_order(traits, original)), 1e-13 * diagonal(traits)) << s.name << " at " << p;
      const auto a = local_structure_at(traits, original), b = local_structure_at(image, p);
      const double K = a.affine.gaussian_curvature, H = a.affine.mean_curvature, J = a.affine.pick_invariant;
      const double K_e = a.euclidean.gaussian_curvature;
      if (!(std::abs(K_e) * diagonal(traits) * diagonal(traits) > 1e-2)) continue;
      ++compared;
      const double S = scale(K, H, K_e), root = std::sqrt(std::abs(determinant));
      ASSERT_NEAR(b.affine.gaussian_curvature * std::abs(determinant), K, 1e-9 * S) << s.name << " at " << p;
      ASSERT_NEAR(b.affine.mean_curvature * root, H, 1e-9 * std::sqrt(S)) << s.name << " at " << p;
      ASSERT_NEAR(b.affine.pick_invariant * root, J, 1e-9 * (std::sqrt(S) + std::abs(J))) << s.name << " at " << p;
    }
    EXPECT_GT(100 * compared, 99 * surface.points.size()) << s.name;
  }
}

} // namespace sampler_test
