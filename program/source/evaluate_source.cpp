// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/evaluate_source.h"

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/engine/vectorized.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/tags.h>

#include <type_traits>
#include <variant>

namespace equiaffine {

namespace {

using Tag = CGAL::Parallel_if_available_tag;

} // namespace

Isosurface_3<Kernel> isosurface_of_source(const Source_function& function, double isovalue,
                                          const std::array<std::size_t, 3>& nodes, Vertex_position vertices) {
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        const Level_set_traits_3<Traits> level_set(f, isovalue);
        if constexpr (is_fit<Traits>)
          return marching_cubes<Tag>(level_set,
                                     parameters::vertex_position(vertices).number_of_nodes(nodes).skip_empty_space());
        else if constexpr (std::is_same_v<Traits, Spline_function>)
          return vectorized::marching_cubes(level_set, vertices);
        else return vectorized::marching_cubes(level_set, nodes, vertices);
      },
      function);
}

Vertex_attributes attributes_of_source(const Source_function& function, Orientation_of_level_set orientation,
                                       std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                       Estimator estimator, std::span<const Point_status> sampled_status) {
  const double isovalue = 0; // attributes do not depend on it
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        const Level_set_traits_3<Traits> level_set(f, isovalue, orientation);
        if constexpr (is_fit<Traits>)
          return compute_attributes<Tag>(level_set, points, selection, sampled_status,
                                         parameters::estimator(estimator));
        else return vectorized::compute_attributes(level_set, points, selection, sampled_status, estimator);
      },
      function);
}

double max_distance_to_source(const Source_function& function, double isovalue, Orientation_of_level_set orientation,
                              std::span<const Kernel::Point_3> points, std::span<const Point_status> status) {
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        const Level_set_traits_3<Traits> level_set(f, isovalue, orientation);
        if constexpr (is_fit<Traits>) return max_distance_to_surface<Tag>(level_set, points, status);
        else return vectorized::max_distance_to_surface(level_set, points, status);
      },
      function);
}

} // namespace equiaffine
