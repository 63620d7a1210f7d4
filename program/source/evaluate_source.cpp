// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/evaluate_source.h"

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/engine/vectorized.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>

namespace equiaffine {

namespace {

using Tag = CGAL::Parallel_if_available_tag;

/// Replaces attributes by those of another estimator. Norms of gradients stay.
template <class Traits>
void estimate_again(const Level_set_traits_3<Traits>& level_set, Estimator estimator,
                    std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                    std::span<const Point_status> sampled_status, Vertex_attributes& attributes) {
  const std::size_t most = 64, margin = 0;
  for_each_point_block<Tag>(
      level_set, points, most, margin, [&](const auto& local, std::span<const std::size_t> numbers) {
        for (const std::size_t n : numbers) {
          const Kernel::Point_3& p = points[n];
          const auto structure =
              local_structure<double>(local.taylor(p), {p.x(), p.y(), p.z()}, rounding(local, p), estimator);
          for (std::size_t c = 0; c < selection.columns.size(); ++c) {
            const Attribute& attribute = selection.columns[c];
            if (!attribute_table<double>[attribute.row].gradient)
              attributes.columns[c].values[n] = attribute.get(structure);
          }
          if (attributes.status)
            (*attributes.status)[n] =
                sampled_status.empty() ? structure.status : status_after_sampling(structure.status, sampled_status[n]);
        }
      });
}

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
        Vertex_attributes attributes;
        if constexpr (is_fit<Traits>)
          attributes = compute_attributes<Tag>(level_set, points, selection, sampled_status);
        else attributes = vectorized::compute_attributes(level_set, points, selection, sampled_status);
        if (estimator != Estimator::COMPACT)
          estimate_again(level_set, estimator, points, selection, sampled_status, attributes);
        return attributes;
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
