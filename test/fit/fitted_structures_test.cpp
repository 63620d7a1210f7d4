// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Without_bounds.h"
#include "support/fit_data.h"
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace fitted_structures_test {

using namespace equiaffine;
using namespace equiaffine::test;
using Traits = Fitted_function_traits_3<Fit_kernel>;
static_assert(FirstOrderImplicitFunctionTraits_3<Traits> && BoundedImplicitFunctionTraits_3<Traits>);

// The bounds are those that the research on fits asks for on 10,000 vertices; this mesh has half as many.
TEST(Fitted_structures, affine_curvature_at_exact_vertices_has_four_digits) {
  const Fit_mesh mesh = metaballs_mesh(50);
  ASSERT_GT(mesh.number_of_vertices(), 4000u);
  const auto errors =
      errors_of_fit(fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}), points_of(mesh));
  EXPECT_EQ(errors.without_fit, 0u);
  EXPECT_LT(errors.quantile(0.5), 1e-4);
  EXPECT_LT(errors.quantile(0.95), 1e-3);
  EXPECT_GT(errors.part_covered(), 0.93);
  EXPECT_LE(double(errors.trusted_but_wrong), 0.03 * double(errors.trusted));
}

TEST(Fitted_structures_long, points_without_faces_are_as_good_as_a_mesh) {
  const Fit_mesh mesh = metaballs_mesh(50);
  const auto points = points_of(mesh);
  const auto of_mesh = errors_of_fit(fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}), points);
  const auto of_points =
      errors_of_fit(fitted_structures<CGAL::Parallel_if_available_tag>(points, {.scale = 0}), points);
  EXPECT_EQ(of_points.without_fit, 0u);
  EXPECT_LT(of_points.quantile(0.5), 1.2 * of_mesh.quantile(0.5));
}

TEST(Fitted_structures_long, noise_of_one_percent_of_an_edge_leaves_K_known_and_the_estimate_says_how_well) {
  const Fit_mesh exact = metaballs_mesh(50);
  Fit_mesh mesh = exact;
  add_noise(mesh, 0.01 * mean_edge(mesh));
  const auto errors =
      errors_of_fit(fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}), points_of(exact));
  EXPECT_LT(errors.quantile(0.5), 0.04);
  EXPECT_LT(errors.quantile(0.95), 0.2);
  EXPECT_GT(errors.part_covered(), 0.93);
  EXPECT_LE(double(errors.trusted_but_wrong), 0.03 * double(errors.trusted));
}

TEST(Fitted_structures, noise_that_is_given_counts_as_it_is) {
  Fit_mesh mesh = metaballs_mesh(30);
  const double h = mean_edge(mesh);
  const auto once = fitted_structures(mesh, {.scale = 0.4, .noise = 0.1 * h}),
             twice = fitted_structures(mesh, {.scale = 0.4, .noise = 0.2 * h});
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (once[i].structure.status != Point_status::REGULAR || twice[i].structure.status != Point_status::REGULAR)
      continue;
    EXPECT_NEAR(twice[i].noise.affine_gaussian_curvature / once[i].noise.affine_gaussian_curvature, 2, 1e-6);
    EXPECT_GE(once[i].error.affine_gaussian_curvature, once[i].noise.affine_gaussian_curvature);
  }
}

TEST(Fitted_structures_long, an_equiaffine_map_of_the_mesh_keeps_affine_curvatures) {
  const Fit_mesh mesh = metaballs_mesh(40);
  // Of determinant 1 and condition number 3.
  const double s = std::pow(3., 0.25), c = std::cos(0.5), d = std::sin(0.5);
  const CGAL::Aff_transformation_3<Fit_kernel> map(s * s * c, -d / s / s, 0, 1, s * s * d, c / s / s, 0, 2, 0, 0, 1, 3);
  Fit_mesh image = mesh;
  for (const auto v : image.vertices()) image.point(v) = map(image.point(v));
  const auto before = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}),
             after = fitted_structures<CGAL::Parallel_if_available_tag>(image, {.scale = 0});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto &a = before[i].structure.affine, &b = after[i].structure.affine;
    const double size = std::abs(a.gaussian_curvature) + a.mean_curvature * a.mean_curvature;
    EXPECT_NEAR(a.gaussian_curvature, b.gaussian_curvature,
                1e-8 * size + 0.02 * before[i].error.affine_gaussian_curvature)
        << i;
  }
}

