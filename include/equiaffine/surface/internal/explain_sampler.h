// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_EXPLAIN_SAMPLER_H
#define EQUIAFFINE_SURFACE_INTERNAL_EXPLAIN_SAMPLER_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>

#include <concepts>
#include <ranges>

namespace equiaffine {

/// Whether the arguments of a sampler that follow the function are options: named parameters, or of the type `Criteria`.
template <class Criteria, class... Arguments>
inline constexpr bool are_options = ((internal::Parameter_chain<Arguments> || std::same_as<Arguments, Criteria>)&&...);

/// Whether they are options, or a mesh, or an isovalue with two containers, and options.
template <class Criteria, class... Arguments>
inline constexpr bool are_for_sampler = true;
template <class Criteria, class First, class... Options>
inline constexpr bool are_for_sampler<Criteria, First, Options...> = are_options<Criteria, Options...> &&
                                                                     (are_options<Criteria, First> ||
                                                                      Face_graph<First>);
template <class Criteria, class First, std::ranges::range Points, std::ranges::range Triangles, class... Options>
inline constexpr bool are_for_sampler<Criteria, First, Points, Triangles, Options...> =
    are_options<Criteria, Options...> && !are_options<Criteria, First>;

/// A call of a sampler that is mistaken.
template <class Criteria, class Traits, class... Arguments>
concept Mistaken_for_sampler = !(ImplicitFunctionTraits_3<Traits> && are_for_sampler<Criteria, Arguments...>);

/// Does not compile for such a call.
template <class Criteria, class Traits, class... Arguments>
constexpr void explain_sampler() {
  internal::explain_traits<Traits>();
  static_assert(are_for_sampler<Criteria, Arguments...>,
                "what follows the function has to be a mesh of CGAL, or an isovalue with a container of points and one "
                "of triangles, or nothing, and then named parameters such as parameters::number_of_nodes(64)");
}

} // namespace equiaffine

#endif
