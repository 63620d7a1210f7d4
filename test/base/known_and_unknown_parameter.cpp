// SPDX-License-Identifier: GPL-3.0-or-later
// A function that knows the named parameter `clip` is called with the one that the macro PARAMETER names.
#include <equiaffine/base/named_parameters.h>

namespace {

template <class Parameters>
int clipped(const Parameters& parameters) {
  equiaffine::internal::check_parameters<Parameters, equiaffine::internal::Clip_tag>();
  return equiaffine::internal::get_parameter<equiaffine::internal::Clip_tag>(parameters, 0);
}

} // namespace

int main() { return clipped(equiaffine::parameters::PARAMETER(1).clip(2)); }
