// SPDX-License-Identifier: GPL-3.0-or-later
// The result of affine_symmetries(): groups of maps that move a surface onto itself, and its slippage.
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_3_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_3_H

#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/Map_kind.h>

#include <CGAL/Aff_transformation_3.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// A map that moves a surface onto itself.
template <class Kernel>
struct Affine_symmetry_3 {
  typename Kernel::Aff_transformation_3 map; ///< the map
  double rms;                                ///< the root of the mean squared distance of moved points from the surface
  double greatest;                           ///< the largest of these distances
};

/// A finite group of maps, each of which moves a surface onto itself to within an rms distance. All products are in the
/// group, and each map was verified, the other way round, too.
template <class Kernel>
struct Symmetry_level_3 {
  std::vector<Affine_symmetry_3<Kernel>> maps; ///< the identity first
  double rms;                                  ///< the largest of the maps, a part of the size of the surface
  double greatest;                             ///< the largest distance of any moved point, a part of the size

  std::size_t order() const { return maps.size(); } ///< the number of its maps
};

/// A verdict says what is known of the symmetries of a surface.
enum class Symmetry_verdict {
  /// The first level, or else the continuous group, holds to rounding at every point that was tried.
  EXACT,
  /// The first level, or else the continuous group, holds to within its rms: 1 % of the size at most, for affine maps in
  /// coordinates in which the solid is round.
  APPROXIMATE,
  /// No map but the identity holds to within 1 % of the size, as above, or to the tolerance for a function.
  NONE,
  /// None of these was verified, for the reason given.
  UNDECIDED
};

/// The result of `affine_symmetries`.
template <class Kernel>
struct Affine_symmetries_3 {
  Symmetry_verdict verdict = Symmetry_verdict::UNDECIDED; ///< what is known
  std::string reason = {};                                ///< why nothing more is known, if the verdict is UNDECIDED
  /// Groups, each larger than the one before and with a larger rms: a cube without a corner has 6 symmetries, and 48
  /// to within 3 % of its size.
  std::vector<Symmetry_level_3<Kernel>> levels = {};
  /// The symmetries to within the tolerance: those of the last level whose rms is not above it, and without a tolerance
  /// those of the first level. The identity alone, if there are no others, infinitely many, or they are not known.
  std::vector<Affine_symmetry_3<Kernel>> maps = {};
  Affine_slippage_3 continuous = {}; ///< the Lie algebra of the continuous group
  bool is_decided = false;           ///< whether `maps` are all symmetries to within the tolerance
  Map_kind kind = Map_kind::AFFINE;  ///< of the maps: RIGID for affine maps of a mesh that bounds no solid
  /// All rotations and reflections about the centroid were tried that move the surface onto itself to within this rms
  /// distance, a part of its size. None if they were not searched, for example because exact frames decide.
  std::optional<double> complete_to = {};
  /// The distance between the points by which maps of a function were verified, a part of the size: a narrower detail
  /// may lie between them. None for meshes, each of whose facets has a point.
  std::optional<double> spacing = {};
  /// If the surface goes on beyond the box of its function: the number of `maps` that move its piece in the box onto
  /// itself. Others, if any, were verified where the images of points are in the box.
  std::optional<std::size_t> order_in_box = {};

  /// The number of symmetries, the identity and reflections counted. None if there are infinitely many, or if it is not
  /// known. A mesh that turns to within the error of its facets, and has a finite group to rounding, has the order of
  /// that group.
  std::optional<std::size_t> order() const {
    if (!is_decided || (continuous.dimension() > 0 && levels.empty())) return std::nullopt;
    return maps.size();
  }
};

} // namespace equiaffine

#endif