TEST(Fitted_structures, any_number_of_threads_gives_the_same_bits) {
  const Fit_mesh mesh = metaballs_mesh(24);
  const auto parallel = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}),
             sequential = fitted_structures(mesh, {.scale = 0});
  for (std::size_t i = 0; i < parallel.size(); ++i) {
    const auto &a = parallel[i].structure.affine, &b = sequential[i].structure.affine;
    EXPECT_EQ(std::memcmp(&a.gaussian_curvature, &b.gaussian_curvature, sizeof(double)), 0) << i;
    EXPECT_EQ(std::memcmp(&parallel[i].error, &sequential[i].error, sizeof(parallel[i].error)), 0) << i;
  }
}

auto bowl() { return formula("z-x^2-.5*y^2-.1*x^2*y", CGAL::Bbox_3(-2, -2, -2, 2, 2, 2)); }

double height_of_bowl(double x, double y) { return x * x + 0.5 * y * y + 0.1 * x * x * y; }

TEST(Fitted_structures_long, a_jump_of_density_by_ten_leaves_both_sides_with_right_estimates) {
  std::vector<Fit_kernel::Point_3> points;
  for (double x = -1; x < 1; x += x < 0 ? 0.1 : 0.01)
    for (double y = -0.5; y < 0.5; y += x < 0 ? 0.1 : 0.01) points.emplace_back(x, y, height_of_bowl(x, y));
  const auto structures = fitted_structures<CGAL::Parallel_if_available_tag>(points, {.scale = 0});
  double covered = 0, known = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double fitted = structures[i].structure.affine.gaussian_curvature;
    if (!std::isfinite(fitted)) continue;
    ++known;
    covered += std::abs(fitted - local_structure_at(bowl(), points[i]).affine.gaussian_curvature) <=
               structures[i].error.affine_gaussian_curvature;
  }
  EXPECT_GT(known, 0.9 * double(points.size()));
  EXPECT_GT(covered, 0.93 * known);
}

TEST(Fitted_structures, a_scale_that_holds_a_shape_as_a_whole_or_too_few_points_is_refused) {
  const auto shape = formula("exp(x^2)+exp(1.5*y^2)+exp(2*z^2)-4", CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const Fit_mesh mesh = to_surface_mesh(surface_of(shape, {.resolution = 12}));
  for (const double scale : {1.5, 0.1}) {
    try {
      fitted_structures(mesh, {.scale = scale});
      ADD_FAILURE() << scale;
    } catch (const Input_error& error) {
      EXPECT_EQ(error.field(), "scale");
    }
  }
  EXPECT_EQ(fitted_structures(mesh, {.scale = 0.6}).front().scale, 0.6);
}

TEST(Fitted_structures, estimates_cover_the_errors_of_a_small_mesh) {
  const auto shape = formula("x^2+y^2/.64+z^2/.36-1", CGAL::Bbox_3(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1));
  const Fit_mesh exact = to_surface_mesh(surface_of(shape, {.resolution = 12}));
  for (const double noise : {0., 0.01}) {
    Fit_mesh mesh = exact;
    add_noise(mesh, noise * mean_edge(mesh));
    const auto structures = fitted_structures(mesh, {.scale = 0});
    double covered = 0;
    for (std::size_t i = 0; i < structures.size(); ++i) {
      const auto truth = local_structure_at(shape, points_of(exact)[i]);
      covered += std::abs(structures[i].structure.affine.gaussian_curvature - truth.affine.gaussian_curvature) <=
                 structures[i].error.affine_gaussian_curvature;
    }
    EXPECT_GT(covered, 0.93 * double(structures.size())) << noise;
  }
}

TEST(Fitted_structures, errors_at_a_scale_are_those_of_the_polynomials_of_exact_data_at_that_scale) {
  const Fit_mesh exact = metaballs_mesh(40);
  const auto truth = fitted_structures<CGAL::Parallel_if_available_tag>(exact, {.scale = 0.3});
  for (const double noise : {0.01, 0.05}) {
    Fit_mesh mesh = exact;
    add_noise(mesh, noise * mean_edge(mesh));
    const auto fits = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0.3});
    const auto K = [](const auto& s) { return s.structure.affine.gaussian_curvature; };
    const auto H = [](const auto& s) { return s.structure.affine.mean_curvature; };
    EXPECT_GT(part_within(
                  fits.size(), [&](std::size_t i) { return std::abs(K(fits[i]) - K(truth[i])); },
                  [&](std::size_t i) { return fits[i].error.affine_gaussian_curvature; }),
              0.9)
        << noise;
    EXPECT_GT(part_within(
                  fits.size(), [&](std::size_t i) { return std::abs(H(fits[i]) - H(truth[i])); },
                  [&](std::size_t i) { return fits[i].error.affine_mean_curvature; }),
              0.9)
        << noise;
  }
}

