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
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

namespace {

using Tag = CGAL::Parallel_if_available_tag;

/// The attributes that are norms of gradients; they do not depend on the estimator.
Attribute_selection gradients_of(const Attribute_selection& selection) {
  Attribute_selection gradients = {{}, false};
  for (const Attribute& attribute : selection.columns)
    if (attribute_table<double>[attribute.row].gradient) gradients.columns.push_back(attribute);
  return gradients;
}

/// Computes attributes by one of the paper's estimators. Norms of gradients are taken from `gradients`.
template <class Traits>
Vertex_attributes estimated_attributes(const Level_set_traits_3<Traits>& level_set, Estimator estimator,
                                       std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                       const Sampled_vertices& sampled, Vertex_attributes gradients) {
  Vertex_attributes attributes;
  auto next_gradient = gradients.columns.begin();
  std::vector<std::size_t> estimated;
  for (std::size_t c = 0; c < selection.columns.size(); ++c) {
    const Attribute& attribute = selection.columns[c];
    if (attribute_table<double>[attribute.row].gradient) {
      attributes.columns.push_back(std::move(*next_gradient++));
    } else {
      attributes.columns.push_back({std::string(attribute.name), std::vector<double>(points.size())});
      estimated.push_back(c);
    }
  }
  if (selection.has_status) attributes.status.emplace(points.size());
  if (estimated.empty() && !selection.has_status) return attributes;
  const std::size_t most = 64, margin = 0;
  for_each_point_block<Tag>(
      level_set, points, most, margin, [&](const auto& local, std::span<const std::size_t> numbers) {
        for (const std::size_t n : numbers) {
          const Kernel::Point_3& p = points[n];
          const auto structure =
              local_structure<double>(local.taylor(p), {p.x(), p.y(), p.z()}, rounding(local, p), estimator);
          Attribute_sample<double> sample(structure);
          if (!sampled.areas.empty()) sample.vertex_area = sampled.areas[n];
          for (const std::size_t c : estimated) attributes.columns[c].values[n] = selection.columns[c].get(sample);
          if (attributes.status)
            (*attributes.status)[n] =
                sampled.status.empty() ? structure.status : status_after_sampling(structure.status, sampled.status[n]);
        }
      });
  return attributes;
}

} // namespace

Isosurface_3<Kernel> isosurface_of_source(const Source_function& function, double isovalue,
                                          const Marching_cubes_options& options) {
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        const Level_set_traits_3<Traits> level_set(f, isovalue);
        if constexpr (is_fit<Traits>) return marching_cubes<Tag>(level_set, options);
        else return vectorized::marching_cubes(level_set, options);
      },
      function);
}

Vertex_attributes attributes_of_source(const Source_function& function, Orientation_of_level_set orientation,
                                       std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                       Estimator estimator, const Sampled_vertices& sampled) {
  const double isovalue = 0; // irrelevant for attributes
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        const Level_set_traits_3<Traits> level_set(f, isovalue, orientation);
        const auto compute = [&](const Attribute_selection& attributes) {
          if constexpr (is_fit<Traits>) return compute_attributes<Tag>(level_set, points, attributes, sampled);
          else return vectorized::compute_attributes(level_set, points, attributes, sampled);
        };
        if (estimator == Estimator::COMPACT) return compute(selection);
        return estimated_attributes(level_set, estimator, points, selection, sampled, compute(gradients_of(selection)));
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
