// SPDX-License-Identifier: GPL-3.0-or-later
// Decides whether a map moves each of two surfaces onto the other.
#ifndef EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H
#define EQUIAFFINE_REGISTRATION_IS_AFFINELY_EQUIVALENT_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/Uncertain.h>
#include <CGAL/tags.h>

#include <ranges>

// Defined in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Whether it was verified that no map of a kind moves one whole surface onto another. Such a map preserves the
/// centroid of the area, and an affine one the moments of the solid inside. Therefore all rotations and reflections
/// about the centroid are tried in the coordinates of the symmetry search; none may move the points of the first
/// surface close to the second.
bool differ_as_wholes(bool in_threads, const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns whether a map moves each of two surfaces onto the other: all but 2 % of their points, not counting those
/// outside of the box of the other function.
///
/// The answer is true if register_surfaces() finds such a map. It is false if the best map moves only a part, or if
/// all rotations of the whole surfaces were tried, in coordinates in which their solids are round, and none moves
/// one close to the other. Otherwise it is indeterminate, for example for surfaces that leave their boxes and have
/// no map with evidence; the conversion to bool then throws CGAL::Uncertain_conversion_exception. The options are
/// those of register_surfaces(); `fit` is ignored.
/// \throw Input_error if an option is invalid. \throw std::invalid_argument if a surface has no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points>
CGAL::Uncertain<bool> is_affinely_equivalent(const Source& source, const Points& source_points, const Target& target,
                                             const Target_points& target_points,
                                             const Registration_options& options = {}) {
  options.check();
  constexpr bool in_threads = runs_in_threads<ConcurrencyTag>();
  const auto from = internal::surface_of_function(source, source_points),
             to = internal::surface_of_function(target, target_points);
  const auto registration = internal::registration_of_functions(in_threads, from, to, options);
  if (registration.is_equivalence || registration.result.found()) return registration.is_equivalence;
  if (internal::differ_as_wholes(in_threads, from.function, to.function, options.kind, options.reflections))
    return false;
  return CGAL::Uncertain<bool>::indeterminate();
}

} // namespace equiaffine

#endif
