// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/registration/internal/Registration_request.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/internal/vectors_of.h>

namespace equiaffine::internal {

template <class ConcurrencyTag, class Source, class Points, class Target, class Target_points, class Parameters>
Registration_of_functions_3 registration_of(const Source& source, const Points& source_points, const Target& target,
                                            const Target_points& target_points, const Parameters& parameters) {
  const auto function = Any_function_3::make(source), target_function = Any_function_3::make(target);
  Refined_surface_3 from = {{function, vectors_of(source_points)}, function};
  Refined_surface_3 to = {{target_function, vectors_of(target_points)}, target_function};
  if constexpr (has_parameter<Refined_functions_tag, Parameters>) {
    const auto& [refined_source, refined_target] = given_parameter<Refined_functions_tag>(parameters);
    from.refined = Any_function_3::make(refined_source);
    to.refined = Any_function_3::make(refined_target);
  }
  return registration_of_functions(runs_in_threads<ConcurrencyTag>(), from, to, registration_request(parameters));
}

} // namespace equiaffine::internal

#endif
