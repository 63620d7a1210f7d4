// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_DOUBT_H
#define EQUIAFFINE_BINDINGS_VTK_DOUBT_H

#include "Ranks.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// Treatment of unknown numbers, that is those with large errors: errors are not computed, unknown numbers are counted,
/// or also replaced by NaN.
enum class Doubtful { UNTESTED, COUNTED, HIDDEN };

using Error_rows = std::vector<Estimate_attribute>;

/// The available errors of the selected attributes; `of_splines` excludes those that only fits have.
Error_rows selected_errors(const Attribute_selection& selection, bool of_splines);

/// Counts the vertices at which numbers are known, by the rules of pages and pictures.
class Doubt {
public:
  /// Numbers of these rows have columns of errors, except if UNTESTED.
  Doubt(Error_rows rows, Doubtful doubtful) : rows_(std::move(rows)), doubtful_(doubtful), counts_(2 * rows_.size()) {}

  /// Counts the numbers of a block of vertices, excluding ghosts, and makes unknown ones NaN if HIDDEN.
  void add(Vertex_attributes& block, std::span<const unsigned char> ghosts);

  /// The same assessment of a surface as on pages of the program.
  struct Verdict {
    std::string first_shown;            ///< the quantity to show by default: the first one that is known
    std::vector<std::string> sentences; ///< warnings about quantities that are unknown at most vertices
  };

  /// The verdict on the vertices of all processes, which have scalars with these names and optionally a status.
  Verdict verdict(const Ranks& ranks, const std::vector<std::string>& names, bool has_status) const;

private:
  Error_rows rows_;
  Doubtful doubtful_;
  std::vector<std::int64_t> counts_; // for each row: vertices with a number, and those where it is unknown
};

} // namespace equiaffine

#endif