TEST(Fitted_structures_long, a_scale_is_chosen_where_the_data_do_not_resolve_the_surface_and_for_affine_images_alike) {
  const Fit_mesh exact = metaballs_mesh(30);
  EXPECT_FALSE(fitted_structures<CGAL::Parallel_if_available_tag>(exact).front().is_at_scale);
  Fit_mesh mesh = exact;
  add_noise(mesh, 0.2 * mean_edge(mesh));
  const auto at_scale = fitted_structures<CGAL::Parallel_if_available_tag>(mesh).front();
  EXPECT_TRUE(at_scale.is_at_scale);
  EXPECT_FALSE(fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0}).front().is_at_scale);
  const CGAL::Aff_transformation_3<Fit_kernel> map(1, 0.5, 0, 0, 1, 0.5, 0, 0, 1);
  for (const auto v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
  EXPECT_NEAR(fitted_structures<CGAL::Parallel_if_available_tag>(mesh).front().scale, at_scale.scale, 1e-9);
}

TEST(Fitted_structures, every_quantity_has_an_estimate_that_covers_its_error) {
  const Fit_mesh exact = metaballs_mesh(40);
  const auto points = points_of(exact);
  Fit_mesh mesh = exact;
  add_noise(mesh, 0.01 * mean_edge(mesh));
  const auto fits = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0});
  std::vector<Local_structure_3<double>> truth;
  for (const auto& p : points) truth.push_back(local_structure_at(metaballs(), p));
  for (const auto* const row : rows_with_error) {
    const auto difference = [&](std::size_t i) {
      const auto &a = fits[i].structure, &b = truth[i];
      if (row->name == "affine_normal") return angle_in_degrees(a.affine.normal, b.affine.normal);
      if (row->name == "conormal" || row->name == "normal")
        return angle_in_degrees(a.euclidean.normal, b.euclidean.normal);
      return std::abs(row->get(a, 0) - row->get(b, 0));
    };
    EXPECT_GT(part_within(fits.size(), difference, [&](std::size_t i) { return row->error.get(fits[i].error); }), 0.9)
        << row->name;
  }
}

/// Expects equal numbers, or none on both sides.
void expect_same(double found, double expected) {
  if (std::isnan(expected)) EXPECT_TRUE(std::isnan(found));
  else EXPECT_EQ(found, expected);
}

TEST(Annotate_by_fit, fills_the_maps_of_any_mesh_with_what_fitted_structures_returns) {
  Fit_mesh mesh = metaballs_mesh(16);
  const auto expected = fitted_structures(mesh, {.scale = 0});
  annotate_by_fit(mesh, {.scale = 0});
  const auto K = mesh.add_property_map<Fit_mesh::Vertex_index, double>("v:affine_gaussian_curvature").first;
  const auto error = mesh.add_property_map<Fit_mesh::Vertex_index, double>("v:affine_gaussian_curvature_error").first;
  const auto status = mesh.add_property_map<Fit_mesh::Vertex_index, Point_status>("v:status").first;
  std::size_t i = 0;
  for (const auto v : mesh.vertices()) {
    expect_same(K[v], expected[i].structure.affine.gaussian_curvature);
    expect_same(error[v], expected[i].error.affine_gaussian_curvature);
    EXPECT_EQ(status[v], expected[i++].structure.status);
  }

  using Polyhedron = CGAL::Polyhedron_3<Fit_kernel>;
  Polyhedron polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  std::map<boost::graph_traits<Polyhedron>::vertex_descriptor, Fitted_structure_3<double>> structures;
  annotate_by_fit(polyhedron, boost::make_assoc_property_map(structures), {.scale = 0});
  const auto in_order = fitted_structures(polyhedron, {.scale = 0});
  i = 0;
  for (const auto v : vertices(polyhedron))
    expect_same(structures.at(v).structure.affine.mean_curvature, in_order[i++].structure.affine.mean_curvature);
}

