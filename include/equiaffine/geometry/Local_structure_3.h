// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H

#include <equiaffine/geometry/Regular_structure_3.h>
#include <equiaffine/geometry/internal/structure_of_jet.h>
#include <equiaffine/number/Jet_3.h>

#include <array>
#include <optional>
#include <type_traits>

namespace equiaffine {

/// Computes the local structure of the level set of f through a point, or through the points of a pack, from the jet of
/// f there. A gradient counts as zero if one rounding of the coordinates of `point` could have made it. K_e counts as
/// zero if errors of second derivatives of up to `rounding` could have made it; without a `rounding` this is not
/// checked. Takes about 500 floating-point operations per number or pack.
template <class FT>
Regular_structure_3<FT> regular_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                          const std::optional<std::type_identity_t<FT>>& rounding = {}) {
  return internal::regular_structure_of<FT>(jet, point, rounding);
}

/// Computes the status of a point that regular_structure() does not call regular, and the numbers that exist there.
/// `is_steep` is the one that regular_structure() returned. Takes about 1000 floating-point operations.
template <class FT>
Local_structure_3<FT> irregular_structure(const Jet_3<FT>& jet, bool is_steep, const FT& rounding = FT(0)) {
  return internal::irregular_structure_of(jet, is_steep, internal::positive(rounding));
}

/// Computes the Euclidean and affine local structure of the level set of f through a point from the jet of f there. The
/// point need not satisfy f = 0. A gradient counts as zero if one rounding of the coordinates of `point` could have
/// made it. K_e counts as zero if errors of second derivatives of up to `rounding` could have made it; for 0 this is
/// not checked. Takes about 500 floating-point operations, and three times as many if the point is not regular.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point = {FT(0), FT(0), FT(0)},
                                      const FT& rounding = FT(0)) {
  const Regular_structure_3<FT> regular = regular_structure(jet, point, internal::positive(rounding));
  return regular.is_regular ? regular.structure : irregular_structure(jet, regular.is_steep, rounding);
}

} // namespace equiaffine

#endif
