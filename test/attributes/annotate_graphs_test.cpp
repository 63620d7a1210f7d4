// SPDX-License-Identifier: GPL-3.0-or-later
// annotate(), annotate_by_fit() and the samplers with the meshes, maps and named parameters of CGAL.
#include "support/contraction.h"
#include "support/formulas.h"
#include "support/sample_volume.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/property_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#ifdef EQUIAFFINE_TEST_OPENMESH
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#endif

namespace annotate_graphs_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Other_kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // of the meshes
using Point = Other_kernel::Point_3;
using Vector = Other_kernel::Vector_3;
using Surface_mesh = CGAL::Surface_mesh<Point>;
using Linear_cell_complex =
    CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3,
                                                               CGAL::Linear_cell_complex_traits<3, Other_kernel>>::type;
template <class Graph>
using Vertex_of = typename boost::graph_traits<Graph>::vertex_descriptor;
template <class Graph, class Value>
using Values = std::map<Vertex_of<Graph>, Value>;

auto ellipsoid(double unit = 1) {
  const double r = 1.3 * unit;
  return test::Formula(Expression_3("x^2+2*y^2+3*z^2-unit^2", {{"unit", unit}}), CGAL::Bbox_3(-r, -r, -r, r, r, r));
}

/// Adds quads over a grid of the plane, and a row of pentagons and triangles, to a mesh: z = height(x, y).
template <class Graph, class Height>
void add_height_field(Graph& graph, std::size_t n, double unit, const Height& height) {
  std::vector<Vertex_of<Graph>> v;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double x = double(i) / double(n - 1) - 0.5, y = double(j) / double(n - 1) - 0.5;
      v.push_back(add_vertex(graph));
      put(CGAL::vertex_point, graph, v.back(), Point(unit * x, unit * y, unit * height(x, y)));
    }
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const std::size_t k = j * n + i;
      if (j > 0 || i + 2 == n) {
        CGAL::Euler::add_face(std::array{v[k], v[k + 1], v[k + n + 1], v[k + n]}, graph);
      } else if (i % 2 == 0) {
        CGAL::Euler::add_face(std::array{v[k], v[k + 1], v[k + 2], v[k + n + 2], v[k + n + 1]}, graph);
        CGAL::Euler::add_face(std::array{v[k], v[k + n + 1], v[k + n]}, graph);
      }
    }
}

template <class Graph>
class Annotate_graph : public testing::Test {};
#ifdef EQUIAFFINE_TEST_OPENMESH // the library is there, see CMakeLists.txt
struct Traits_of_OpenMesh : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Graphs = testing::Types<Surface_mesh, CGAL::Polyhedron_3<Other_kernel>, Linear_cell_complex,
                              OpenMesh::PolyMesh_ArrayKernelT<Traits_of_OpenMesh>>;
#else
using Graphs = testing::Types<Surface_mesh, CGAL::Polyhedron_3<Other_kernel>, Linear_cell_complex>;
#endif
TYPED_TEST_SUITE(Annotate_graph, Graphs);

