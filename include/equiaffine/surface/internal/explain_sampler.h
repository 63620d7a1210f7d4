// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_EXPLAIN_SAMPLER_H
#define EQUIAFFINE_SURFACE_INTERNAL_EXPLAIN_SAMPLER_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>

#include <concepts>
#include <ranges>

namespace equiaffine {

/// Whether the arguments are empty, or options followed by named parameters.
template <class Options, class... Arguments>
inline constexpr bool are_options = true;
template <class Options, class First, class... Parameters>
inline constexpr bool are_options<Options, First, Parameters...> = std::same_as<First, Options> &&
                                                                   (internal::Parameter_chain<Parameters> && ...);

/// Whether the arguments of a sampler after the function are valid: a mesh, or an isovalue with two containers, or
/// neither; then options.
template <class Options, class... Arguments>
inline constexpr bool are_for_sampler = true;
template <class Options, class First, class... Others>
inline constexpr bool are_for_sampler<Options, First, Others...> = are_options<Options, First, Others...> ||
                                                                   (Face_graph<First> &&
                                                                    are_options<Options, Others...>);
template <class Options, class First, std::ranges::range Points, std::ranges::range Triangles, class... Others>
inline constexpr bool are_for_sampler<Options, First, Points, Triangles, Others...> =
    !std::same_as<First, Options> && are_options<Options, Others...>;

/// A call of a sampler with wrong arguments.
template <class Options, class Traits, class... Arguments>
concept Mistaken_for_sampler = !(ImplicitFunctionTraits_3<Traits> && are_for_sampler<Options, Arguments...>);

/// Does not compile for such a call; the error explains it.
template <class Options, class Traits, class... Arguments>
constexpr void explain_sampler() {
  internal::explain_traits<Traits>();
  static_assert(are_for_sampler<Options, Arguments...>,
                "the arguments after the function must be a mesh of CGAL, or an isovalue with a container of points "
                "and one of triangles, or neither; then options, such as {.resolution = 64} or {}; then named "
                "parameters");
}

} // namespace equiaffine

#endif
