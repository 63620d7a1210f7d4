// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_STRUCTURE_BY_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_STRUCTURE_BY_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/reference_estimators.h>

#include <array>

namespace equiaffine::internal {

/// Computes the structure by the estimator in `parameters`. If there is none, the paper's estimators are not
/// instantiated.
template <class Parameters, class FT>
Local_structure_3<FT> structure_by(const Parameters& parameters, const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                   const FT& rounding) {
  if constexpr (has_parameter<Estimator_tag, Parameters>)
    return local_structure(jet, point, rounding, get_parameter<Estimator_tag>(parameters, Estimator::COMPACT));
  else return local_structure(jet, point, rounding);
}

} // namespace equiaffine::internal

#endif
