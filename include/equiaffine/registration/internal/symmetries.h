// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRIES_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/internal/Framed_surface_3.h>
#include <equiaffine/registration/internal/Symmetry_search.h>
#include <equiaffine/registration/internal/slippage.h>
#include <equiaffine/registration/internal/vectors_of.h>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// Distances from the surface below this part of its size are zero by default.
constexpr double default_tolerance = 1e-8;

template <class ConcurrencyTag, class Kernel>
Affine_symmetries_3<Kernel> symmetries_of_framed(const Framed_surface_3& surface, Map_kind kind,
                                                 bool allows_reflections, double tolerance) {
  Affine_symmetries_3<Kernel> result;
  result.continuous = slippage_of(surface, kind, std::max(tolerance, slippage_tolerance));
  const bool is_finite = result.continuous.dimension() == 0 && !surface.probes.empty();
  Symmetry_search<ConcurrencyTag> search(surface, kind, tolerance);
  for (const Affine_map_3& map : is_finite ? search.run() : std::vector<Affine_map_3>(1))
    if (allows_reflections || map.matrix.determinant() > 0)
      result.maps.push_back({map.to_CGAL<typename Kernel::Aff_transformation_3>(), search.rms(map)});
  return result;
}

template <class ConcurrencyTag, class Traits, class Points, class Parameters>
Affine_symmetries_3<Kernel_of<Traits>> symmetries_of(const Traits& traits, const Points& points,
                                                     const Parameters& parameters) {
  const Map_kind kind = get_parameter<Map_kind_tag>(parameters, Map_kind::AFFINE);
  const bool allows_reflections = get_parameter<Reflections_tag>(parameters, true);
  const double tolerance = get_parameter<Tolerance_tag>(parameters, default_tolerance);
  const auto vectors = vectors_of(points);
  check_argument(!vectors.empty(), "a surface whose symmetries are sought has no points: give points on it");
  check_argument(tolerance > 0 && tolerance < 0.1, "the tolerance of symmetries is a part of a size, from 0 to 0.1");
  const Oracle_of_traits_3 function(traits);
  return symmetries_of_framed<ConcurrencyTag, Kernel_of<Traits>>(
      framed_surface<ConcurrencyTag>(function, function, vectors, kind), kind, allows_reflections, tolerance);
}

} // namespace equiaffine::internal

#endif
