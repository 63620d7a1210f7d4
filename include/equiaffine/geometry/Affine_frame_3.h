// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_FRAME_3_H
#define EQUIAFFINE_GEOMETRY_AFFINE_FRAME_3_H

#include <equiaffine/number/select.h>

#include <array>

namespace equiaffine {

/// The basis of space that the affine structure singles out at a generic point of a surface, of determinant 1 or -1. An
/// affine map p -> A p + t with a = |det A|, reflections included, carries it to the one at the image:
///
///     e1' = a^(-1/4) A e1,  e2' = a^(-1/4) A e2,  xi' = a^(-1/2) A xi,  scale' = a^(-1/2) scale,
///
/// and the signature stays. So one pair of corresponding points determines the map. See doc/conventions.md for the
/// definition. Units: e1 and e2 length^(1/4), xi length^(-1/2), scale length^(-3/2).
template <class FT>
struct Affine_frame_3 {
  std::array<FT, 3> e1, ///< a tangent vector: an eigenvector of B (elliptic points), an asymptotic one (hyperbolic)
      e2;               ///< the other one
  std::array<FT, 3> xi; ///< the affine normal, or the opposite vector: J >= 0 for this orientation
  FT scale;             ///< r = sqrt(H^2 + J^2 + |D|) with D = H^2 - K
  /// H / r, J / r >= 0, sign(D) sqrt|D| / r and Theta / (|D| r^2): all invariants of order 4.
  std::array<FT, 4> signature;
  /// How well the structure determines the frame: 0 where it does not, 1 at most or not much more.
  FT quality;
  Mask_of<FT> is_elliptic; ///< the kind of the point: K_e > 0, or else K_e < 0
};

} // namespace equiaffine

#endif
