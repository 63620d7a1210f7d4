// SPDX-License-Identifier: GPL-3.0-or-later
// A function that knows the named parameter `point_map` is called with the one that the macro PARAMETER names.
#include <equiaffine/base/named_parameters.h>

namespace {

template <class Parameters>
int point_of(const Parameters& parameters) {
  equiaffine::internal::check_parameters<Parameters, equiaffine::internal::Point_tag>();
  return equiaffine::internal::get_parameter<equiaffine::internal::Point_tag>(parameters, 0);
}

} // namespace

int main() { return point_of(equiaffine::parameters::PARAMETER(1).point_map(2)); }
