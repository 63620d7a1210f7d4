// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_CHECK_BOUNDS_VOLUME_H
#define EQUIAFFINE_VOLUME_INTERNAL_CHECK_BOUNDS_VOLUME_H

#include <equiaffine/base/Input_error.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The kernel that decides on which side of the mesh a point lies: its predicates are exact.
using Side_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Distance_mesh = CGAL::Surface_mesh<Side_kernel::Point_3>;

/// A point as text for messages.
inline std::string place(const Side_kernel::Point_3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

/// Throws Input_error if a coordinate is not finite, or so large that 1 added to it vanishes by rounding: CGAL decides on
/// which side a point is by rays, through a second point one unit away.
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

/// Throws Input_error if the area of a triangle is so small that its square is no normal number: distances are measured
/// along normal vectors, whose squared lengths would lose their digits or vanish.
inline void check_areas(const Distance_mesh& mesh) {
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    if (CGAL::cross_product(q - p, r - p).squared_length() < std::numeric_limits<double>::min())
      throw Input_error("the mesh has a triangle too small to measure from, near " + place(p) +
                        ", the square of its area leaves the range of double precision: choose a smaller unit, or "
                        "remove the triangle if the others are larger");
  }
}

/// Throws Input_error unless the mesh bounds a volume: its faces are triangles, it has no border, and triangles touch
/// at common edges and vertices only and are not too small.
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
    throw Input_error("the mesh has degenerate triangles or intersects itself, near " +
                      place(mesh.point(mesh.target(mesh.halfedge(contacts.front().first)))) +
                      ", so that its inside is not defined: repair it first");
  check_areas(mesh);
}

} // namespace equiaffine::internal

#endif
