// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ANNOTATE_ELEMENTS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ANNOTATE_ELEMENTS_H

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/attributes/internal/Property_maps.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/points_of_range.h>

#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Mesh>
inline constexpr bool is_surface_mesh = false;
template <class Point>
inline constexpr bool is_surface_mesh<CGAL::Surface_mesh<Point>> = true;

/// The structure of the level set at a point of any kernel.
template <class Traits, class Point, class Parameters>
auto structure_at(const Traits& traits, const Point& p, Point_status before,
                  [[maybe_unused]] const Parameters& parameters) {
  check_coordinates<Point>();
  const auto q = convert_point<Kernel_of<Traits>>(p);
  if constexpr (has_parameter<Estimator_tag, Parameters>)
    return local_structure_at(traits, q, before, parameters::estimator(given_parameter<Estimator_tag>(parameters)));
  else return local_structure_at(traits, q, before);
}

/// Fills the maps that are given, for elements with points: vertices of a mesh, or elements of a range. Structures are
/// computed in parallel. Maps are read and written one after the other, since to read boost::associative_property_map may
/// change it.
template <class ConcurrencyTag, class Elements, class Point_of, class Traits, class Parameters>
void annotate_elements(Elements&& elements, const Point_of& point_of, const Traits& traits,
                       const Parameters& parameters) {
  static_assert(has_maps<Parameters>(Structure_tags()),
                "annotate() has nothing to write to: give it property maps, such as "
                "parameters::vertex_affine_mean_curvature_map(map), or a CGAL::Surface_mesh that is not const");
  constexpr std::size_t most_at_once = 1 << 16;
  using std::begin, std::end; // or the functions of the range
  auto next = begin(elements);
  const auto last = end(elements);
  std::vector<std::decay_t<decltype(next)>> places;
  std::vector<std::decay_t<decltype(point_of(*next))>> points;
  std::vector<Point_status> before;
  std::vector<Local_structure_3<typename Traits::FT>> structures;
  while (next != last) {
    places.clear();
    points.clear();
    before.clear();
    for (; next != last && places.size() < most_at_once; ++next) {
      places.push_back(next);
      points.push_back(point_of(*next));
      before.push_back(status_before(parameters, *next));
    }
    structures.resize(places.size());
    parallel_for<ConcurrencyTag>(
        0, places.size(),
        [&](std::size_t i) { structures[i] = structure_at(traits, points[i], before[i], parameters); }, 256);
    for (std::size_t i = 0; i < places.size(); ++i) {
      auto&& element = *places[i];
      put_structure(parameters, element, structures[i], Structure_tags());
    }
  }
}

/// Fills the maps `v:NAME` of a surface mesh with all that is known of its vertices.
template <class ConcurrencyTag, class Mesh, class Point_of, class Traits, class Parameters>
void annotate_surface_mesh(Mesh& mesh, const Point_of& point_of, const Traits& traits, const Parameters& parameters) {
  using Vertex_index = typename Mesh::Vertex_index;
  check_mesh_for_maps<Mesh>();
  Property_maps<Mesh> maps(mesh);
  parallel_for<ConcurrencyTag>(
      0, mesh.num_vertices(), // with removed ones
      [&](std::size_t i) {
        const Vertex_index v{static_cast<typename Vertex_index::size_type>(i)};
        if (!mesh.is_removed(v)) maps.set(v, structure_at(traits, point_of(v), maps.status(v), parameters));
      },
      256);
}

} // namespace equiaffine::internal

#endif
