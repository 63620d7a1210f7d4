// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/evaluate_points.h"

#include "attributes/estimates.h"
#include "engine/Engine.h"

#include <cmath>
#include <limits>
#include <variant>

namespace equiaffine {

namespace {

/// Makes points with infinite or NaN coordinates OUTSIDE, whatever the function returns for them.
void mark_points_at_infinity(std::span<const Kernel::Point_3> points, Vertex_attributes& attributes) {
  if (!attributes.status) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Kernel::Point_3& p = points[i];
    if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) continue;
    (*attributes.status)[i] = Point_status::OUTSIDE;
    for (auto& column : attributes.columns) column.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace

Vertex_attributes evaluate_points(const Evaluate_options& options, const Source& source,
                                  std::span<const Kernel::Point_3> points, Progress& progress) {
  progress.begin("computing attributes");
  Vertex_attributes attributes = std::visit(
      [&]<class Traits>(const Traits& function) {
        return engine<Traits>().compute_attributes(
            {function, options.orientation, points, options.attributes, options.estimator});
      },
      source.function);
  if (options.source.estimates_errors)
    add_estimates(estimates_at(source, options.source, points, progress), options.estimates, attributes);
  mark_points_at_infinity(points, attributes);
  return attributes;
}

} // namespace equiaffine