TYPED_TEST(Annotate_graph, maps_that_are_given_hold_the_structure_at_any_scale) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  for (const double unit : {1e-6, 1., 1e6}) {
    const auto traits = ellipsoid(unit);
    TypeParam graph;
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    marching_cubes(traits, 0., points, triangles, {.resolution = 8});
    marching_cubes(traits, graph, {.resolution = 8});
    ASSERT_EQ(num_vertices(graph), points.size());
    ASSERT_EQ(num_faces(graph), triangles.size());
    ASSERT_TRUE(CGAL::is_closed(graph));
    Values<TypeParam, double> H, K, mean;
    Values<TypeParam, Vector> normals;
    Values<TypeParam, std::array<double, 6>> metric;
    Values<TypeParam, Point_status> status;
    annotate(graph, traits, CGAL::parameters::geom_traits(Other_kernel()),
             parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(H))
                 .vertex_affine_Gaussian_curvature_map(boost::make_assoc_property_map(K))
                 .vertex_mean_curvature_map(boost::make_assoc_property_map(mean))
                 .vertex_affine_normal_map(boost::make_assoc_property_map(normals))
                 .vertex_affine_metric_map(boost::make_assoc_property_map(metric))
                 .vertex_status_map(boost::make_assoc_property_map(status)));
    for (const auto v : vertices(graph)) {
      const auto p = get(CGAL::vertex_point, graph, v);
      const Kernel::Point_3 q(p.x(), p.y(), p.z());
      const auto s = local_structure_at(traits, q);
      // The affine curvatures of an ellipsoid are those of a sphere with the same volume. The ellipsoid is the level
      // set through the point, since CGAL's map of the points of OpenMesh rounds what is put into it to floats.
      const double radius = std::sqrt(unit * unit + traits.value(q));
      const double volume = std::pow(radius, 3) / std::sqrt(6);
      ASSERT_EQ(status.at(v), Point_status::REGULAR);
      EXPECT_NEAR(radius / unit, 1, 1e-6);
      EXPECT_NEAR(K.at(v) * volume, 1, 1e-9);
      EXPECT_NEAR(H.at(v) * std::sqrt(volume), -1, 1e-9);
      EXPECT_EQ(mean.at(v), -s.euclidean.mean_curvature);
      EXPECT_EQ(normals.at(v).y(), s.affine.normal[1]);
      EXPECT_EQ(metric.at(v), s.affine.metric);
      EXPECT_EQ(annotate(v, graph, traits).affine.mean_curvature, H.at(v));
    }
  }
}

TYPED_TEST(Annotate_graph, the_vertices_of_a_sampler_are_its_points_in_their_order) {
  Volume_3<Kernel> volume = sample_volume(Lattice_3<Kernel>({16, 16, 16}, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2)),
                                          [](double x, double y, double z) { return x * x + y * y + z * z - 1; });
  // Vertices around a sample that is smoothed away are UNCONVERGED.
  volume.values[volume.lattice.index(1, 1, 1)] = -0.5;
  const Sampled_function_traits_3<Kernel> traits(volume,
                                                 {.spline_scheme = Spline_scheme::CONVOLUTION, .spline_degree = 5});
  const auto surface = marching_cubes(traits);
  TypeParam graph;
  Values<TypeParam, Point_status> status;
  const auto result =
      marching_cubes(traits, graph, {}, parameters::vertex_status_map(boost::make_assoc_property_map(status)));
  ASSERT_TRUE(CGAL::is_valid_polygon_mesh(graph));
  ASSERT_EQ(num_vertices(graph), surface.points.size());
  EXPECT_GT(std::count(result.vertex_status.begin(), result.vertex_status.end(), Point_status::UNCONVERGED), 0);
  std::size_t i = 0;
  for (const auto v : vertices(graph)) {
    const auto p = get(CGAL::vertex_point, graph, v);
    const auto& q = surface.points[i];
    EXPECT_NEAR(std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()), 0, 1e-6) << i; // OpenMesh rounds to floats
    EXPECT_EQ(status.at(v), result.vertex_status[i++]);
  }
}

