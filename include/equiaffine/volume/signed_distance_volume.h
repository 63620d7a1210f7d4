// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the signed distance to a closed triangle mesh at every node of a lattice.
#ifndef EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H
#define EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Triangle_tree.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The kernel that decides on which side of the mesh a point lies. Its predicates are exact.
using Side_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Distance_mesh = CGAL::Surface_mesh<Side_kernel::Point_3>;

/// A point as text for error messages.
inline std::string place(const Side_kernel::Point_3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

/// Throws Input_error if a coordinate is not finite, or so large that adding 1 has no effect in floating point: CGAL
/// finds the side of a point by a ray through a second point one unit away.
inline void check_coordinates_of_mesh(const Distance_mesh& mesh) {
  constexpr double greatest = 1e15;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    const double largest = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      throw Input_error("the mesh has a vertex with a coordinate that is not a finite number, " + place(p) +
                        ": correct or remove it");
    if (largest > greatest)
      throw Input_error("the mesh has a vertex with a coordinate beyond 1e15, " + place(p) +
                        ": correct it or choose another unit");
  }
}

/// Throws Input_error if the squared area of a triangle underflows: distances are computed with normal vectors whose
/// squared lengths would lose digits or vanish.
inline void check_areas(const Distance_mesh& mesh) {
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    if (CGAL::cross_product(q - p, r - p).squared_length() < std::numeric_limits<double>::min())
      throw Input_error("the mesh has a triangle near " + place(p) +
                        " whose squared area underflows double precision: choose a smaller unit of length, or remove "
                        "the triangle if the others are larger");
  }
}

/// Throws Input_error unless the mesh bounds a volume: its faces are triangles that are not too small and touch only
/// at common edges and vertices, and it has no border.
inline void check_bounds_volume(const Distance_mesh& mesh) {
  if (mesh.number_of_faces() == 0) throw Input_error("the mesh has no faces: give a closed mesh of triangles");
  check_coordinates_of_mesh(mesh);
  for (const auto f : mesh.faces())
    if (const auto degree = mesh.degree(f); degree != 3)
      throw Input_error("the mesh has a face with " + std::to_string(degree) + " vertices, one of them at " +
                        place(mesh.point(mesh.target(mesh.halfedge(f)))) + ": triangulate its faces first");
  std::vector<Distance_mesh::Halfedge_index> border;
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h)) border.push_back(h);
  if (!border.empty())
    throw Input_error("the mesh is not closed, it has " + std::to_string(border.size()) +
                      " border edges, one of them at " + place(mesh.point(mesh.target(border.front()))) +
                      ": fill its holes first");
  std::vector<std::pair<Distance_mesh::Face_index, Distance_mesh::Face_index>> contacts;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(mesh, std::back_inserter(contacts),
                                                                          CGAL::parameters::maximum_number(1));
  if (!contacts.empty())
    throw Input_error("the mesh has degenerate triangles or intersects itself near " +
                      place(mesh.point(mesh.target(mesh.halfedge(contacts.front().first)))) +
                      ", so its inside is not defined: repair it first");
  check_areas(mesh);
}

/// The nodes first[n] .. first[n] + size[n] - 1 along each axis n of a lattice.
struct Lattice_block {
  std::array<std::size_t, 3> first, size;

  std::size_t number_of_nodes() const { return size[0] * size[1] * size[2]; }

  template <class F>
  void for_each_node(const F& f) const {
    for (std::size_t k = first[2]; k < first[2] + size[2]; ++k)
      for (std::size_t j = first[1]; j < first[1] + size[1]; ++j)
        for (std::size_t i = first[0]; i < first[0] + size[0]; ++i) f(i, j, k);
  }
};

/// The parallelepiped of a block of nodes, and the vector from a point of the surface to its center.
struct Node_region {
  using Point_3 = Distance_kernel::Point_3;
  using Vector_3 = Distance_kernel::Vector_3;

  Point_3 center;
  std::array<Vector_3, 3> half_sides;
  double squared_radius;
  Vector_3 from_surface;

  /// Whether no point of the half-space, given relative to the center, is nearest to a point of the region. Let L and
  /// n be the distance and direction of the half-space, g = from_surface, and e a vector from the center into the
  /// region. The squared distance of center + e to the half-space is at least (L + n e)^2 >= L^2 + 2 L n e, and to
  /// the surface at most (g + e)^2 = g^2 + 2 g e + e^2.
  bool is_far_from(const Half_space& bound) const {
    const double surplus = bound.distance * bound.distance - from_surface.squared_length() - squared_radius;
    if (!(bound.distance > 0 && surplus > 0)) return false;
    const Vector_3 v = bound.distance * bound.direction - from_surface;
    return surplus > 2 * (std::abs(v * half_sides[0]) + std::abs(v * half_sides[1]) + std::abs(v * half_sides[2]));
  }
};

