// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_MAP_REQUEST_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_MAP_REQUEST_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/Map_kind.h>

#include <optional>

namespace equiaffine::internal {

/// The named parameters of every search for maps.
struct Map_request {
  Map_kind kind = Map_kind::AFFINE;
  bool allows_reflections = true;
  std::optional<double> tolerance = {}; ///< a part of a size; if there is none, the data tell
};

template <class Parameters, class... OtherTags>
constexpr void check_map_parameters() {
  check_parameters<Parameters, Map_kind_tag, Reflections_tag, Tolerance_tag, Geom_traits_tag, Verbose_tag,
                   OtherTags...>();
}

template <class Parameters>
Map_request map_request(const Parameters& parameters) {
  Map_request request;
  request.kind = get_parameter<Map_kind_tag>(parameters, request.kind);
  request.allows_reflections = get_parameter<Reflections_tag>(parameters, request.allows_reflections);
  if constexpr (has_parameter<Tolerance_tag, Parameters>)
    request.tolerance = given_parameter<Tolerance_tag>(parameters);
  check_argument(!request.tolerance || (*request.tolerance > 0 && *request.tolerance < 0.1),
                 "the tolerance of maps is a part of a size, from 0 to 0.1");
  return request;
}

} // namespace equiaffine::internal

#endif
