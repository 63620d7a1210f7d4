// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_REQUEST_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_REQUEST_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/internal/Frame_thresholds.h>
#include <equiaffine/registration/internal/Map_request.h>

#include <cstddef>

namespace equiaffine::internal {

/// The named parameters of register_surfaces, and thresholds that benchmarks vary. The tolerance is beside the size of
/// the target.
struct Registration_request : Map_request {
  std::size_t number_of_maps = 1;
  double least_overlap = 0.05;
  Frame_thresholds thresholds = {};
};

template <class Parameters, class... OtherTags>
constexpr void check_registration_parameters() {
  check_map_parameters<Parameters, Number_of_maps_tag, Least_overlap_tag, OtherTags...>();
}

template <class Parameters>
Registration_request registration_request(const Parameters& parameters) {
  Registration_request request = {map_request(parameters)};
  request.number_of_maps = get_parameter<Number_of_maps_tag>(parameters, request.number_of_maps);
  request.least_overlap = get_parameter<Least_overlap_tag>(parameters, request.least_overlap);
  check_argument(request.number_of_maps > 0, "the number of maps to find is at least 1");
  check_argument(request.least_overlap >= 0 && request.least_overlap <= 1,
                 "the least overlap is a part of a surface, from 0 to 1");
  return request;
}

} // namespace equiaffine::internal

#endif