/// Expects the fits to the vertices of a height field of the given size to be right within their errors.
template <class Graph>
void expect_right_fits(double unit) {
  Graph graph;
  const auto height = [](double x, double y) { return 0.5 * x * x + y * y + 0.2 * x * x * y; };
  add_height_field(graph, 14, unit, height);
  Values<Graph, double> mean, error;
  annotate_by_fit(graph, {.scale = 0}, CGAL::parameters::verbose(false),
                  parameters::vertex_mean_curvature_map(boost::make_assoc_property_map(mean))
                      .vertex_mean_curvature_error_map(boost::make_assoc_property_map(error)));
  std::size_t right = 0, all = 0, known = 0, inside = 0;
  for (const auto v : vertices(graph)) {
    const auto p = get(CGAL::vertex_point, graph, v);
    const double x = p.x() / unit, y = p.y() / unit, fx = x + 0.4 * x * y, fy = 2 * y + 0.2 * x * x, fxx = 1 + 0.4 * y,
                 fxy = 0.4 * x, fyy = 2, g = 1 + fx * fx + fy * fy;
    const double exact = ((1 + fy * fy) * fxx - 2 * fx * fy * fxy + (1 + fx * fx) * fyy) / (2 * std::pow(g, 1.5));
    // Faces are counterclockwise from above, where this graph is hollow: negative with the sign of CGAL.
    right += std::abs(mean.at(v) * unit + exact) <= error.at(v) * unit + 1e-9;
    ++all;
    if (std::max(std::abs(x), std::abs(y)) > 0.4) continue;
    known += error.at(v) <= 0.01 * std::abs(mean.at(v));
    ++inside;
  }
  EXPECT_GE(double(right), 0.9 * double(all));
  EXPECT_GE(double(known), 0.9 * double(inside)) << "to one percent, away from the border";
}

TYPED_TEST(Annotate_graph, fits_to_quads_and_other_polygons_are_right_within_their_errors) {
  expect_right_fits<TypeParam>(1);
}

TEST(Annotate_maps, fits_to_a_mesh_of_any_size_are_right_within_their_errors) {
  for (const double unit : {1e-6, 1e6}) expect_right_fits<Surface_mesh>(unit);
}

