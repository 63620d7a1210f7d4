// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_POINT_STATUS_H
#define EQUIAFFINE_GEOMETRY_POINT_STATUS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace equiaffine {

/// Which parts of the local structure exist at a point of a level set. Files store the numeric values as the attribute
/// `status`.
enum class Point_status : std::uint8_t {
  REGULAR,    ///< every quantity exists
  PARABOLIC,  ///< the affine metric is degenerate (d = 0): only the Euclidean quantities exist
  SINGULAR,   ///< the gradient vanishes, f is not four times differentiable, or numbers overflow: nothing exists
  OUTSIDE,    ///< outside the domain of f, of the support of its spline, or of the chosen `Estimator`: nothing exists
  UNCONVERGED ///< the point could not be moved onto the surface: quantities are those of the level set through it
};

inline constexpr std::size_t number_of_point_statuses = 5; ///< the number of values of the enumeration

/// Combines the status `structure` of the structure at a point with the status `sampled` from a sampler: an UNCONVERGED
/// point remains UNCONVERGED, unless it is OUTSIDE.
constexpr Point_status status_after_sampling(Point_status structure, Point_status sampled) {
  const bool stays_unconverged = sampled == Point_status::UNCONVERGED && structure != Point_status::OUTSIDE;
  return stays_unconverged ? Point_status::UNCONVERGED : structure;
}

/// The name of a status in text files and statistics.
constexpr std::string_view to_string(Point_status status) {
  constexpr std::array<std::string_view, number_of_point_statuses> words = {"regular", "parabolic", "singular",
                                                                            "outside", "unconverged"};
  return words[static_cast<std::size_t>(status)];
}

} // namespace equiaffine

#endif
