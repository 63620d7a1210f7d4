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

/// What becomes of numbers whose error is to be known.
enum class Doubtful { UNTESTED, COUNTED, HIDDEN };

using Error_rows = std::vector<Estimate_attribute>;

/// The errors that are estimated of selected attributes; `of_splines` leaves out those that only fits have.
Error_rows selected_errors(const Attribute_selection& selection, bool of_splines);

/// Counts at how many vertices numbers are known, by the rules of pages and pictures.
class Doubt {
public:
  /// Numbers of these rows have columns of errors, unless they are UNTESTED: then nothing is known of them.
  Doubt(Error_rows rows, Doubtful doubtful) : rows_(std::move(rows)), doubtful_(doubtful), counts_(2 * rows_.size()) {}

  /// Counts the numbers of a block of vertices without those marked as ghosts, and makes unknown ones NaN if they are
  /// to be HIDDEN.
  void add(Vertex_attributes& block, std::span<const unsigned char> ghosts);

  /// What the pages of the program would say of a surface.
  struct Verdict {
    std::string first_shown;            ///< the quantity that is known first
    std::vector<std::string> sentences; ///< on what is unknown at most vertices
  };

  /// The verdict on the vertices of all processes, of which it has scalars with those names, and a status.
  Verdict verdict(const Ranks& ranks, const std::vector<std::string>& names, bool has_status) const;

private:
  Error_rows rows_;
  Doubtful doubtful_;
  std::vector<std::int64_t> counts_; // of each row: vertices with a number, and those where it is unknown
};

} // namespace equiaffine

#endif