TEST(Annotate_maps, curvatures_of_a_sphere_are_positive_as_in_CGAL) {
  const auto sphere = test::formula("x^2+y^2+z^2-.25", CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  Surface_mesh mesh;
  marching_cubes(sphere, mesh, {.resolution = 10});
  using Vertex = Surface_mesh::Vertex_index;
  struct Principal {
    double min_curvature, max_curvature;
    Vector min_direction, max_direction;
  };
  const auto mean = mesh.add_property_map<Vertex, double>("mean").first;
  const auto gaussian = mesh.add_property_map<Vertex, float>("gaussian").first;
  const auto principal = mesh.add_property_map<Vertex, Principal>("principal").first;
  annotate<CGAL::Parallel_if_available_tag>(mesh, sphere,
                                            parameters::vertex_mean_curvature_map(mean)
                                                .vertex_Gaussian_curvature_map(gaussian)
                                                .vertex_principal_curvatures_and_directions_map(principal));
  ASSERT_GT(mesh.number_of_vertices(), 50U);
  for (const Vertex v : mesh.vertices()) {
    EXPECT_NEAR(mean[v], 2, 1e-12);
    EXPECT_NEAR(gaussian[v], 4, 1e-6);
    EXPECT_NEAR(principal[v].min_curvature, 2, 1e-12);
    EXPECT_NEAR(principal[v].max_direction.squared_length(), 1, 1e-12);
    EXPECT_LE(principal[v].min_curvature, principal[v].max_curvature);
  }
  EXPECT_TRUE((mesh.add_property_map<Vertex, double>("v:k1").second)) << "only what is asked for";
}

TEST(Annotate_maps, a_vertex_that_did_not_converge_keeps_its_status) {
  const auto traits = ellipsoid();
  Surface_mesh mesh;
  Values<Surface_mesh, Point_status> status;
  const auto map = boost::make_assoc_property_map(status);
  const auto facts = marching_cubes(traits, mesh, {.resolution = 8}, parameters::vertex_status_map(map));
  EXPECT_EQ(facts.vertex_status.size(), mesh.number_of_vertices());
  EXPECT_TRUE(facts.points.empty());
  const Surface_mesh::Vertex_index v(3);
  status[v] = Point_status::UNCONVERGED;
  annotate(mesh, traits, parameters::vertex_status_map(map));
  EXPECT_EQ(status[v], Point_status::UNCONVERGED);
  EXPECT_EQ(status[Surface_mesh::Vertex_index(4)], Point_status::REGULAR);
}

TEST(Annotate_maps, the_last_of_equal_names_counts_in_chains_of_both_libraries) {
  const auto traits = ellipsoid();
  Surface_mesh mesh;
  marching_cubes(traits, mesh, {.resolution = 6});
  using Vertex = Surface_mesh::Vertex_index;
  const auto twice = mesh.add_property_map<Vertex, Point>("twice").first;
  for (const Vertex v : mesh.vertices()) twice[v] = CGAL::ORIGIN + 2 * (mesh.point(v) - CGAL::ORIGIN);
  const auto K = mesh.add_property_map<Vertex, double>("K").first;
  const auto at = [&](const auto&... parameters) {
    annotate(mesh, traits, parameters...);
    return K[Vertex(0)];
  };
  const auto ours = parameters::vertex_affine_Gaussian_curvature_map(K);
  const double own = at(ours);
  const double of_twice = at(CGAL::parameters::vertex_point_map(twice), ours);
  EXPECT_NEAR(of_twice, own / 8, 1e-9 * own);
  EXPECT_EQ(at(ours, CGAL::parameters::vertex_point_map(twice)), of_twice);
  EXPECT_EQ(at(ours.vertex_point_map(twice)), of_twice);
  EXPECT_EQ(at(CGAL::parameters::vertex_point_map(twice), ours.vertex_point_map(mesh.points())), own);
}

TEST(Annotate_maps, a_range_of_points_has_maps_from_its_elements) {
  const auto traits = ellipsoid();
  CGAL::Point_set_3<Point> points;
  points.insert(Point(1, 0, 0));
  points.insert(Point(0, std::sqrt(0.5), 0));
  const auto conormals = points.add_property_map<Vector>("conormal").first;
  annotate(points, traits, parameters::vertex_conormal_map(conormals));
  EXPECT_GT(conormals[0].x(), 0);
  EXPECT_GT(conormals[1].y(), 0);
  EXPECT_NEAR(conormals[1].x(), 0, 1e-15);
  std::map<Point, double> K;
  annotate(std::vector<Point>{{1, 0, 0}}, traits,
           parameters::vertex_affine_Gaussian_curvature_map(boost::make_assoc_property_map(K)));
  EXPECT_NEAR(K.at(Point(1, 0, 0)), std::sqrt(6.), 1e-9);
}

TEST(Annotate_maps, values_may_be_in_the_elements_of_the_range) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using Element = std::tuple<Point, double, std::array<float, 3>, std::array<float, 6>>;
  std::vector<Element> elements = {{Point(1, 0, 0), 0, {}, {}}, {Point(0, std::sqrt(0.5), 0), 0, {}, {}}};
  const auto f = ellipsoid();
  annotate(elements, f,
           parameters::point_map(CGAL::Nth_of_tuple_property_map<0, Element>())
               .vertex_affine_Gaussian_curvature_map(CGAL::Nth_of_tuple_property_map<1, Element>())
               .vertex_affine_normal_map(CGAL::Nth_of_tuple_property_map<2, Element>())
               .vertex_affine_metric_map(CGAL::Nth_of_tuple_property_map<3, Element>()));
  for (const auto& [p, K, normal, metric] : elements) {
    const auto expected = local_structure_at(f, Kernel::Point_3(p.x(), p.y(), p.z())).affine;
    EXPECT_EQ(K, expected.gaussian_curvature);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(normal[i], float(expected.normal[i]));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(metric[i], float(expected.metric[i]));
  }
}

