// SPDX-License-Identifier: GPL-3.0-or-later
// Remeshes a triangle mesh, and moves its vertices onto the zero set of a fit.
#ifndef EQUIAFFINE_FIT_REMESH_ON_FIT_H
#define EQUIAFFINE_FIT_REMESH_ON_FIT_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/internal/Creased_polygons_3.h>
#include <equiaffine/fit/move_to_fit.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/Triangle_tree_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The neighborhoods of the places where triangles of a mesh intersect.
class Crossing_places_3 {
public:
  Crossing_places_3(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings, double distance)
      : boxes_(boxes_of(mesh, crossings, distance)) {}

  /// Returns whether all intersections of another mesh are at these places.
  bool contain(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings) const {
    std::vector<Triangle_box_3> mine = boxes_, others = boxes_of(mesh, crossings, 0);
    std::vector<char> is_here(others.size());
    CGAL::box_intersection_d(others.begin(), others.end(), mine.begin(), mine.end(),
                             [&](const auto& other, const auto&) { is_here[other.info()] = 1; });
    return std::find(is_here.begin(), is_here.end(), 0) == is_here.end();
  }

private:
  /// The intersections of the boxes of both triangles of each pair, widened by a distance.
  static std::vector<Triangle_box_3> boxes_of(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings,
                                              double distance) {
    std::vector<Triangle_box_3> boxes;
    for (std::size_t n = 0; n < crossings.size(); ++n) {
      const Triangle_box_3 a = box_of(crossings[n].first, mesh.points(), mesh.triangles());
      const Triangle_box_3 b = box_of(crossings[n].second, mesh.points(), mesh.triangles());
      const auto lower = [&](int axis) { return std::max(a.min_coord(axis), b.min_coord(axis)) - distance; };
      const auto upper = [&](int axis) { return std::min(a.max_coord(axis), b.max_coord(axis)) + distance; };
      boxes.emplace_back(CGAL::Bbox_3(lower(0), lower(1), lower(2), upper(0), upper(1), upper(2)), std::uint32_t(n));
    }
    return boxes;
  }

  std::vector<Triangle_box_3> boxes_;
};

/// The deviation between a mesh and other meshes, measured at vertices and triangle centers.
class Deviation_3 {
public:
  explicit Deviation_3(const Triangle_array_3& mesh) : mesh_(mesh), tree_(tree_of(mesh)) {}

  /// The vertices near which the distance between the meshes exceeds a limit, sorted: those beyond it themselves,
  /// the corners of triangles whose centers are, and the corners of the triangles nearest to such places of the
  /// other mesh.
  template <class ConcurrencyTag>
  std::vector<std::uint32_t> far_vertices(const Triangle_array_3& other, double limit) const {
    std::vector<std::uint32_t> far;
    const auto corners_of = [&](std::size_t triangle) {
      const auto& corners = mesh_.triangles()[triangle];
      far.insert(far.end(), corners.begin(), corners.end());
    };
    const Triangle_tree_3 other_tree = tree_of(other);
    const std::size_t vertices = mesh_.points().size();
    const auto mine = distances<ConcurrencyTag>(mesh_, other_tree);
    for (std::size_t k = 0; k < mine.size(); ++k) {
      if (!(mine[k].first > limit)) continue;
      if (k < vertices) far.push_back(std::uint32_t(k));
      else corners_of(k - vertices);
    }
    for (const auto& [distance, nearest] : distances<ConcurrencyTag>(other, tree_))
      if (distance > limit) corners_of(nearest);
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    return far;
  }

  /// The largest distance from the other mesh to this one, and from this one to the other.
  template <class ConcurrencyTag>
  std::pair<double, double> greatest(const Triangle_array_3& other) const {
    const auto greatest_of = [](const auto& distances) {
      double result = 0;
      for (const auto& [distance, nearest] : distances) result = std::max(result, distance);
      return result;
    };
    return {greatest_of(distances<ConcurrencyTag>(other, tree_)),
            greatest_of(distances<ConcurrencyTag>(mesh_, tree_of(other)))};
  }

private:
  using Vector = Eigen::Vector3d;

  static Triangle_tree_3::Point_3 point_of(const Vector& p) { return {p[0], p[1], p[2]}; }

