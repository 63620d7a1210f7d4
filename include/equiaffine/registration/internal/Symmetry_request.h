// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRY_REQUEST_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRY_REQUEST_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/internal/Map_request.h>

namespace equiaffine::internal {

/// The default tolerance of symmetries of a function, a part of its size.
constexpr double default_tolerance = 1e-8;

/// The named parameters of affine_symmetries() of a function.
struct Symmetry_request : Map_request {
  bool is_complete = false; ///< whether all rotations are searched where frames have decided, too
};

template <class Parameters>
Symmetry_request symmetry_request(const Parameters& parameters) {
  return {map_request(parameters), get_parameter<Complete_tag>(parameters, false)};
}

} // namespace equiaffine::internal

#endif