TEST(Annotate_maps, a_map_that_grows_when_it_is_read_has_the_same_entries_with_threads) {
  std::vector<Point> points;
  for (int i = 0; i < 2000; ++i) points.emplace_back(std::cos(i), std::sin(i), 0.01 * i);
  std::map<Point, double> one, many;
  std::map<Point, Point_status> status, status_of_many;
  const auto f = ellipsoid();
  annotate(points, f,
           parameters::vertex_pick_invariant_map(boost::make_assoc_property_map(one))
               .vertex_status_map(boost::make_assoc_property_map(status)));
  annotate<CGAL::Parallel_if_available_tag>(points, f,
                                            parameters::vertex_pick_invariant_map(boost::make_assoc_property_map(many))
                                                .vertex_status_map(boost::make_assoc_property_map(status_of_many)));
  EXPECT_EQ(one.size(), points.size());
  EXPECT_EQ(one, many);
  EXPECT_EQ(status, status_of_many);
}

TEST(Annotate_maps, fits_to_a_point_set_take_its_points_and_the_normals_that_CGAL_calls_normal_map) {
  const auto traits = ellipsoid();
  const auto surface = test::surface_of(traits, {.resolution = 16});
  CGAL::Point_set_3<Point> points;
  points.add_normal_map();
  for (const auto& p : surface.points) {
    const auto n = local_structure_at(traits, p).euclidean.normal;
    points.insert(Point(p.x(), p.y(), p.z()), Vector(-n[0], -n[1], -n[2]));
  }
  const auto H = points.add_property_map<double>("H").first;
  const auto error = points.add_property_map<double>("error").first;
  const auto ours = parameters::vertex_affine_mean_curvature_map(H).vertex_affine_mean_curvature_error_map(error);
  annotate_by_fit<CGAL::Parallel_if_available_tag>(points, {.scale = 0}, ours,
                                                   CGAL::parameters::normal_map(points.normal_map()));
  std::size_t positive = 0;
  for (const auto& i : points) positive += H[i] > 0;
  EXPECT_EQ(positive, points.size()) << "normals point inside";
}

TEST(Annotate_maps, a_fit_at_one_vertex_is_that_of_all_within_the_errors) {
  const auto traits = ellipsoid();
  Surface_mesh mesh;
  marching_cubes(traits, mesh, {.resolution = 14});
  using Vertex = Surface_mesh::Vertex_index;
  std::map<Vertex, Fitted_structure_3<double>> all;
  annotate_by_fit(mesh, boost::make_assoc_property_map(all), {.scale = 0});
  for (const Vertex v : {Vertex(0), Vertex(200)}) {
    const auto one = annotate_by_fit(v, mesh, {.scale = 0}), other = all.at(v);
    EXPECT_NEAR(one.structure.affine.mean_curvature, other.structure.affine.mean_curvature,
                one.error.affine_mean_curvature + other.error.affine_mean_curvature);
  }
}

TEST(Samplers, write_into_the_containers_of_the_caller_behind_what_is_there) {
  const auto traits = ellipsoid();
  const auto surface = marching_cubes(traits, {.resolution = 9});
  std::vector<Point> points = {{7, 7, 7}};
  std::vector<std::vector<std::size_t>> triangles = {{0, 0, 0}};
  const auto facts = marching_cubes(traits, 0., points, triangles, {.resolution = 9}, CGAL::parameters::verbose(true));
  ASSERT_EQ(points.size(), surface.points.size() + 1);
  ASSERT_EQ(triangles.size(), surface.triangles.size() + 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(triangles[t + 1][k], surface.triangles[t][k] + 1);
  EXPECT_EQ(points[5].x(), surface.points[4].x());
  EXPECT_EQ(facts.vertex_status, surface.vertex_status);
  EXPECT_EQ(facts.repairs.contracted_edges, surface.repairs.contracted_edges);
}

TEST(Samplers, the_isovalue_is_a_level_of_the_function) {
  const auto traits = ellipsoid();
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
  marching_cubes(traits, 0.3, points, triangles, {.resolution = 9});
  ASSERT_FALSE(points.empty());
  for (const Point& p : points) EXPECT_NEAR(traits.value(Kernel::Point_3(p.x(), p.y(), p.z())), 0.3, 1e-12);
}

} // namespace annotate_graphs_test