  static Triangle_tree_3 tree_of(const Triangle_array_3& mesh) {
    return Triangle_tree_3(mesh.points(), mesh.triangles(), point_of);
  }

  /// The distances of the vertices, and then of the triangle centers, from another mesh, and the nearest triangles;
  /// 0 for isolated vertices.
  template <class ConcurrencyTag>
  static std::vector<std::pair<double, std::size_t>> distances(const Triangle_array_3& mesh,
                                                               const Triangle_tree_3& tree) {
    const std::size_t vertices = mesh.points().size();
    std::vector<std::pair<double, std::size_t>> result(vertices + mesh.triangles().size());
    parallel_for<ConcurrencyTag>(
        0, result.size(),
        [&](std::size_t k) {
          if (k < vertices && mesh.neighbors(k).empty()) return;
          result[k] = tree.nearest(point_of(k < vertices ? mesh.points()[k] : mesh.center(k - vertices)));
        },
        64);
    return result;
  }

  const Triangle_array_3& mesh_;
  const Triangle_tree_3 tree_;
};

/// Remeshes a copy of a mesh. The topology stays, triangles intersect only where some did before, and both meshes
/// are within a tenth of an edge of each other. If the target edge length is too long for that, shorter ones are
/// tried; if none works, the mesh stays as it is.
template <class Kernel>
class Whole_remesh_3 {
public:
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  using Edge_map = typename Mesh::template Property_map<typename Mesh::Edge_index, bool>;

  static constexpr const char* name_of_edges = "e:equiaffine_constrained";

