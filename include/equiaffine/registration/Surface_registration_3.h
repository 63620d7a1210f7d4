// SPDX-License-Identifier: GPL-3.0-or-later
// The result of register_surfaces(): maps from one surface to another, with what speaks for each.
#ifndef EQUIAFFINE_REGISTRATION_SURFACE_REGISTRATION_3_H
#define EQUIAFFINE_REGISTRATION_SURFACE_REGISTRATION_3_H

#include <equiaffine/registration/Affine_slippage_3.h>

#include <CGAL/Aff_transformation_3.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// A point of the source and one of the target whose frames gave a map, which carries one frame to the other.
template <class Kernel>
struct Pair_of_frames_3 {
  std::array<typename Kernel::Point_3, 2> points;                 ///< of the source, and of the target
  std::array<std::array<typename Kernel::Vector_3, 3>, 2> frames; ///< two tangent vectors and a transversal one each
};

/// A map that moves the source, or a part of it, onto the target, and what there is to trust it.
template <class Kernel>
struct Registered_map_3 {
  typename Kernel::Aff_transformation_3 map; ///< from the source to the target
  /// The logarithm of the number of maps as good as this one that chance would make of all that were tried.
  double log10_false_alarms;
  /// The parts of the points of the source, and of the target, that lie on the other surface.
  std::array<double, 2> inliers;
  double rms; ///< the root of the mean squared distance of these points, in the unit of the target
  /// None if the map is one of a continuous family, or of whole surfaces or pieces that were matched without curvature.
  std::optional<Pair_of_frames_3<Kernel>> pair;
  /// The parts of the points of the source, and of the target, that lie off the other surface although that does not
  /// end there, for maps between meshes: they speak against the map, or tell where the surfaces differ.
  std::optional<std::array<double, 2>> contradictions = {};
};

/// The result of `register_surfaces`.
template <class Kernel>
struct Surface_registration_3 {
  std::vector<Registered_map_3<Kernel>> maps; ///< the best first; empty if there is no evidence for any
  std::size_t hypotheses = 0;                 ///< the number of maps that were tried
  double size = 0;                            ///< of the target: the rms distance of its points from their centroid
  std::size_t equally_good = 0;               ///< how many other maps, at least, fit as well as the first of `maps`
  std::optional<double> next_best_rms;        ///< of the best map that is not the first one of `maps`, if there was one
  /// How the source slides over itself by maps of the kind. If the dimension is not 0, each of `maps` represents a
  /// continuous family.
  Affine_slippage_3 slippage;
  std::string reason = {}; ///< why the maps between meshes that were tried are not accepted, if that is known

  bool found() const { return !maps.empty(); }                          ///< whether there is a map
  const Registered_map_3<Kernel>& best() const { return maps.front(); } ///< \pre found()
};

} // namespace equiaffine

#endif
