// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Without_bounds.h"
#include "support/error_field.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/marching_cubes/marching_cubes_of_array.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace marching_cubes_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

struct Surface {
  const char *name, *expression;
  double half_side;
};

const std::array<Surface, 4> surfaces = {{{"sphere", "x^2+y^2+z^2-1", 1.3},
                                          {"torus", "z^2+(sqrt(x^2+y^2)-0.5)^2-0.04", 0.8},
                                          {"blobby", "(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6", 1.2},
                                          {"tanglecube", "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", 3}}};

auto traits_of(const Surface& s) {
  const double b = s.half_side;
  return make_analytic_traits<Kernel>(Expression_3(s.expression), CGAL::Bbox_3(-b, -b, -b, b, b, b));
}

Mesh_topology topology(const Isosurface_3<Kernel>& surface) {
  return mesh_topology(surface.triangles, surface.points.size());
}

TEST(Marching_cubes, the_image_of_a_surface_has_the_images_of_its_vertices) {
  const auto traits = traits_of(surfaces[2]);
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6);
  const auto surface = marching_cubes(traits, {.resolution = 20});
  const auto image = marching_cubes(Transformed_function_traits_3(traits, map), {.resolution = 20});
  ASSERT_EQ(surface.points.size(), image.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    EXPECT_LE(CGAL::squared_distance(map(surface.points[i]), image.points[i]), 1e-24);
}

TEST(Marching_cubes, linear_vertices_converge_with_order_two_and_projected_ones_are_exact) {
  const auto traits = traits_of(surfaces[0]);
  const auto worst = [&](std::size_t n) {
    double distance = 0;
    const auto surface = marching_cubes(traits, {.resolution = n, .vertices = Vertex_position::LINEAR});
    for (const Point_3& p : surface.points)
      distance = std::max(distance, std::abs(std::sqrt((p - CGAL::ORIGIN).squared_length()) - 1));
    return distance;
  };
  EXPECT_NEAR(std::log2(worst(33) / worst(65)), 2, 0.2);
}

TEST(Marching_cubes, threads_change_nothing) {
  const auto traits = traits_of(surfaces[3]);
  const auto one = marching_cubes<CGAL::Sequential_tag>(traits),
             many = marching_cubes<CGAL::Parallel_if_available_tag>(traits);
  EXPECT_EQ(one.points, many.points);
  EXPECT_EQ(one.triangles, many.triangles);
  EXPECT_EQ(one.function_evaluations, many.function_evaluations);
}

TEST(Marching_cubes, skipping_empty_space_changes_nothing_but_the_number_of_evaluations) {
  for (const Surface& s : surfaces)
    for (const std::size_t n : {20u, 65u, 100u}) {
      const Marching_cubes_options options{.resolution = n, .vertices = Vertex_position::LINEAR};
      const auto all = marching_cubes(Without_bounds(traits_of(s)), options),
                 some = marching_cubes(traits_of(s), options);
      EXPECT_GT(all.function_evaluations, n * n * n) << s.name;
      EXPECT_EQ(all.points, some.points) << s.name;
      EXPECT_EQ(all.triangles, some.triangles) << s.name;
      if (n == 100) {
        EXPECT_LT(10 * some.function_evaluations, 9 * all.function_evaluations) << s.name;
      }
    }
}

TEST(Marching_cubes, skipping_empty_space_changes_nothing_on_skew_lattices) {
  const Kernel::Aff_transformation_3 map(0.9, 0, -0.9, 0, -2, 0.3, 1.1, -0.2, 0.6);
  const Transformed_function_traits_3 image(traits_of(surfaces[0]), map);
  const Marching_cubes_options options{.resolution = 70, .vertices = Vertex_position::LINEAR};
  const auto all = marching_cubes(Without_bounds(image), options), some = marching_cubes(image, options);
  EXPECT_EQ(all.points, some.points);
  EXPECT_EQ(all.triangles, some.triangles);
  EXPECT_LT(some.function_evaluations, all.function_evaluations);
}

