// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H
#define EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/registration/internal/registration.h>

#include <CGAL/tags.h>

#include <ranges>

namespace equiaffine {

/// Returns whether register_surfaces() finds a map that moves each of two surfaces onto the other: all but 2 % of their
/// points, of those that stay in the box of the other function. Named parameters: those of register_surfaces(), except
/// `number_of_maps`.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points,
          class Parameters = internal::No_parameters>
bool is_affinely_equivalent(const Source& source, const Points& source_points, const Target& target,
                            const Target_points& target_points, const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Map_kind_tag, internal::Reflections_tag, internal::Least_overlap_tag,
                             internal::Refined_functions_tag, internal::Tolerance_tag>();
  return internal::registration_of<ConcurrencyTag>(source, source_points, target, target_points, parameters)
      .is_equivalence;
}

} // namespace equiaffine

#endif
