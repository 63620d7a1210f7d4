// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FEATURE_ANGLE_H
#define EQUIAFFINE_FIT_INTERNAL_FEATURE_ANGLE_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>

#include <optional>

namespace equiaffine::internal {

/// The angle in degrees of creases, over which fits do not reach and which a remesh keeps; nothing for no creases.
template <class Parameters>
std::optional<double> feature_angle(const Parameters& parameters) {
  const auto angle = get_parameter<Feature_angle_tag>(parameters, std::optional<double>(60.));
  check_argument(!angle || (*angle >= 0 && *angle <= 180), "the angle of creases is from 0 to 180 degrees");
  return angle;
}

} // namespace equiaffine::internal

#endif