TEST(Marching_cubes, skipping_empty_space_does_not_take_the_end_of_the_domain_for_a_surface) {
  // The function changes its sign on a plane and is undefined on one side of another, which its bounds do not show.
  for (const char* text : {"(y-0.3)*(1+0.01*sqrt(x))", "(y-0.3)*(1+0.01*sqrt(-x))",
                           // Here it becomes undefined just above the surface, where blocks of nodes begin.
                           "(x-0.3)*(1+0.01*sqrt(0.33-x+0.2*y))", "(y-0.3)*(1+0.01*sqrt(0.33-y+0.2*z))",
                           "(z-0.3)*(1+0.01*sqrt(0.33-z+0.2*x))"})
    for (const std::size_t n : {37u, 40u}) {
      const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
      const Marching_cubes_options options{.resolution = n, .vertices = Vertex_position::LINEAR};
      const auto all = marching_cubes(Without_bounds(traits), options), some = marching_cubes(traits, options);
      EXPECT_FALSE(all.triangles.empty());
      EXPECT_EQ(all.points, some.points) << text;
      EXPECT_EQ(all.triangles, some.triangles) << text;
    }
}

/// Functors whose branches depend on comparisons, which intervals may leave undecided.
struct Box_or_ball {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    using std::abs;
    if (x < 0.1) return std::max(abs(y), abs(z)) - 0.4;
    return 0.49 >= y * y + z * z ? x * x + y * y + z * z - 0.7 : T(0.3);
  }
};
/// A functor that intervals do not compile with, and that says so.
struct Without_intervals {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const requires(!std::same_as<T, Interval>) {
    static_assert(!std::is_same_v<T, Interval>);
    return x * x + y * y + z * z - 0.5;
  }
};

TEST(Marching_cubes, functors_with_branches_and_without_intervals_have_the_same_surface_with_and_without_bounds) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const auto branching = make_analytic_traits<Kernel>(Box_or_ball(), box);
  static_assert(BoundedImplicitFunctionTraits_3<Analytic_function_traits_3<Kernel, Box_or_ball>>);
  EXPECT_EQ(branching.bounds(CGAL::Bbox_3(0, 0, 0, 0.2, 0.1, 0.1)), Interval::whole()) << "on both sides of x = 0.1";
  EXPECT_LT(branching.bounds(CGAL::Bbox_3(0.2, 0, 0, 0.3, 0.1, 0.1)).upper(), 0);
  EXPECT_EQ(branching.first_order_bounds(box).coefficients()[1], Interval::whole());
  const auto all = marching_cubes(Without_bounds(branching), {.resolution = 65}),
             some = marching_cubes(branching, {.resolution = 65});
  EXPECT_GT(all.points.size(), 1000u);
  EXPECT_EQ(all.points, some.points);
  EXPECT_EQ(all.triangles, some.triangles);
  EXPECT_LT(some.function_evaluations, all.function_evaluations);

  const auto unbounded = make_analytic_traits<Kernel>(Without_intervals(), box);
  static_assert(!BoundedImplicitFunctionTraits_3<Analytic_function_traits_3<Kernel, Without_intervals>>);
  EXPECT_EQ(topology(marching_cubes(unbounded, {.resolution = 20})).euler_characteristic, 2);
}

Volume_3<Kernel> random_volume(std::size_t n, std::mt19937& random, const std::vector<double>& values) {
  Volume_3<Kernel> volume{Lattice_3<Kernel>({n, n, n}, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)), {}};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const bool is_border = i == 0 || j == 0 || k == 0 || i == n - 1 || j == n - 1 || k == n - 1;
        volume.values.push_back(is_border ? 1.0 : values[random() % values.size()]);
      }
  return volume;
}

