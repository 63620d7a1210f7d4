// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_MAP_KIND_H
#define EQUIAFFINE_REGISTRATION_MAP_KIND_H

namespace equiaffine {

/// The maps of space among which one is sought that moves a surface onto another.
enum class Map_kind {
  AFFINE,     ///< p -> A p + t with an invertible matrix A: 12 numbers
  EQUIAFFINE, ///< those with |det A| = 1: 11 numbers
  SIMILARITY, ///< those where A is a multiple of an orthogonal matrix: 7 numbers
  RIGID       ///< those where A is orthogonal: 6 numbers
};

/// Whether maps of the kind keep volumes, up to their sign.
constexpr bool keeps_volume(Map_kind kind) { return kind == Map_kind::EQUIAFFINE || kind == Map_kind::RIGID; }
/// Whether maps of the kind keep angles.
constexpr bool keeps_angles(Map_kind kind) { return kind == Map_kind::SIMILARITY || kind == Map_kind::RIGID; }

} // namespace equiaffine

#endif
