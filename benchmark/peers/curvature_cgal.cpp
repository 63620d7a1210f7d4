// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled with the headers of CGAL 6 into a separate library that exports one function. The rest of the program uses
// the installed CGAL.
#include "curvature_peers.h"

#include <CGAL/Polygon_mesh_processing/interpolated_corrected_curvatures.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

__attribute__((visibility("default"))) Euclidean_curvatures corrected_curvatures(const Plain_mesh& mesh,
                                                                                 double radius) {
  using Point_3 = CGAL::Simple_cartesian<double>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point_3>;
  Mesh graph;
  std::vector<Mesh::Vertex_index> vertices;
  for (const auto& [x, y, z] : mesh.points) vertices.push_back(graph.add_vertex(Point_3(x, y, z)));
  for (const auto& [a, b, c] : mesh.triangles) graph.add_face(vertices[a], vertices[b], vertices[c]);
  const auto mean = graph.add_property_map<Mesh::Vertex_index, double>("mean").first;
  const auto gaussian = graph.add_property_map<Mesh::Vertex_index, double>("gaussian").first;
  namespace parameters = CGAL::parameters;
  CGAL::Polygon_mesh_processing::interpolated_corrected_curvatures(
      graph, parameters::vertex_mean_curvature_map(mean).vertex_Gaussian_curvature_map(gaussian).ball_radius(radius));
  Euclidean_curvatures result;
  for (const auto v : vertices) {
    result.mean.push_back(mean[v]);
    result.gaussian.push_back(gaussian[v]);
  }
  return result;
}