TEST(Marching_cubes, projection_turns_no_triangle_over) {
  std::mt19937 random(3);
  std::size_t undone = 0;
  for (int n = 0; n < 30; ++n) {
    const Sampled_function_traits_3<Kernel> traits(random_volume(8, random, {-1.0, -0.8, -0.1, 0.03, 0.4, 0.9}));
    const auto linear = marching_cubes(traits, {.vertices = Vertex_position::LINEAR});
    const auto projected = marching_cubes(traits);
    undone += projected.repairs.flips_undone;
    ASSERT_EQ(linear.triangles, projected.triangles);
    const auto normal = [](const auto& surface, const auto& t) {
      const auto& p = surface.points;
      return CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    };
    for (const auto& t : linear.triangles) ASSERT_GE(normal(linear, t) * normal(projected, t), 0);
  }
  EXPECT_GT(undone, 0u) << "the test shows nothing";
}

// Random signs make every case of a cell and every pair of cases across a face; values at the isovalue are the hardest.
TEST(Marching_cubes, random_volumes_give_closed_manifolds) {
  std::mt19937 random(11);
  for (int n = 0; n < 300; ++n)
    for (const auto& values : {std::vector{-0.7, -0.1, 0.2, 0.9}, std::vector{-1.0, -0.5, 0.0, 0.5, 1.0}}) {
      const Sampled_function_traits_3<Kernel> traits(random_volume(7, random, values));
      const auto t = topology(marching_cubes(traits));
      ASSERT_TRUE(t.is_manifold) << "volume " << n;
      ASSERT_EQ(t.boundary_edges, 0) << "volume " << n;
    }
}

TEST(Marching_cubes, surfaces_through_nodes_have_no_triangles_of_zero_area) {
  std::mt19937 random(12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::size_t contracted = 0;
  for (int n = 0; n < 100; ++n)
    for (const auto& values : {std::vector{-1.0, -0.5, 0.0, 0.5, 1.0}, std::vector{-1.0, 0.0, 0.0, 1.0, nan}}) {
      const Sampled_function_traits_3<Kernel> traits(random_volume(7, random, values));
      const auto surface = marching_cubes(traits, {.vertices = Vertex_position::LINEAR});
      contracted += surface.repairs.contracted_edges;
      ASSERT_EQ(surface.repairs.zero_area_left, 0u);
      for (const auto& [a, b, c] : surface.triangles)
        ASSERT_FALSE(CGAL::collinear(surface.points[a], surface.points[b], surface.points[c])) << n;
    }
  EXPECT_GT(contracted, 1000u);
}

TEST(Marching_cubes, a_volume_has_the_surface_of_its_array) {
  std::mt19937 random(13);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int n = 0; n < 50; ++n)
    for (const auto& values : {std::vector{-1.0, -0.5, 0.0, 0.5, 1.0}, std::vector{-1.0, 0.0, 0.0, 1.0, nan}}) {
      auto volume = random_volume(7, random, values);
      volume.lattice = Lattice_3<Kernel>({7, 7, 7}, CGAL::Bbox_3(0, 0, 0, 6, 6, 6));
      const auto surface =
          marching_cubes(Sampled_function_traits_3<Kernel>(volume), {.vertices = Vertex_position::LINEAR});
      const auto of_array = marching_cubes_of_array(std::span<const double>(volume.values), {7, 7, 7}, 0.0);
      std::vector<Point_3> points;
      for (const auto& [x, y, z] : of_array.points) points.emplace_back(x, y, z);
      EXPECT_EQ(surface.points, points);
      EXPECT_TRUE(std::equal(surface.triangles.begin(), surface.triangles.end(), of_array.triangles.begin(),
                             of_array.triangles.end()));
    }
}

