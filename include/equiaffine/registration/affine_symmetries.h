// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/symmetries.h>

#include <CGAL/tags.h>

#include <ranges>

namespace equiaffine {

/// Finds all maps of a kind that move a surface, given by a function and points on its zero set, onto itself as a set
/// of points, whichever way its normals point. They are found as `register_surfaces` finds maps, for a few points with all
/// their possible images; products complete the group, and every element is verified. Where the surface has continuous
/// symmetries of the kind, the result has their generators, and no others are sought: an ellipsoid has infinitely many
/// affine symmetries, but 8 rigid ones if its axes differ.
///
/// Points that leave the box of the function do not count, so that an unbounded surface in a box has the symmetries of
/// the whole one. Named parameters: `map_kind`, `reflections`, `tolerance`. \throw std::invalid_argument if there are
/// no points, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, std::ranges::input_range Points,
          class Parameters = internal::No_parameters>
Affine_symmetries_3<Kernel_of<Traits>> affine_symmetries(const Traits& traits, const Points& points,
                                                         const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Map_kind_tag, internal::Reflections_tag, internal::Tolerance_tag>();
  return internal::symmetries_of<ConcurrencyTag>(traits, points, parameters);
}

} // namespace equiaffine

#endif
