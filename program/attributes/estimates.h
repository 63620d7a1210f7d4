// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated errors of attributes at points of a source, and their columns.
#ifndef EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATES_H
#define EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATES_H

#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// The names of the columns with estimates of errors.
inline std::vector<std::string> error_attributes() {
  std::vector<std::string> names;
  for (const auto& attribute : estimate_attributes())
    if (attribute.kind == Estimate_kind::ERROR) names.push_back(attribute.name);
  return names;
}

struct Source;
struct Source_options;

/// Estimated errors of attributes at points.
struct Estimates {
  std::vector<Vertex_attributes::Column> columns;
  std::optional<Fit_statistics> fit; ///< for a fit
};

/// The estimates at points of level sets of the source, if it has them. Begins a stage of `progress`.
Estimates estimates_at(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Progress& progress);

Estimates estimates_of(std::span<const Fitted_structure_3<double>> structures);

/// Adds the columns of the estimates in `names` that `attributes` lacks.
void add_estimates(const Estimates& estimates, std::span<const std::string> names, Vertex_attributes& attributes);

/// Adds missing columns of errors: pages and pictures show uncertainty even if the output does not get the estimates.
void add_errors(const Estimates& estimates, Vertex_attributes& attributes);

} // namespace equiaffine

#endif
