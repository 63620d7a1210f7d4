// SPDX-License-Identifier: GPL-3.0-or-later
// Whether there is a map that moves each of two surfaces onto the other.
#ifndef EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H
#define EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/Uncertain.h>
#include <CGAL/tags.h>

#include <ranges>

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Whether it was verified that no map of a kind moves one whole surface onto another. Such a map would keep the
/// centroid of the area, and affine ones the moments of the solid inside, so that all rotations and reflections about
/// the centroid are tried in the coordinates of the search for symmetries: each moves points of the first away from the
/// second.
bool differ_as_wholes(bool in_threads, const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns whether there is a map that moves each of two surfaces onto the other: all but 2 % of their points, of those
/// that stay in the box of the other function.
///
/// The answer is true if register_surfaces() finds such a map, and false if the map that it finds moves a part only, or
/// if all rotations of the whole surfaces were tried, in coordinates in which their solids are round, and none moves
/// one near the other. Else it is indeterminate, as for surfaces that leave their boxes and have no map with evidence:
/// the conversion to bool throws CGAL::Uncertain_conversion_exception then. The named parameters are those of
/// register_surfaces() without `number_of_maps`:
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `least_overlap` | `double` | 0.05 | part of the points of one surface that lies on the other |
/// | `tolerance` | `double` | as there | distance of equal surfaces, a part of the size of the target |
/// | `refined_functions` | `std::pair` | source and target | functions on which maps are refined and judged |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points,
          internal::Parameter_chain... Parameters>
CGAL::Uncertain<bool> is_affinely_equivalent(const Source& source, const Points& source_points, const Target& target,
                                             const Target_points& target_points, const Parameters&... given) {
  internal::check_map_parameters<internal::Joined_parameters<Parameters...>, internal::Least_overlap_tag,
                                 internal::Refined_functions_tag>();
  const auto parameters = internal::joined_parameters(given...);
  const auto registration =
      internal::registration_of<ConcurrencyTag>(source, source_points, target, target_points, parameters);
  if (registration.is_equivalence || registration.result.found()) return registration.is_equivalence;
  const auto request = internal::registration_request(parameters);
  if (internal::differ_as_wholes(runs_in_threads<ConcurrencyTag>(), Any_function_3::make(source),
                                 Any_function_3::make(target), request.kind, request.allows_reflections))
    return false;
  return CGAL::Uncertain<bool>::indeterminate();
}

} // namespace equiaffine

#endif
