// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H
#define EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/parallel_for.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

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

namespace equiaffine {

namespace internal {

/// Signs are exact; distances are constructions, rounded in either kernel and faster in this one.
using Side_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Distance_kernel = CGAL::Simple_cartesian<double>;
using Distance_mesh = CGAL::Surface_mesh<Side_kernel::Point_3>;

#if CGAL_VERSION_NR >= 1060000000
template <class Kernel, class Iterator>
using Triangle_tree_traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Iterator>>;
#else
template <class Kernel, class Iterator>
using Triangle_tree_traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>;
#endif

inline std::string place(const Side_kernel::Point_3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

/// Throws Input_error unless the mesh bounds a solid: triangles, no border, no contact between triangles other than
/// at common edges and vertices.
inline void check_bounds_solid(const Distance_mesh& mesh) {
  if (mesh.number_of_faces() == 0) throw Input_error("the mesh has no faces: give a closed mesh of triangles");
  for (const auto v : mesh.vertices())
    if (const auto& p = mesh.point(v); !std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      throw Input_error("the mesh has a vertex with a coordinate that is not a finite number, " + place(p) +
                        ": correct or remove it");
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
    throw Input_error("the mesh has degenerate triangles or intersects itself, near " +
                      place(mesh.point(mesh.target(mesh.halfedge(contacts.front().first)))) +
                      ", so that its inside is not defined: repair it first");
}

/// Signed distances at the nodes of rows of a lattice. A nearest point found at one node bounds the search at the
/// next. If the surface separates two neighbours, their distances to it add up to at most the step between them: only
/// then is the side determined anew.
class Signed_distance_sampler {
public:
  explicit Signed_distance_sampler(const Distance_mesh& mesh)
      : triangles_(copy_triangles(mesh)), distance_tree_(triangles_.begin(), triangles_.end()),
        side_tree_(faces(mesh).first, faces(mesh).second, mesh), side_((side_tree_.build(), side_tree_)) {
    distance_tree_.build(); // here, by one thread, and not at the first query
    distance_tree_.accelerate_distance_queries();
  }

  /// Calls `store(i, distance)` for the nodes point(0) .. point(count - 1), {x, y, z} each, which lie `step` apart; for
  /// those farther than `band` from the surface the distance is NaN. Where it is larger by n steps, the next n nodes
  /// are not looked at, and between them the side does not change.
  template <class Node, class Store>
  void sample_row(std::size_t count, double step, double band, const Node& point, const Store& store) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double reach = 1.01 * step; // beyond any rounding of the distance
    Distance_kernel::Point_3 nearest;
    double last_distance = 0;
    CGAL::Bounded_side side = CGAL::ON_BOUNDARY;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [x, y, z] = point(i);
      const Distance_kernel::Point_3 p(x, y, z);
      nearest = i == 0 ? distance_tree_.closest_point(p) : distance_tree_.closest_point(p, nearest);
      const double distance = std::sqrt(CGAL::squared_distance(p, nearest));
      if (side == CGAL::ON_BOUNDARY || distance + last_distance <= reach) side = side_(Side_kernel::Point_3(x, y, z));
      last_distance = distance;
      if (distance > band) {
        const double skipped = std::min((distance - band) / reach, double(count - 1 - i));
        for (const std::size_t last = i + std::size_t(skipped); i < last; ++i) store(i, nan);
        last_distance -= skipped * step;
        store(i, nan);
      } else store(i, side == CGAL::ON_BOUNDARY ? 0 : side == CGAL::ON_BOUNDED_SIDE ? -distance : distance);
    }
  }

private:
  using Triangles = std::vector<Distance_kernel::Triangle_3>;
  using Distance_tree = CGAL::AABB_tree<Triangle_tree_traits<Distance_kernel, Triangles::const_iterator>>;
  using Side = CGAL::Side_of_triangle_mesh<Distance_mesh, Side_kernel>;

  static Triangles copy_triangles(const Distance_mesh& mesh) {
    const CGAL::Cartesian_converter<Side_kernel, Distance_kernel> convert;
    Triangles triangles;
    triangles.reserve(mesh.number_of_faces());
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      triangles.emplace_back(convert(mesh.point(mesh.source(h))), convert(mesh.point(mesh.target(h))),
                             convert(mesh.point(mesh.target(mesh.next(h)))));
    }
    return triangles;
  }

  Triangles triangles_;
  Distance_tree distance_tree_;
  Side::AABB_tree side_tree_;
  Side side_;
};

} // namespace internal

/// The distance to a closed triangle mesh at every node of a lattice: negative inside, positive outside, 0 on the
/// surface. Inside is what an odd number of its surfaces encloses, whatever their orientations, so that a shell within
/// a shell is a cavity.
///
/// Signs are exact for the given coordinates, distances correct to a few units in the last place of the coordinates.
/// The result does not depend on the number of threads. `on_progress(n)` is called after every n nodes, from any
/// thread. Nodes farther than `band` from the surface have no value (NaN), which saves most of the time if they are
/// many; by default there are none.
///
/// \throws Input_error if the mesh has no faces, faces other than triangles, coordinates that are not finite, holes,
/// degenerate triangles or self-intersections.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel, class Progress>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice,
                                        const Progress& on_progress,
                                        double band = std::numeric_limits<double>::infinity()) {
  internal::Distance_mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  internal::check_bounds_solid(copy);
  const internal::Signed_distance_sampler sampler(copy);

  using FT = typename Kernel::FT;
  const auto [nx, ny, nz] = lattice.size();
  const double step = std::sqrt(CGAL::to_double(lattice.steps()[0].squared_length()));
  Volume_3<Kernel> volume{lattice, std::vector<FT>(lattice.number_of_nodes())};
  internal::parallel_for<ConcurrencyTag>(0, ny * nz, [&, nx = nx, ny = ny](std::size_t row) {
    const std::size_t j = row % ny, k = row / ny;
    const auto node = [&](std::size_t i) {
      const auto p = lattice.point(FT(i), FT(j), FT(k));
      return std::array<double, 3>{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    };
    sampler.sample_row(nx, step, band, node, [&](std::size_t i, double d) { volume.values[row * nx + i] = FT(d); });
    on_progress(nx);
  });
  return volume;
}

template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice) {
  return signed_distance_volume<ConcurrencyTag>(mesh, lattice, [](std::size_t) {});
}

} // namespace equiaffine

#endif