  /// Edges marked by the property map `name_of_edges` of the mesh are kept.
  template <class ConcurrencyTag>
  Whole_remesh_3(const Mesh& given, const Remesh_options& options, ConcurrencyTag)
      : array_(triangle_array_of(given, No_parameters())), mesh_(given) {
    const Topology topology = topology_of(given, array_);
    const std::vector<Triangle_pair> given_crossings = crossing_triangles(array_.points(), array_.triangles());
    if (given.number_of_faces() == 0) return;
    const Triangle_array_3 given_array = array_;
    creases_ = creases_of(given_array, options.feature_angle);
    if (!has_degenerate_face(given)) {
      const double mean = mean_edge(given), least = least_length(given), shortest = std::max(mean / 4, least);
      edge_length_ = std::min(options.edge_length.value_or(mean), diagonal_of(given_array));
      if (!(edge_length_ >= least))
        throw Input_error::about("edge_length",
                                 "this edge length would give more than 10^8 triangles, or split an edge into more "
                                 "than 10^4 parts: give a longer one");
      const Deviation_3 deviation(given_array);
      do {
        if (remesh_nearby<ConcurrencyTag>(given, given_array, deviation, options.iterations) &&
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

  /// Marks the vertices of kept edges that are not on a border.
  std::vector<char> features() {
    std::vector<char> result(mesh_.number_of_vertices());
    const Edge_map is_kept = kept_edges();
    for (const auto e : mesh_.edges())
      if (is_kept[e] && !mesh_.is_border(e))
        for (unsigned k = 0; k < 2; ++k) result[mesh_.vertex(e, k)] = 1;
    return result;
  }

  /// The property map of the kept edges.
  Edge_map kept_edges() {
    return mesh_.template add_property_map<typename Mesh::Edge_index, bool>(name_of_edges, false).first;
  }

  /// The target edge length; 0 if the mesh stayed as it was.
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

  /// CGAL's remeshing has undefined behavior for some meshes with degenerate triangles.
  static bool has_degenerate_face(const Mesh& mesh) {
    return std::any_of(mesh.faces().begin(), mesh.faces().end(),
                       [&](auto f) { return CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh); });
  }

  /// The diagonal of the bounding box, an upper bound on the edge length of a remesh.
  static double diagonal_of(const Triangle_array_3& array) {
    Eigen::AlignedBox3d box;
    for (const auto& p : array.points()) box.extend(p);
    return box.diagonal().norm();
  }

  /// The smallest edge length that gives at most 10^8 triangles and splits no edge into more than 10^4 parts. The
  /// number of triangles is about that of the equilateral ones that cover the area. Splitting edges of thin
  /// triangles creates more triangles, in quadratic time in the parts of each edge.
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

  /// Marks the creases of the given mesh; must be called before remeshing.
  void keep_creases() {
    const Edge_map is_kept = kept_edges();
    for (const auto e : mesh_.edges()) {
      const auto [a, b] = std::minmax<Creased_polygons_3::Index>({mesh_.vertex(e, 0).idx(), mesh_.vertex(e, 1).idx()});
      if (std::binary_search(creases_.begin(), creases_.end(), Creased_polygons_3::Edge{a, b})) put(is_kept, e, true);
    }
  }

  /// Remeshes the given mesh. Where both are too far apart, edges of the given mesh are kept, and it is remeshed
  /// again. Returns whether they are close to each other in the end.
  template <class ConcurrencyTag>
  bool remesh_nearby(const Mesh& given, const Triangle_array_3& given_array, const Deviation_3& deviation,
                     unsigned iterations) {
    constexpr double farthest = 0.1; // fraction of the edge length
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

  /// Marks the neighbors of vertices, and returns those that were not marked before.
  static std::vector<std::uint32_t> add_ring(const std::vector<std::uint32_t>& vertices, const Triangle_array_3& mesh,
                                             std::vector<char>& marks) {
    std::vector<std::uint32_t> added;
    for (const auto v : vertices)
      for (const auto u : mesh.neighbors(v))
        if (!std::exchange(marks[u], 1)) added.push_back(u);
    return added;
  }

  /// Remeshes with CGAL, keeping creases and edges between detail vertices. CGAL gives the halves of a split edge
  /// the mark of the whole edge.
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

/// Copies a mesh, and marks the edges to keep in the property map of Whole_remesh_3.
template <class Kernel, class Mesh, class Parameters>
typename Whole_remesh_3<Kernel>::Mesh copy_to_remesh(const Mesh& mesh, const Parameters& parameters) {
  using Copy = typename Whole_remesh_3<Kernel>::Mesh;
  Copy copy;
  auto is_kept =
      copy.template add_property_map<typename Copy::Edge_index, bool>(Whole_remesh_3<Kernel>::name_of_edges, false)
          .first;
  std::vector<std::pair<typename boost::graph_traits<Mesh>::halfedge_descriptor, typename Copy::Halfedge_index>> pairs;
  CGAL::copy_face_graph(mesh, copy,
                        CGAL::parameters::vertex_point_map(vertex_points(mesh, parameters))
                            .halfedge_to_halfedge_output_iterator(std::back_inserter(pairs)));
  if constexpr (has_parameter<Edge_is_constrained_tag, Parameters>)
    for (const auto& [h, h_of_copy] : pairs)
      is_kept[copy.edge(h_of_copy)] = get(given_parameter<Edge_is_constrained_tag>(parameters), edge(h, mesh));
  return copy;
}

/// Replaces a mesh by its remesh, and assigns the outcomes to its vertices.
template <class Kernel, class Mesh, class Outcomes, class Parameters>
void replace_by_remesh(Mesh& mesh, Whole_remesh_3<Kernel>& whole_remesh, const Outcomes& outcomes,
                       const Parameters& parameters) {
  using Remesh = typename Whole_remesh_3<Kernel>::Mesh;
  const Remesh& remesh = whole_remesh.mesh();
  using Graph = boost::graph_traits<Mesh>;
  if constexpr (requires { mesh.clear_without_removing_property_maps(); }) mesh.clear_without_removing_property_maps();
  else CGAL::clear(mesh);
  std::vector<std::pair<typename Remesh::Vertex_index, typename Graph::vertex_descriptor>> new_vertices;
  std::vector<std::pair<typename Remesh::Halfedge_index, typename Graph::halfedge_descriptor>> new_halfedges;
  CGAL::copy_face_graph(remesh, mesh,
                        CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(new_vertices))
                            .halfedge_to_halfedge_output_iterator(std::back_inserter(new_halfedges)),
                        CGAL::parameters::vertex_point_map(vertex_points(mesh, parameters)));
  if constexpr (has_parameter<Vertex_outcome_tag, Parameters>)
    for (const auto& [from, to] : new_vertices)
      put(given_parameter<Vertex_outcome_tag>(parameters), to, get(outcomes, from));
  if constexpr (has_parameter<Edge_is_constrained_tag, Parameters>) {
    const auto is_kept = whole_remesh.kept_edges();
    for (const auto& [from, to] : new_halfedges)
      put(given_parameter<Edge_is_constrained_tag>(parameters), edge(to, mesh), is_kept[remesh.edge(from)]);
  }
}

/// Moves the remesh of a mesh to the fit, and replaces the mesh by it.
template <class ConcurrencyTag, class Kernel, class Mesh, class Parameters>
Fit_remesh_report replace_by_moved(Mesh& mesh, Whole_remesh_3<Kernel>& remesh, const Whole_motion_3& motion,
                                   const Parameters& parameters) {
  const Triangle_array_3 data = triangle_array_of(mesh, parameters);
  using Vertex = typename Whole_remesh_3<Kernel>::Mesh::Vertex_index;
  const auto outcomes = remesh.mesh().template add_property_map<Vertex, Fit_outcome>("v:equiaffine_outcome").first;
  const auto report = apply_motion<Kernel>(remesh.mesh(), motion, equiaffine::parameters::vertex_outcome_map(outcomes));
  replace_by_remesh<Kernel>(mesh, remesh, outcomes, parameters);
  const auto [from_data, of_data] =
      Deviation_3(data).greatest<ConcurrencyTag>({motion.points(), remesh.array().triangles()});
  return {report, remesh.edge_length(), from_data, of_data};
}

/// Rejects named parameters that are neither common to all remeshing functions nor among `OtherTags`.
template <class Parameters, class... OtherTags>
constexpr void check_remesh_parameters() {
  check_parameters<Parameters, Vertex_point_tag, Vertex_outcome_tag, Edge_is_constrained_tag, Geom_traits_tag,
                   Verbose_tag, OtherTags...>();
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Remeshes a triangle mesh with CGAL's isotropic remeshing, and moves its vertices onto the zero set of a fit to
/// it, see move_to_fit(). The mesh stays valid: it keeps its components, border loops and Euler characteristic, and
/// its triangles intersect only within an edge length of places where given ones did. At vertices and triangle
/// centers, the remesh is within a tenth of an edge of the given mesh and vice versa. Where detail is finer than the
/// edges, given edges are kept, or parts of them. From there no vertex moves to the fit by more than half the length
/// of its edges, or half the spacing of the data if that is larger. If the requested edge length does not allow
/// that, shorter ones are tried, down to a quarter of the given edge length, and then the given triangles. The
/// diagonal of the mesh is an upper limit on the edge length. Isolated vertices are removed. A mesh with a
/// degenerate triangle keeps all its triangles.
///
/// Edges that are constrained, or sharper than the feature angle, stay where they are, because a fit that does not
/// end there would round them off. Vertices next to them move to the fit only by up to a fifth of an edge. Sharp
/// edges count if they form creases, see fitted_structures().
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `edge_is_constrained_map` | writable property map | none | from edges to bool: edges to keep; updated |
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points of the fit's kernel |
/// | `vertex_outcome_map` | writable property map | none | from vertices of the result to Fit_outcome |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
///
/// Takes n log n time, about 0.1 ms per vertex, for each edge length that is tried, and up to seven times as much
/// again where edges are kept. CGAL::Parallel_tag gives the same numbers.
/// \throw Input_error if an option is invalid, or the edge length would give more than 10^8 triangles, or split an
/// edge into more than 10^4 parts. \throw std::invalid_argument if a face is not a triangle, or a coordinate is not
/// finite. The mesh is unchanged then.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, class Kernel,
          internal::Parameter_chain... Parameters>
Fit_remesh_report remesh_on_fit(Mesh& mesh, const Fitted_function_traits_3<Kernel>& fit,
                                const Remesh_options& options = {}, const Parameters&... given) {
  internal::check_remesh_parameters<internal::Joined_parameters<Parameters...>>();
  options.check();
  const auto np = internal::joined_parameters(given...);
  internal::Whole_remesh_3<Kernel> remesh(internal::copy_to_remesh<Kernel>(mesh, np), options, ConcurrencyTag());
  const auto motion =
      internal::motion_to_fit<ConcurrencyTag>(remesh.array(), fit, remesh.crossings(), remesh.features());
  return internal::replace_by_moved<ConcurrencyTag>(mesh, remesh, motion, np);
}

} // namespace equiaffine

#endif
