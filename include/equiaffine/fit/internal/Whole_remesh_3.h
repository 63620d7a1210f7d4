// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_WHOLE_REMESH_3_H
#define EQUIAFFINE_FIT_INTERNAL_WHOLE_REMESH_3_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/internal/crossing_triangles.h>
#include <equiaffine/fit/internal/triangle_array_of.h>
#include <equiaffine/surface/mesh_topology.h>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <compare>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

struct Remesh_request {
  std::optional<double> edge_length, feature_angle;
  unsigned iterations;
};

/// Remeshes a copy of a mesh so that its topology stays, with edges of a length, or shorter ones where these would make
/// triangles cross each other in a mesh that did not cross itself. Where no length does, the mesh stays as it is.
template <class Kernel>
class Whole_remesh_3 {
public:
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  using Edge_map = typename Mesh::template Property_map<typename Mesh::Edge_index, bool>;

  static constexpr const char* name_of_edges = "e:equiaffine_constrained";

  /// The map that `name_of_edges` has in the mesh marks the edges that are kept.
  Whole_remesh_3(const Mesh& given, const Remesh_request& request)
      : array_(triangle_array_of(given, No_parameters())), mesh_(given) {
    const Topology topology = topology_of(given, array_);
    const std::vector<Triangle_pair> given_crossings = crossing_triangles(array_.points(), array_.triangles());
    if (given.number_of_faces() == 0) return;
    const double shortest = mean_edge(given) / 4;
    edge_length_ = request.edge_length.value_or(mean_edge(given));
    check_number_of_triangles();
    do {
      mesh_ = given;
      remesh(request);
      array_ = triangle_array_of(mesh_, No_parameters());
      crossings_ = crossing_triangles(array_.points(), array_.triangles());
      if (topology_of(mesh_, array_) == topology && (crossings_.empty() || !given_crossings.empty())) return;
      edge_length_ *= 0.6;
    } while (edge_length_ > shortest);
    mesh_ = given;
    keep_sharp_edges(request);
    array_ = triangle_array_of(mesh_, No_parameters());
    crossings_ = given_crossings;
    edge_length_ = 0;
  }

  Mesh& mesh() { return mesh_; }
  const Triangle_array_3& array() const { return array_; }
  const std::vector<Triangle_pair>& crossings() const { return crossings_; }

  /// Marks the vertices of edges that are kept and no borders.
  std::vector<char> features() {
    std::vector<char> result(mesh_.number_of_vertices());
    const Edge_map is_kept = kept_edges();
    for (const auto e : mesh_.edges())
      if (is_kept[e] && !mesh_.is_border(e))
        for (int k = 0; k < 2; ++k) result[mesh_.vertex(e, k)] = 1;
    return result;
  }

  /// The length of edges that was aimed at; 0 if the mesh stayed as it was.
  double edge_length() const { return edge_length_; }

private:
  struct Topology {
    std::size_t border_loops, components;
    std::ptrdiff_t euler_characteristic;
    bool operator==(const Topology&) const = default;
  };

  static Topology topology_of(const Mesh& mesh, const Triangle_array_3& array) {
    std::vector<typename Mesh::Halfedge_index> loops;
    CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(loops));
    const Mesh_topology topology = mesh_topology(array.triangles(), array.points().size());
    return {loops.size(), topology.components, topology.euler_characteristic};
  }

  /// A mesh has about as many triangles as equilateral ones cover its area.
  void check_number_of_triangles() const {
    constexpr double most = 1e8;
    const double number = CGAL::to_double(CGAL::Polygon_mesh_processing::area(mesh_)) * 4 / std::sqrt(3.0) /
                          (edge_length_ * edge_length_);
    check_argument(number < most, "edges of that length would make more than 10^8 triangles: give longer ones");
  }

  static double mean_edge(const Mesh& mesh) {
    double sum = 0;
    for (const auto e : mesh.edges())
      sum += std::sqrt(
          CGAL::to_double(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
    return sum / double(mesh.number_of_edges());
  }

  Edge_map kept_edges() {
    return mesh_.template add_property_map<typename Mesh::Edge_index, bool>(name_of_edges, false).first;
  }

  void keep_sharp_edges(const Remesh_request& request) {
    if (request.feature_angle)
      CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh_, *request.feature_angle, kept_edges());
  }

  void remesh(const Remesh_request& request) {
    keep_sharp_edges(request);
    CGAL::Polygon_mesh_processing::isotropic_remeshing(
        faces(mesh_), edge_length_, mesh_,
        CGAL::parameters::number_of_iterations(request.iterations).edge_is_constrained_map(kept_edges()));
    mesh_.collect_garbage();
  }

  Triangle_array_3 array_;
  Mesh mesh_;
  std::vector<Triangle_pair> crossings_;
  double edge_length_ = 0;
};

} // namespace equiaffine::internal

#endif
