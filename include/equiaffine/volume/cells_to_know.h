// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_CELLS_TO_KNOW_H
#define EQUIAFFINE_VOLUME_CELLS_TO_KNOW_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/internal/Line_part.h>
#include <equiaffine/volume/internal/Spline_coefficients.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/local_polynomial.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace equiaffine {

/// The cells at whose nodes samples must be known so that a spline through them has its values in all cells of a block.
/// `nodes` are the numbers of nodes of the lattice. Beside the border of the lattice these are more than elsewhere, since
/// there the samples are extended. \throw std::invalid_argument unless the degree is 5, 7 or 9, and for interpolation,
/// which needs all samples
inline Cell_block cells_to_know(const Cell_block& cells, const std::array<std::size_t, 3>& nodes,
                                const Spline_parameters& parameters) {
  check_argument(parameters.scheme != Spline_scheme::INTERPOLATION,
                 "spline interpolation needs all samples of a volume: choose quasi-interpolation");
  const internal::Spline_fit fit = {internal::checked_degree(parameters.degree), parameters.scheme,
                                    internal::greater_border_degree(parameters.degree)};
  Cell_block known = cells;
  fit.with_filter<double>([&](const auto& line) {
    if constexpr (requires { line.samples_of({}, 0); })
      for (std::size_t a = 0; a < 3; ++a) {
        if (nodes[a] <= std::size_t(parameters.degree)) continue; // there is no spline
        internal::Line_part used =
            line.samples_of({cells.first[a], cells.end[a] + std::size_t(parameters.degree)}, nodes[a]);
        // The votes on the border degree look at so many samples at an end of a line.
        const auto voting = std::min(nodes[a], std::size_t(fit.border_degree) + 2);
        if (cells.first[a] == 0) used.end = std::max(used.end, voting);
        if (cells.end[a] + 1 == nodes[a]) used.first = std::min(used.first, nodes[a] - voting);
        if (parameters.smoothing > 1)
          used = internal::Smoothing_filter<double>(parameters.smoothing, nodes[a], fit.border_degree).samples_of(used);
        known.first[a] = std::min(known.first[a], used.first);
        known.end[a] = std::max(known.end[a], used.end - 1);
      }
  });
  return known;
}

} // namespace equiaffine

#endif