TEST(Fitted_function_traits_3, the_blend_is_a_smooth_function_whose_zero_set_has_the_curvatures_of_the_surface) {
  const Fit_mesh mesh = metaballs_mesh(50);
  const Traits traits(mesh, {.scale = 0});
  const auto truth = metaballs();
  std::vector<double> errors;
  for (const auto& p : points_of(mesh)) {
    const auto jet = traits.taylor(p);
    EXPECT_EQ(jet.value(), traits.first_order(p).value());
    EXPECT_NEAR(jet.value(), traits.value(p), 1e-14);
    EXPECT_NEAR(traits.value(p), 0, 1e-6);
    const auto fitted = local_structure(jet), exact = local_structure_at(truth, p);
    if (!(std::abs(exact.euclidean.gaussian_curvature) > 0.2)) continue;
    errors.push_back(std::abs(fitted.affine.gaussian_curvature - exact.affine.gaussian_curvature) /
                     (std::abs(exact.affine.gaussian_curvature) + std::pow(exact.affine.mean_curvature, 2)));
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 2e-4);
}

template <class Function>
auto remeshed(const Function& function, const Marching_cubes_options& options = {}) {
  return marching_cubes<CGAL::Parallel_if_available_tag>(function, options);
}

TEST(Fitted_function_traits_3_long, estimates_cover_the_errors_of_the_blend_between_the_data) {
  for (const double noise : {0., 0.01}) {
    Fit_mesh mesh = metaballs_mesh(50);
    add_noise(mesh, noise * mean_edge(mesh));
    const Traits traits(mesh, {.scale = 0});
    const auto remesh = remeshed(traits, {.resolution = 40});
    std::vector<Fitted_structure_3<double>> structures;
    for (const auto& p : remesh.points) structures.push_back(traits.structure(p));
    const auto errors = errors_of_fit(structures, remesh.points);
    EXPECT_EQ(errors.without_fit, 0u);
    EXPECT_GT(errors.part_covered(), 0.93) << noise;
    EXPECT_LE(double(errors.trusted_but_wrong), 0.03 * double(errors.trusted)) << noise;
  }
  EXPECT_EQ(Traits(metaballs_mesh(20), {.scale = 0}).structure({5, 5, 5}).structure.status, Point_status::OUTSIDE);
}

TEST(Fitted_function_traits_3, a_grid_coarser_than_the_points_needs_a_wider_band) {
  const Traits traits(metaballs_mesh(50), {.scale = 0});
  const Marching_cubes_options options{.resolution = 12};
  EXPECT_TRUE(remeshed(traits, options).triangles.empty());
  const double diagonal = std::sqrt(3) * traits.bbox().x_span() / 11;
  const auto surface = remeshed(traits.in_band(1.2 * diagonal), options);
  EXPECT_FALSE(surface.triangles.empty());
  EXPECT_TRUE(CGAL::is_closed(to_surface_mesh(surface)));
  for (const auto& p : surface.points) EXPECT_NEAR(metaballs().value(p), 0, 1e-6);
  EXPECT_EQ(remeshed(Without_bounds(traits.in_band(1.2 * diagonal)), options).points, surface.points);
}

TEST(Fitted_function_traits_3, the_band_follows_the_surface_where_a_scale_takes_it_away_from_the_data) {
  const Traits traits(metaballs_mesh(40), {.scale = 0.5});
  const auto surface = remeshed(traits, {.resolution = 64});
  EXPECT_TRUE(CGAL::is_closed(to_surface_mesh(surface)));
}

