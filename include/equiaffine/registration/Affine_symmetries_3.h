// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_3_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_3_H

#include <equiaffine/registration/Affine_slippage_3.h>

#include <CGAL/Aff_transformation_3.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace equiaffine {

/// A map that moves a surface onto itself.
template <class Kernel>
struct Affine_symmetry_3 {
  typename Kernel::Aff_transformation_3 map;
  double rms; ///< the root of the mean squared distance of moved points from the surface
};

/// The result of `affine_symmetries`.
template <class Kernel>
struct Affine_symmetries_3 {
  /// The identity first. A group, if there are finitely many; else the identity alone.
  std::vector<Affine_symmetry_3<Kernel>> maps;
  Affine_slippage_3 continuous; ///< the Lie algebra of the group

  /// The number of symmetries, the identity and reflections counted. None if there are infinitely many.
  std::optional<std::size_t> order() const {
    if (continuous.dimension() > 0) return std::nullopt;
    return maps.size();
  }
};

} // namespace equiaffine

#endif
