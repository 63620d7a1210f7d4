// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_WHOLE_REMESH_3_H
#define EQUIAFFINE_FIT_INTERNAL_WHOLE_REMESH_3_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/internal/Creased_polygons_3.h>
#include <equiaffine/fit/internal/Crossing_places_3.h>
#include <equiaffine/fit/internal/Deviation_3.h>
#include <equiaffine/mesh/internal/crossing_triangles.h>
#include <equiaffine/mesh/internal/triangle_array_of.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

struct Remesh_request {
  std::optional<double> edge_length, feature_angle;
  unsigned iterations;
};

/// Remeshes a copy of a mesh so that its topology stays, triangles cross each other only where some did before, and
/// both meshes are within a tenth of an edge of each other: with edges of a length, or shorter ones if that is too long.
/// If none of them will do, the mesh stays as it is.
template <class Kernel>
class Whole_remesh_3 {
public:
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  using Edge_map = typename Mesh::template Property_map<typename Mesh::Edge_index, bool>;

  static constexpr const char* name_of_edges = "e:equiaffine_constrained";

  /// The map that `name_of_edges` has in the mesh marks the edges that are kept.
  template <class ConcurrencyTag>
  Whole_remesh_3(const Mesh& given, const Remesh_request& request, ConcurrencyTag)
      : array_(triangle_array_of(given, No_parameters())), mesh_(given) {
    const Topology topology = topology_of(given, array_);
    const std::vector<Triangle_pair> given_crossings = crossing_triangles(array_.points(), array_.triangles());
    if (given.number_of_faces() == 0) return;
    const Triangle_array_3 given_array = array_;
    if (request.feature_angle) creases_ = creases_of(given_array, *request.feature_angle);
    if (!has_degenerate_face(given)) {
      const double mean = mean_edge(given), least = least_length(given), shortest = std::max(mean / 4, least);
      edge_length_ = std::min(request.edge_length.value_or(mean), diagonal_of(given_array));
      check_argument(edge_length_ >= least, "edges of that length would make more than 10^8 triangles, or more than "
                                            "10^4 parts of an edge: give longer ones");
      const Deviation_3 deviation(given_array);
      do {
        if (remesh_nearby<ConcurrencyTag>(given, given_array, deviation, request.iterations) &&
            topology_of(mesh_, array_) == topology) {
          crossings_ = crossing_triangles(array_.points(), array_.triangles());
          if (Crossing_places_3(given_array, given_crossings, edge_length_).contain(array_, crossings_)) return;
        }
        edge_length_ *= 0.6;
      } while (edge_length_ > shortest);
    }
    mesh_ = given;
    keep_creases();
    array_ = given_array;
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
        for (unsigned k = 0; k < 2; ++k) result[mesh_.vertex(e, k)] = 1;
    return result;
  }

  /// The map that marks the edges that are kept.
  Edge_map kept_edges() {
    return mesh_.template add_property_map<typename Mesh::Edge_index, bool>(name_of_edges, false).first;
  }

  /// The length of edges that was aimed at; 0 if the mesh stayed as it was.
  double edge_length() const { return edge_length_; }

private:
  struct Topology {
    std::size_t border_loops, components;
    std::ptrdiff_t euler_characteristic;
    bool operator==(const Topology&) const = default;
  };

  static std::size_t number_of_border_loops(const Mesh& mesh) {
    std::size_t loops = 0;
    std::vector<char> is_seen(mesh.num_halfedges());
    for (const auto first : mesh.halfedges()) {
      if (!mesh.is_border(first) || is_seen[first]) continue;
      ++loops;
      for (auto h = first; !is_seen[h]; h = mesh.next(h)) is_seen[h] = 1;
    }
    return loops;
  }

  static Topology topology_of(const Mesh& mesh, const Triangle_array_3& array) {
    const Mesh_topology topology = mesh_topology(array.triangles(), array.points().size());
    return {number_of_border_loops(mesh), topology.components, topology.euler_characteristic};
  }

