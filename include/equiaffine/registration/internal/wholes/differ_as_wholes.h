// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_DIFFER_AS_WHOLES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_DIFFER_AS_WHOLES_H

#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/declared_searches.h>
#include <equiaffine/registration/internal/wholes/Centered_surface_3.h>
#include <equiaffine/registration/internal/wholes/candidate_rotations.h>
#include <equiaffine/surface/Any_function_3.h>

#include <Eigen/LU>

#include <cmath>

namespace equiaffine::internal {

template <class ConcurrencyTag>
bool differ_as_wholes(const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections) {
  constexpr double difference = 0.03; // of what is equal, a part of the size
  const auto a = centered_surface<ConcurrencyTag>(source, kind), b = centered_surface<ConcurrencyTag>(target, kind);
  if (!a.reason_against.empty() || !b.reason_against.empty()) return false;
  const double ratio = std::cbrt(std::abs(a.map.matrix.determinant() / b.map.matrix.determinant()));
  if (keeps_volume(kind) && std::abs(std::log(ratio)) > difference) return true;
  return candidate_rotations<ConcurrencyTag>(a, b, difference, allows_reflections).rotations.empty();
}

} // namespace equiaffine::internal

#endif