/// Measures distances to triangles at all nodes of a lattice. It descends two trees at once: blocks of nodes, and for
/// each block the parts of the triangle tree that may be nearest to one of its nodes. A block inherits these parts
/// from its parent, drops those that are too far, and opens boxes that are large compared to the block. Source of
/// such traversals: A. Gray, A. Moore, 'N-body' problems in statistical learning, 2000.
///
/// The result is the minimum of the distances that CGAL computes to the triangles. It does not depend on the
/// traversal.
template <class ConcurrencyTag, class Kernel, class Progress>
class Lattice_distances {
public:
  using FT = typename Kernel::FT;

  /// Distances beyond `band` are NaN.
  Lattice_distances(const Triangle_tree& tree, const Lattice_3<Kernel>& lattice, const Progress& on_progress,
                    double band)
      : tree_(tree), lattice_(lattice), on_progress_(on_progress), band_(band), distances_(lattice.number_of_nodes()) {
    measure({{0, 0, 0}, lattice.size()}, node(0, 0, 0), {{0, {Vector_3(0, 0, 0), 0}}}, first_triangle);
  }

  /// The distances in the order of `Volume_3::values`.
  std::vector<FT>& distances() { return distances_; }

private:
  using Point_3 = Distance_kernel::Point_3;
  using Vector_3 = Distance_kernel::Vector_3;
  using Part = Triangle_tree::Part;
  struct Candidate {
    Part part;
    Half_space bound; ///< relative to the center of a block
  };
  using Candidates = std::vector<Candidate>;
  struct Nearest {
    Part triangle;
    Point_3 point;
    double squared_distance;
  };
  static constexpr Part first_triangle = ~Part(0);
  static constexpr std::size_t smallest_block = 8, smallest_task = 4096; // nodes
  static constexpr double largest_box = 0.25;                            // relative to the size of a block

  Point_3 node(std::size_t i, std::size_t j, std::size_t k) const {
    const auto p = lattice_.point(FT(i), FT(j), FT(k));
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  /// The region of a block, with `from_surface` still zero.
  Node_region region(const Lattice_block& block) const {
    const auto& [i, j, k] = block.first;
    const auto& [nx, ny, nz] = block.size;
    const Point_3 p = node(i, j, k);
    const std::array<Vector_3, 3> h = {(node(i + nx - 1, j, k) - p) / 2, (node(i, j + ny - 1, k) - p) / 2,
                                       (node(i, j, k + nz - 1) - p) / 2};
    double squared_radius = 0;
    for (const auto& v : {h[0] + h[1] + h[2], h[0] + h[1] - h[2], h[0] - h[1] + h[2], h[0] - h[1] - h[2]})
      squared_radius = std::max(squared_radius, v.squared_length());
    return {p + (h[0] + h[1] + h[2]), h, squared_radius, Vector_3(0, 0, 0)};
  }

  /// Replaces `nearest` if a triangle of a part is nearer to p; `project` maps a triangle and p to the nearest point.
  template <class Project>
  void improve(Nearest& nearest, const Point_3& p, Part part, const Project& project) const {
    if (Triangle_tree::is_triangle(part)) {
      const Point_3 q = project(tree_.triangle(part), p);
      const double distance = CGAL::squared_distance(p, q);
      if (distance < nearest.squared_distance) nearest = {part, q, distance};
      return;
    }
    std::array<Part, 2> children = tree_.children(part);
    const auto distance_to = [&](Part child) {
      return Triangle_tree::is_triangle(child) ? 0 : CGAL::squared_distance(p, tree_.nearest_point(child, p));
    };
    std::array<double, 2> distances = {distance_to(children[0]), distance_to(children[1])};
    if (distances[1] < distances[0]) std::swap(distances[0], distances[1]), std::swap(children[0], children[1]);
    for (std::size_t n = 0; n < 2; ++n)
      if (distances[n] <= nearest.squared_distance) improve(nearest, p, children[n], project);
  }

  /// The triangle nearest to p among candidates whose bounds are relative to `center`; `guess` is a nearby triangle.
  template <class Project>
  Nearest find_nearest(const Point_3& p, const Point_3& center, const Candidates& candidates, Part guess,
                       const Project& project) const {
    Nearest nearest = {guess, p, std::numeric_limits<double>::infinity()};
    improve(nearest, p, guess, project);
    const Vector_3 v = p - center;
    for (const auto& [part, bound] : candidates) {
      const double distance = bound.distance + bound.direction * v;
      const bool is_too_far = distance > 0 && distance * distance > nearest.squared_distance;
      if (!is_too_far && part != guess) improve(nearest, p, part, project);
    }
    return nearest;
  }

  /// Adds a part to the candidates of a region unless it is too far; adds its children instead if it is large.
  void add_if_near(Candidates& candidates, const Node_region& region, Part part) const {
    const Half_space bound = tree_.half_space(part, region.center);
    if (region.is_far_from(bound)) return;
    const double radius = tree_.radius(part) / largest_box;
    if (radius * radius > region.squared_radius && !Triangle_tree::is_triangle(part))
      for (const Part child : tree_.children(part)) add_if_near(candidates, region, child);
    else candidates.push_back({part, bound});
  }

  /// The candidates of a region, selected from those of an enclosing region with the given center.
  Candidates near_candidates(const Node_region& region, const Point_3& outer_center, const Candidates& outer) const {
    Candidates candidates;
    const Vector_3 v = region.center - outer_center;
    for (const auto& [part, bound] : outer)
      if (!region.is_far_from({bound.direction, bound.distance + bound.direction * v}))
        add_if_near(candidates, region, part);
    return candidates;
  }

  void store(std::size_t i, std::size_t j, std::size_t k, double distance) {
    distances_[lattice_.index(i, j, k)] = FT(distance <= band_ ? distance : std::numeric_limits<double>::quiet_NaN());
  }

  /// Measures distances at the nodes of a block one by one.
  void measure_nodes(const Lattice_block& block, const Point_3& center, const Candidates& candidates, Part guess) {
    const auto project = Distance_kernel().construct_projected_point_3_object();
    block.for_each_node([&](std::size_t i, std::size_t j, std::size_t k) {
      const Nearest nearest = find_nearest(node(i, j, k), center, candidates, guess, project);
      guess = nearest.triangle;
      store(i, j, k, std::sqrt(nearest.squared_distance));
    });
  }

  /// Halves a block along each axis along which it is longer than half of its longest side.
  static std::vector<Lattice_block> halves(const Lattice_block& block, const std::array<Vector_3, 3>& half_sides) {
    double longest = 0;
    for (const Vector_3& h : half_sides) longest = std::max(longest, h.squared_length());
    std::vector<Lattice_block> blocks = {block};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (4 * half_sides[axis].squared_length() <= longest) continue;
      for (std::size_t n = 0, count = blocks.size(); n < count; ++n) {
        Lattice_block upper = blocks[n];
        blocks[n].size[axis] /= 2;
        upper.first[axis] += blocks[n].size[axis];
        upper.size[axis] -= blocks[n].size[axis];
        blocks.push_back(upper);
      }
    }
    return blocks;
  }