TEST(Marching_cubes, all_256_cases_occur_and_fit_together) {
  const auto& cases = internal::Marching_cubes_cases::instance();
  for (unsigned signs = 1; signs < 255; ++signs) {
    Volume_3<Kernel> volume{Lattice_3<Kernel>({4, 4, 4}, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)), std::vector<double>(64, 1.0)};
    for (unsigned c = 0; c < 8; ++c)
      volume.values[volume.lattice.index(1 + (c & 1), 1 + (c >> 1 & 1), 1 + (c >> 2))] = signs >> c & 1 ? 1 : -1;
    const auto t = topology(marching_cubes(Sampled_function_traits_3<Kernel>(volume)));
    EXPECT_TRUE(t.is_manifold && t.boundary_edges == 0) << signs;
    EXPECT_FALSE(cases[cases.variant(signs, 0).sub_case].triangles.empty()) << signs;
  }
  for (unsigned signs : {0U, 255U}) EXPECT_TRUE(cases[cases.variant(signs, 0).sub_case].triangles.empty());
}

TEST(Marching_cubes, nodes_without_a_value_leave_a_clean_border) {
  std::mt19937 random(5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int with_border = 0;
  for (int n = 0; n < 100; ++n) {
    const Sampled_function_traits_3<Kernel> traits(random_volume(7, random, {-1.0, -0.3, 0.4, 0.8, nan}));
    const auto surface = marching_cubes(traits);
    const auto t = topology(surface);
    EXPECT_TRUE(t.is_manifold) << "volume " << n;
    with_border += t.boundary_edges > 0;
    std::vector<bool> is_used(surface.points.size());
    for (const auto& triangle : surface.triangles)
      for (auto v : triangle) is_used[v] = true;
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0) << "a vertex without a triangle";
    for (const Point_3& p : surface.points) EXPECT_TRUE(std::isfinite(p.x() + p.y() + p.z()));
  }
  EXPECT_GT(with_border, 50);
}

TEST(Marching_cubes, a_surface_that_leaves_the_box_has_a_boundary_there) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2-0.3"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = marching_cubes(traits, {.resolution = {20, 22, 24}});
  const auto t = topology(surface);
  EXPECT_TRUE(t.is_manifold);
  EXPECT_EQ(t.euler_characteristic, 0);
  EXPECT_GT(t.boundary_edges, 0);
}

TEST(Marching_cubes, poles_are_no_surfaces) {
  // Poles halfway between nodes and elsewhere, steep and flat ones, that of a logarithm, and those of a plane across
  // the grid, of planes that cross, and of a sphere.
  for (const char* text : {"1/x", "1/(x-0.01)", "1/x^3", "x/abs(x)^1.25", "x/abs(x)*log(abs(x)/3)", "1/(x-y)",
                           "tan(x+1.5)", "1/(x*y*z)", "1/(x^2+y^2+z^2-0.5)"}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    const auto surface = marching_cubes<CGAL::Parallel_if_available_tag>(traits, {.resolution = 20});
    EXPECT_EQ(surface.points.size(), 0u) << text;
    EXPECT_EQ(surface.triangles.size(), 0u) << text;
    EXPECT_GT(surface.repairs.vertices_at_poles, 0u) << text;
  }
}

TEST(Marching_cubes, a_surface_ends_beside_a_pole) {
  for (const char* text : {"1/x+y", "z/x", "tan(x)-y", "1/(x-.3)+y", "x*y*z/(x-.3)"}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
    const auto surface = marching_cubes(traits, {.resolution = 40});
    const auto t = topology(surface);
    EXPECT_TRUE(t.is_manifold) << text;
    EXPECT_GT(surface.triangles.size(), 1000u) << text;
    EXPECT_GT(surface.repairs.vertices_at_poles, 1000u) << text;
    ASSERT_EQ(surface.vertex_status.size(), surface.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      ASSERT_EQ(surface.vertex_status[v], Point_status::REGULAR) << text << ' ' << surface.points[v];
      const auto jet = traits.first_order(surface.points[v]);
      ASSERT_LE(std::abs(jet.value()), 1e-13 * (1 + std::abs(jet.coefficients()[1])))
          << text << ' ' << surface.points[v];
    }
  }
}