  /// CGAL's remeshing has undefined behavior for some meshes with triangles that are lines or points.
  static bool has_degenerate_face(const Mesh& mesh) {
    return std::any_of(mesh.faces().begin(), mesh.faces().end(),
                       [&](auto f) { return CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh); });
  }

  /// The diagonal of the bounding box: no edge of a remesh is longer.
  static double diagonal_of(const Triangle_array_3& array) {
    Eigen::AlignedBox3d box;
    for (const auto& p : array.points()) box.extend(p);
    return box.diagonal().norm();
  }

  /// The least length of edges that makes no more than 10^8 triangles and 10^4 parts of an edge. A mesh has about as
  /// many triangles as equilateral ones cover its area. Thin triangles become more where their edges are cut, which
  /// takes quadratic time in the parts of each.
  static double least_length(const Mesh& mesh) {
    constexpr double most_triangles = 1e8, most_parts = 1e4;
    const double area = CGAL::to_double(CGAL::Polygon_mesh_processing::area(mesh));
    double longest = 0;
    for (const auto e : mesh.edges()) longest = std::max(longest, length(mesh, e));
    return std::max(std::sqrt(area * 4 / std::sqrt(3.0) / most_triangles), longest / most_parts);
  }

  static double length(const Mesh& mesh, typename Mesh::Edge_index e) {
    return std::sqrt(
        CGAL::to_double(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  }

  static double mean_edge(const Mesh& mesh) {
    double sum = 0;
    for (const auto e : mesh.edges()) sum += length(mesh, e);
    return sum / double(mesh.number_of_edges());
  }

  /// Marks the creases of the given mesh, which this one still is.
  void keep_creases() {
    const Edge_map is_kept = kept_edges();
    for (const auto e : mesh_.edges()) {
      const auto [a, b] = std::minmax<Creased_polygons_3::Index>({mesh_.vertex(e, 0).idx(), mesh_.vertex(e, 1).idx()});
      if (std::binary_search(creases_.begin(), creases_.end(), Creased_polygons_3::Edge{a, b})) put(is_kept, e, true);
    }
  }

  /// Remeshes the given mesh. Where they are too far from each other, edges of the given one are kept, and it is
  /// remeshed again. Returns whether they are near each other in the end.
  template <class ConcurrencyTag>
  bool remesh_nearby(const Mesh& given, const Triangle_array_3& given_array, const Deviation_3& deviation,
                     unsigned iterations) {
    constexpr double farthest = 0.1; // a part of the edges
    constexpr int most_rounds = 8;
    std::vector<char> is_detail(given_array.points().size());
    for (int n = 0; n < most_rounds; ++n) {
      mesh_ = given;
      remesh(is_detail, n == 0, iterations);
      array_ = triangle_array_of(mesh_, No_parameters());
      std::vector<std::uint32_t> ring = deviation.far_vertices<ConcurrencyTag>(array_, farthest * edge_length_);
      if (ring.empty()) return true;
      for (const auto v : ring) is_detail[v] = 1;
      for (int k = 0; k <= n; ++k) ring = add_ring(ring, given_array, is_detail);
    }
    return false;
  }

  /// Marks the neighbors of vertices, and returns those that were not marked.
  static std::vector<std::uint32_t> add_ring(const std::vector<std::uint32_t>& vertices, const Triangle_array_3& mesh,
                                             std::vector<char>& marks) {
    std::vector<std::uint32_t> added;
    for (const auto v : vertices)
      for (const auto u : mesh.neighbors(v))
        if (!std::exchange(marks[u], 1)) added.push_back(u);
    return added;
  }

  /// Remeshes by CGAL, which keeps creases, and edges between vertices that are detail. It gives the halves of an edge
  /// the mark of the whole one.
  void remesh(const std::vector<char>& is_detail, bool collapses_creases, unsigned iterations) {
    enum Mark : unsigned char { FREE, CREASE, DETAIL };
    keep_creases();
    const Edge_map is_kept = kept_edges();
    auto marks =
        mesh_.template add_property_map<typename Mesh::Edge_index, unsigned char>("e:equiaffine_mark", FREE).first;
    for (const auto e : mesh_.edges())
      marks[e] = is_kept[e]                                                                   ? CREASE
                 : is_detail[mesh_.vertex(e, 0).idx()] && is_detail[mesh_.vertex(e, 1).idx()] ? DETAIL
                                                                                              : FREE;
    CGAL::Polygon_mesh_processing::isotropic_remeshing(faces(mesh_), edge_length_, mesh_,
                                                       CGAL::parameters::number_of_iterations(iterations)
                                                           .edge_is_constrained_map(marks)
                                                           .collapse_constraints(collapses_creases));
    for (const auto e : mesh_.edges()) is_kept[e] = marks[e] == CREASE;
    mesh_.remove_property_map(marks);
    mesh_.collect_garbage();
  }

  static std::vector<Creased_polygons_3::Edge> creases_of(const Triangle_array_3& mesh, double angle) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (const auto& t : mesh.triangles()) faces.emplace_back(t.begin(), t.end());
    return Creased_polygons_3(mesh.points(), std::move(faces)).creases(angle);
  }

  Triangle_array_3 array_;
  Mesh mesh_;
  std::vector<Creased_polygons_3::Edge> creases_;
  std::vector<Triangle_pair> crossings_;
  double edge_length_ = 0;
};

} // namespace equiaffine::internal

#endif