  /// Measures distances at the nodes of a block inside one with the given center and candidates.
  void measure(const Lattice_block& block, const Point_3& outer_center, const Candidates& outer, Part guess) {
    Node_region region = this->region(block);
    const Nearest nearest =
        find_nearest(region.center, outer_center, outer, guess,
                     [](const auto& triangle, const Point_3& p) { return nearest_point(triangle, p); });
    region.from_surface = region.center - nearest.point;
    const std::size_t count = block.number_of_nodes();
    if (std::sqrt(nearest.squared_distance) > band_ + std::sqrt(region.squared_radius) + tree_.slack()) {
      block.for_each_node([&](std::size_t i, std::size_t j, std::size_t k) {
        store(i, j, k, std::numeric_limits<double>::infinity());
      });
      return on_progress_(count);
    }
    const Candidates candidates = near_candidates(region, outer_center, outer);
    if (count <= smallest_block) {
      measure_nodes(block, region.center, candidates, nearest.triangle);
      return on_progress_(count);
    }
    const auto blocks = halves(block, region.half_sides);
    const auto measure_part = [&](std::size_t n) { measure(blocks[n], region.center, candidates, nearest.triangle); };
    if (count > smallest_task) parallel_for<ConcurrencyTag>(0, blocks.size(), measure_part);
    else parallel_for<CGAL::Sequential_tag>(0, blocks.size(), measure_part);
  }

  const Triangle_tree& tree_;
  const Lattice_3<Kernel>& lattice_;
  const Progress& on_progress_;
  double band_;
  std::vector<FT> distances_;
};

