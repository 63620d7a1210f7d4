// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATES_H
#define EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATES_H

#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// What an estimate is of: the error; what noise makes; or what detail makes that a scale leaves out.
enum class Estimate_kind { ERROR, NOISE, DETAIL };

/// A column with estimates.
struct Estimate_attribute {
  std::string name;
  Estimate_kind kind;
  const Error_row<double>* row;
  bool is_of_splines; ///< whether splines have it, too, and not fits alone
};

/// All of them, in the order of the columns of a file.
inline const std::vector<Estimate_attribute>& estimate_attributes() {
  static const std::vector<Estimate_attribute> attributes = [] {
    constexpr std::size_t of_splines = 2; // the affine curvatures, of which there are all kinds
    std::vector<Estimate_attribute> result;
    const auto add = [&](Estimate_kind kind, const std::string& suffix, std::size_t count) {
      for (std::size_t n = 0; n < count; ++n) {
        const auto& row = error_table<double>[n];
        result.push_back(
            {std::string(row.attribute) + suffix, kind, &row, kind == Estimate_kind::ERROR && n < of_splines});
      }
    };
    add(Estimate_kind::ERROR, "_error", error_table<double>.size());
    add(Estimate_kind::NOISE, "_noise", of_splines);
    add(Estimate_kind::DETAIL, "_detail", of_splines);
    return result;
  }();
  return attributes;
}

/// The names of the columns with estimates of errors.
inline std::vector<std::string> error_attributes() {
  std::vector<std::string> names;
  for (const auto& attribute : estimate_attributes())
    if (attribute.kind == Estimate_kind::ERROR) names.push_back(attribute.name);
  return names;
}

struct Source;
struct Source_options;

/// What is known of the errors of attributes at points.
struct Estimates {
  std::vector<Vertex_attributes::Column> columns;
  std::optional<Fit_statistics> fit; ///< is set for a fit
};

/// The estimates at points of level sets of the source, if it has them; to make them is a stage of its own.
Estimates estimates_at(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Progress& progress);

Estimates estimates_of(std::span<const Fitted_structure_3<double>> structures);

/// Adds those columns of the estimates that `names` has and `attributes` has not.
void add_estimates(const Estimates& estimates, std::span<const std::string> names, Vertex_attributes& attributes);

/// Adds the columns with errors that are missing, if the estimates have them: pages and pictures show what can be
/// trusted, even if the mesh does not get the estimates.
void add_errors(const Estimates& estimates, Vertex_attributes& attributes);

/// The selected attributes of the structures.
Vertex_attributes attributes_of(std::span<const Fitted_structure_3<double>> structures,
                                const Attribute_selection& selection);

} // namespace equiaffine

#endif