TEST(Marching_cubes, a_jump_is_no_surface) {
  for (const char* text : {"(x-0.01)/abs(x-0.01)", "(x-0.01)/abs(x-0.01)*(2-abs(x))"}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    const auto surface = marching_cubes(traits, {.resolution = 8});
    EXPECT_TRUE(surface.points.empty()) << text;
    EXPECT_GT(surface.repairs.vertices_at_poles, 0u) << text;
  }
}

TEST(Marching_cubes, a_jump_is_no_surface_beside_one) {
  const auto traits =
      make_analytic_traits<Kernel>(Expression_3("(x-0.01)/abs(x-0.01)*(2-x)-1.5"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = marching_cubes(traits, {.resolution = 8});
  EXPECT_EQ(surface.points.size(), 64u);
  for (const auto& p : surface.points) EXPECT_NEAR(p.x(), 0.5, 1e-15);
  EXPECT_EQ(surface.repairs.vertices_at_poles, 64u) << "f is small beside the jump, at x = 0.14";
}

TEST(Marching_cubes, a_jump_ends_the_surface) {
  const auto helicoid = make_analytic_traits<Kernel>(Expression_3("z-atan2(y,x)"), CGAL::Bbox_3(-2, -2, -4, 2, 2, 4));
  for (const std::size_t n : {12u, 25u, 40u}) {
    const auto surface = marching_cubes(helicoid, {.resolution = n});
    EXPECT_GT(surface.triangles.size(), n * n);
    for (const auto& p : surface.points) EXPECT_NEAR(p.z(), std::atan2(p.y(), p.x()), 1e-12);
    for (const Point_status status : surface.vertex_status) EXPECT_NE(status, Point_status::UNCONVERGED);
  }
}

TEST(Marching_cubes, arguments_without_a_result_are_refused_in_every_build) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto sphere = traits_of(surfaces[0]);
  for (const Resolution& resolution : {Resolution(0), Resolution(1), Resolution(20, 1, 20)})
    EXPECT_EQ(error_field([&] { marching_cubes(sphere, {.resolution = resolution}); }), "resolution");
  EXPECT_EQ(error_field([] { Resolution(-5); }), "resolution");
  EXPECT_EQ(error_field([] { Resolution(9, -1L, 9); }), "resolution");
  EXPECT_EQ(Resolution(9).nodes(), (std::array<std::size_t, 3>{9, 9, 9}));
  const CGAL::Bbox_3 space(-infinity, -infinity, -infinity, infinity, infinity, infinity);
  EXPECT_THROW(marching_cubes(make_analytic_traits<Kernel>(Expression_3("x"), space)), std::invalid_argument);
  const std::vector<double> values(8);
  const std::span<const double> all(values);
  EXPECT_NO_THROW(marching_cubes_of_array(all, {2, 2, 2}, 0.5));
  EXPECT_THROW(marching_cubes_of_array(all, {2, 2, 3}, 0.5), std::invalid_argument);
  EXPECT_THROW(marching_cubes_of_array(all, {8, 1, 1}, 0.5), std::invalid_argument);
  EXPECT_THROW(marching_cubes_of_array(all, {2, 2, 2}, 0.5, {0, 0, 0}, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(marching_cubes_of_array(all, {2, 2, 2}, 0.5, {0, 0, 0}, {1, 1, infinity}), std::invalid_argument);
}

TEST(Marching_cubes, vertices_around_a_sample_that_the_spline_smooths_away_are_unconverged) {
  // Convolution smooths a single negative sample away: the mesh is that of the samples, its vertices are unconverged.
  Volume_3<Kernel> volume{Lattice_3<Kernel>({12, 12, 12}, CGAL::Bbox_3(0, 0, 0, 11, 11, 11)),
                          std::vector<double>(1728, 1.0)};
  volume.values[volume.lattice.index(6, 6, 6)] = -0.5;
  const auto surface = marching_cubes(
      Sampled_function_traits_3<Kernel>(volume, {.spline_scheme = Spline_scheme::CONVOLUTION, .spline_degree = 5}));
  EXPECT_EQ(surface.points.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(surface.vertex_status[i], Point_status::UNCONVERGED);
}

// Node values are exactly zero, or the spline changes them by a rounding: vertices are on the surface before
// projection.
TEST(Marching_cubes, vertices_at_nodes_of_a_volume_are_on_the_surface) {
  for (const char* text : {"x", "x+y", "x^2+y^2+z^2-25", "50*(x-2)"}) {
    const Lattice_3<Kernel> lattice({17, 17, 17}, CGAL::Bbox_3(-8, -8, -8, 8, 8, 8));
    const Expression_3 f(text);
    Volume_3<Kernel> volume{lattice, {}};
    for (int k = -8; k <= 8; ++k)
      for (int j = -8; j <= 8; ++j)
        for (int i = -8; i <= 8; ++i) volume.values.push_back(f(double(i), double(j), double(k)));
    for (const auto& surface : {marching_cubes(Sampled_function_traits_3<Kernel>(volume)),
                                marching_cubes(Level_set_traits_3(Sampled_function_traits_3<Kernel>(volume), 0.0,
                                                                  Orientation_of_level_set::AGAINST_GRADIENT))}) {
      EXPECT_FALSE(surface.points.empty());
      for (std::size_t i = 0; i < surface.points.size(); ++i)
        EXPECT_EQ(surface.vertex_status[i], Point_status::REGULAR) << text << " at " << surface.points[i];
    }
  }
}

TEST(Project_to_surface, it_finds_the_nearby_zero_and_says_when_there_is_none) {
  const auto sphere = traits_of(surfaces[0]);
  const auto p = project_to_surface(sphere, Point_3(0.8, 0.9, 0.1), 1.0);
  EXPECT_TRUE(p.has_converged);
  EXPECT_NEAR((p.point - CGAL::ORIGIN).squared_length(), 1, 1e-15);
  EXPECT_FALSE(project_to_surface(sphere, Point_3(3, 0, 0), 1.0).has_converged);
  EXPECT_FALSE(project_to_surface(sphere, Point_3(0, 0, 0), 2.0).has_converged) << "no direction at a critical point";
}

/// This expression is never replaced by a shorter one on a box.
struct Whole_expression {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return f(x, y, z);
  }
  Expression_3 f;
};

TEST(Marching_cubes, parts_of_a_long_expression_give_the_mesh_of_the_whole) {
  const Expression_3 f("max(min((x-.4)^2+y^2+z^2-.1, abs(x+.5)^3+abs(y)^3+abs(z)^3-.05, sqrt(x^2+(y-.6)^2+z^2)-.3,"
                       "x^2+(y+.5)^4+(z-.2)^2-.04, (x-.2)^2+(y-.2)^2+(z+.5)^2-.09), x-.6, abs(z)-.7)");
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const Kernel::Aff_transformation_3 map(1, .2, 0, .1, 0, .9, .3, 0, .1, 0, 1.1, -.2);
  const auto mesh_of = [&](const auto& traits) {
    const Level_set_traits_3 level_set(Transformed_function_traits_3(traits, map), .01,
                                       Orientation_of_level_set::AGAINST_GRADIENT);
    return marching_cubes(level_set, {.resolution = 50});
  };
  static_assert(RestrictableImplicitFunctionTraits_3<
                Level_set_traits_3<Transformed_function_traits_3<Analytic_function_traits_3<Kernel, Expression_3>>>>);
  const auto in_parts = mesh_of(make_analytic_traits<Kernel>(f, box));
  const auto whole = mesh_of(make_analytic_traits<Kernel>(Whole_expression{f}, box));
  EXPECT_GT(whole.points.size(), 3000u);
  EXPECT_EQ(in_parts.points, whole.points);
  EXPECT_EQ(in_parts.triangles, whole.triangles);
  EXPECT_EQ(in_parts.vertex_status, whole.vertex_status);
}

} // namespace marching_cubes_test