/// The tree of the triangles of a mesh, with a slack for distances from the nodes of a lattice.
template <class Kernel>
Triangle_tree make_triangle_tree(const Distance_mesh& mesh, const Lattice_3<Kernel>& lattice) {
  const CGAL::Cartesian_converter<Side_kernel, Distance_kernel> convert;
  std::vector<Distance_kernel::Triangle_3> triangles;
  triangles.reserve(mesh.number_of_faces());
  CGAL::Bbox_3 box = lattice.bbox();
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    triangles.emplace_back(convert(mesh.point(mesh.source(h))), convert(mesh.point(mesh.target(h))),
                           convert(mesh.point(mesh.target(mesh.next(h)))));
    box += triangles.back().bbox();
  }
  double largest = 0;
  for (int n = 0; n < 3; ++n) largest = std::max({largest, std::abs(box.min(n)), std::abs(box.max(n))});
  const double epsilon = std::max(CGAL::to_double(std::numeric_limits<typename Kernel::FT>::epsilon()),
                                  std::numeric_limits<double>::epsilon());
  // About ten roundings of coordinates and of their differences occur between a node and its distance.
  return Triangle_tree(std::move(triangles), 32 * epsilon * largest);
}

/// Signs the distances of a row of nodes; side(i) returns the side of node i. If the surface separates two neighbors,
/// their distances to it add up to at most the step between them, so only then is the side computed anew. A missing
/// distance is larger than the band.
template <class Iterator, class Side>
void sign_row(Iterator distances, std::size_t count, double step, double band, const Side& side) {
  const double reach = 1.01 * step; // the distances are rounded by less than a hundredth of a step
  double last_distance = 0;
  CGAL::Bounded_side s = CGAL::ON_BOUNDARY;
  for (std::size_t i = 0; i < count; ++i) {
    auto& value = distances[std::ptrdiff_t(i)];
    const double distance = value == value ? CGAL::to_double(value) : band;
    if (s == CGAL::ON_BOUNDARY || distance + last_distance <= reach) s = side(i);
    last_distance = distance;
    if (s == CGAL::ON_BOUNDED_SIDE) value = -value;
    else if (s == CGAL::ON_BOUNDARY) value = 0;
  }
}

/// The signed distances at all nodes of a lattice, in the order of `Volume_3::values`.
template <class ConcurrencyTag, class Kernel, class Progress>
std::vector<typename Kernel::FT> signed_distances(const Distance_mesh& mesh, const Lattice_3<Kernel>& lattice,
                                                  const Progress& on_progress, double band) {
  using FT = typename Kernel::FT;
  const Triangle_tree tree = make_triangle_tree(mesh, lattice);
  Lattice_distances<ConcurrencyTag, Kernel, Progress> measured(tree, lattice, on_progress, band);
  using Side = CGAL::Side_of_triangle_mesh<Distance_mesh, Side_kernel>;
  Side::AABB_tree side_tree(faces(mesh).first, faces(mesh).second, mesh);
  side_tree.build(); // now, because several threads may make the first query
  const Side side(side_tree);
  const std::size_t nx = lattice.size()[0], ny = lattice.size()[1], nz = lattice.size()[2];
  const double step = std::sqrt(CGAL::to_double(lattice.steps()[0].squared_length()));
  parallel_for<ConcurrencyTag>(0, ny * nz, [&](std::size_t row) {
    sign_row(measured.distances().begin() + std::ptrdiff_t(row * nx), nx, step, band, [&](std::size_t i) {
      const auto p = lattice.point(FT(i), FT(row % ny), FT(row / ny));
      return side(Side_kernel::Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
    });
  });
  return std::move(measured.distances());
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the signed distance to a closed triangle mesh at every node of a lattice: negative inside, positive
/// outside, and 0 on the surface. A point is inside if an odd number of the mesh's components encloses it, whatever
/// their orientations, so that a shell within a shell is a cavity.
///
/// Signs are exact for the given coordinates. Distances are correct to a few units in the last place of the
/// coordinates: each is the minimum of the distances that CGAL computes to the triangles. The result does not depend
/// on the number of threads. `on_progress(n)` is called after every n nodes, from any thread. Nodes farther than
/// `band` from the surface have no value (NaN), which saves most of the time if there are many of them; by default
/// every node has a value.
///
/// Neighboring nodes share the search for the nearest triangle. The time is about linear in the number of nodes if
/// the triangles are not much smaller than the steps. The memory is linear in the number of triangles and nodes.
///
/// \throws Input_error if the mesh has no faces, faces other than triangles, coordinates that are not finite or
/// beyond 1e15, holes, self-intersections, or triangles that are degenerate or whose squared area underflows.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel, class Progress>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice,
                                        const Progress& on_progress,
                                        double band = std::numeric_limits<double>::infinity()) {
  internal::Distance_mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  internal::check_bounds_volume(copy);
  return {lattice, internal::signed_distances<ConcurrencyTag>(copy, lattice, on_progress, band)};
}

/// The same without progress reports, and with a value at every node.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice) {
  return signed_distance_volume<ConcurrencyTag>(mesh, lattice, [](std::size_t) {});
}

} // namespace equiaffine

#endif
