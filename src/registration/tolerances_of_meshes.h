// SPDX-License-Identifier: GPL-3.0-or-later
// Tells how far equal meshes may be from each other, beside their size, where no tolerance is given.
#ifndef EQUIAFFINE_SRC_REGISTRATION_TOLERANCES_OF_MESHES_H
#define EQUIAFFINE_SRC_REGISTRATION_TOLERANCES_OF_MESHES_H

#include "registration/Centered_map.h"
#include <equiaffine/registration/internal/requests.h>

#include <algorithm>

namespace equiaffine::internal {

/// Returns a usual tolerance, or less for the facets of solids with planes only: they are flat to the rounding of their
/// coordinates, and so are their distances.
inline double tolerance_of_facets(double facet_error, double usual) {
  constexpr double rounding = 2e-5, distance_per_error = 1000;
  return std::min(usual, std::max(rounding, distance_per_error * facet_error));
}

/// The least and the greatest distance between points in contact where nothing is known of noise.
constexpr double usual_contact = 1e-3, greatest_contact = 1e-2;

/// The distance up to which points of two pieces are in contact.
inline double tolerance_of_contact(double facet_error, const Registration_request& request) {
  if (request.tolerance) return *request.tolerance;
  return tolerance_of_facets(facet_error, std::clamp(4 * facet_error, usual_contact, greatest_contact));
}

/// The rms distances of whole surfaces.
struct Tolerances_of_wholes {
  double equal; ///< up to which they are equal
  double alone; ///< up to which they are alike by one map if all others are twice as far
  double tried; ///< up to which rotations are tried
};

/// Triangles are off a smooth surface, and thin surfaces are nearer to others. Two samplings of one object, such as a
/// scan and its coarse version, are alike without being equal; solids with planes only have no such versions.
inline Tolerances_of_wholes tolerances_of_wholes(const Centered_pair& surfaces, const Registration_request& request) {
  constexpr double least = 3e-3, greatest = 0.01, alike = 0.015;
  const double facet_error = surfaces.source.samples.facet_error + surfaces.target.samples.facet_error;
  const double thickness = std::min(surfaces.source.thickness(), surfaces.target.thickness());
  const double usual = std::clamp(1.2 * facet_error, least, greatest) * thickness;
  if (request.tolerance) return {*request.tolerance, 0, std::max(*request.tolerance, least * thickness)};
  const double equal = tolerance_of_facets(facet_error, usual);
  return {equal, equal < usual ? 0 : alike * thickness, usual};
}

} // namespace equiaffine::internal

#endif
