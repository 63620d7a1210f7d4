// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Centered_surface_3.h"
#include "registration/candidate_rotations.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/LU>

#include <cmath>

namespace equiaffine::internal {

bool differ_as_wholes(bool in_threads, const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections) {
  constexpr double difference = 0.03; // of what is equal, a part of the size
  const auto a = centered_surface(in_threads, source, kind), b = centered_surface(in_threads, target, kind);
  if (!a.reason_against.empty() || !b.reason_against.empty()) return false;
  const double ratio = std::cbrt(std::abs(a.map.matrix.determinant() / b.map.matrix.determinant()));
  if (keeps_volume(kind) && std::abs(std::log(ratio)) > difference) return true;
  return candidate_rotations(in_threads, a, b, difference, allows_reflections).rotations.empty();
}

} // namespace equiaffine::internal
