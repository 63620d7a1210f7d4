// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_REQUEST_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_REQUEST_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/Map_kind.h>

#include <cstddef>
#include <optional>

namespace equiaffine::internal {

/// The named parameters of register_surfaces.
struct Registration_request {
  Map_kind kind = Map_kind::AFFINE;
  bool allows_reflections = true;
  std::size_t number_of_maps = 1;
  double least_overlap = 0.05;
  std::optional<double> tolerance = {}; ///< beside the size of the target; if there is none, the points tell
};

template <class Parameters>
Registration_request registration_request(const Parameters& parameters) {
  Registration_request request;
  request.kind = get_parameter<Map_kind_tag>(parameters, request.kind);
  request.allows_reflections = get_parameter<Reflections_tag>(parameters, request.allows_reflections);
  request.number_of_maps = get_parameter<Number_of_maps_tag>(parameters, request.number_of_maps);
  request.least_overlap = get_parameter<Least_overlap_tag>(parameters, request.least_overlap);
  if constexpr (has_parameter<Tolerance_tag, Parameters>)
    request.tolerance = given_parameter<Tolerance_tag>(parameters);
  check_argument(!request.tolerance || (*request.tolerance > 0 && *request.tolerance < 0.1),
                 "the tolerance of a map is a part of a size, from 0 to 0.1");
  check_argument(request.number_of_maps > 0, "the number of maps to find is at least 1");
  check_argument(request.least_overlap >= 0 && request.least_overlap <= 1,
                 "the least overlap is a part of a surface, from 0 to 1");
  return request;
}

} // namespace equiaffine::internal

#endif