TEST(Fitted_function_traits_3, sparse_data_do_not_spoil_the_blend_of_dense_ones_beside_them) {
  std::vector<Fit_kernel::Point_3> points;
  for (double x = -1; x < 1; x += x < 0 ? 0.1 : 0.01)
    for (double y = -0.5; y < 0.5; y += x < 0 ? 0.1 : 0.01) points.emplace_back(x, y, height_of_bowl(x, y));
  const Traits traits(points, {.scale = 0});
  for (double x = 0.1; x < 0.8; x += 0.03) {
    const Fit_kernel::Point_3 p(x, 0.005, height_of_bowl(x, 0.005));
    const double K = local_structure_at(bowl(), p).affine.gaussian_curvature;
    EXPECT_NEAR(traits.structure(p).structure.affine.gaussian_curvature, K, 1e-4 * std::abs(K)) << x;
  }
}

TEST(Fitted_function_traits_3, the_same_function_can_be_sampled_in_another_box) {
  const Traits traits(metaballs_mesh(20), {.scale = 0});
  const CGAL::Bbox_3 box(-1, -1, -1, 0, 2, 2);
  const Traits part = traits.in_box(box);
  EXPECT_EQ(part.bbox(), box);
  EXPECT_NE(traits.bbox(), box);
  for (const auto& p : remeshed(part).points) EXPECT_LE(p.x(), 0);
}

TEST(Fitted_function_traits_3, values_are_about_signed_distances_in_the_band_and_undefined_outside) {
  const Fit_mesh mesh = metaballs_mesh(30);
  const Traits traits(mesh, {.scale = 0});
  const auto truth = metaballs();
  const double h = mean_edge(mesh);
  for (const auto v : mesh.vertices()) {
    const auto normal = local_structure_at(truth, mesh.point(v)).euclidean.normal;
    const Fit_kernel::Vector_3 n(normal[0], normal[1], normal[2]);
    EXPECT_NEAR(traits.value(mesh.point(v) + h * n), h, 0.3 * h);
    EXPECT_NEAR(traits.value(mesh.point(v) - h * n), -h, 0.3 * h);
    EXPECT_TRUE(std::isnan(traits.value(mesh.point(v) + 4 * h * n)));
  }
  EXPECT_TRUE(std::isnan(traits.value({5, 5, 5})) && std::isnan(traits.taylor({5, 5, 5}).value()));
}

TEST(Fitted_function_traits_3, marching_cubes_remeshes_the_fitted_surface) {
  const Fit_mesh mesh = metaballs_mesh(30);
  const Traits traits(mesh, {.scale = 0});
  const auto surface = remeshed(traits, {.resolution = 40});
  const Fit_mesh remesh = to_surface_mesh(surface);
  EXPECT_TRUE(CGAL::is_closed(remesh));
  EXPECT_EQ(remesh.number_of_vertices() + remesh.number_of_faces(), remesh.number_of_edges() + 2);
  const auto truth = metaballs();
  for (const auto& p : surface.points) EXPECT_NEAR(truth.value(p), 0, 1e-3);

  const auto everywhere = remeshed(Without_bounds(traits), {.resolution = 40});
  EXPECT_EQ(everywhere.points, surface.points);
  EXPECT_EQ(everywhere.triangles, surface.triangles);
  EXPECT_LT(surface.function_evaluations, everywhere.function_evaluations);
}

TEST(Fitted_function_traits_3, the_delaunay_mesher_remeshes_the_fitted_surface) {
  const Fit_mesh mesh = metaballs_mesh(30);
  const auto surface = delaunay_surface(Traits(mesh, {.scale = 0}), {.radius = 0.1, .distance = 0.01});
  const Fit_mesh remesh = to_surface_mesh(surface);
  EXPECT_TRUE(CGAL::is_closed(remesh));
  EXPECT_EQ(remesh.number_of_vertices() + remesh.number_of_faces(), remesh.number_of_edges() + 2);
  for (const auto& p : surface.points) EXPECT_NEAR(metaballs().value(p), 0, 1e-3);
}

} // namespace fitted_structures_test
