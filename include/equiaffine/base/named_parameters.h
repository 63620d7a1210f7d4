// SPDX-License-Identifier: GPL-3.0-or-later
// Named parameters in the style of CGAL: `parameters::number_of_nodes(128).vertex_position(Vertex_position::LINEAR)`.
// internal/named_parameter_list.h has the list. The types are our own, since CGAL's list of names is closed and differs
// between its versions 5 and 6.
#ifndef EQUIAFFINE_BASE_NAMED_PARAMETERS_H
#define EQUIAFFINE_BASE_NAMED_PARAMETERS_H

#include <equiaffine/base/internal/Named_parameters.h>
#include <equiaffine/base/internal/named_parameter_list.h>

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace equiaffine::parameters {

/// Every parameter has its default.
inline internal::No_parameters default_values() { return {}; }

/// Several chains of named parameters, of equiaffine and of CGAL, as one chain, for functions that take a chain for each
/// of two surfaces. Of two parameters with the same name the last one counts.
template <internal::Parameter_chain... Chains>
internal::Joined_parameters<Chains...> joined(const Chains&... chains) {
  return internal::joined_parameters(chains...);
}

EQUIAFFINE_NAMED_PARAMETERS(, default_values())

} // namespace equiaffine::parameters

#undef EQUIAFFINE_NAMED_PARAMETERS
#undef EQUIAFFINE_VERTEX_MAP

#endif
