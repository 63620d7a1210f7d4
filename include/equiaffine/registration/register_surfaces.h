// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H
#define EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/Surface_registration_3.h>
#include <equiaffine/registration/internal/registration.h>

#include <CGAL/tags.h>

#include <ranges>

namespace equiaffine {

/// Finds the maps that move the surface `source`, or a part of it, onto the surface `target`. Each surface is a function
/// and a range of points on its zero set, which are moved onto it if they are near; the functions are of any models of
/// the concept, and defined on their boxes.
///
/// The affine frame at one generic point of the source and that at its counterpart give the map, or the frames of the
/// principal directions for maps that keep angles. Counterparts are found by their signatures: the nearest ones among
/// the points of the target, by a tree, then exactly, by Newton's steps on the target. A map is judged by the distances
/// of points both ways, refined by least squares, and accepted if fewer than 1e-6 as good ones are expected by chance:
/// neither an overlap nor the absence of other things is assumed. Points lie on the other surface if they are within
/// the noise, which is that of the given points: `tolerance` is 8 times their median distance from the zero sets, at
/// least 1e-5 of the size of the target, and at most 3e-3 of it, since large parts of unrelated surfaces can be moved
/// onto each other to within more. Where the frame of a point is not determined, as the affine one on quadrics, it is
/// not matched: surfaces with continuous symmetries have a slippage, see Surface_registration_3. A fit
/// (Fitted_function_traits_3) estimates its errors: points where its curvatures are uncertain are tried later.
///
/// Takes 5 expansions for each of up to 6000 points of a surface, and a number of hypotheses that does not depend on the
/// number of points. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit.
///
/// Named parameters: `map_kind`, `reflections`, `number_of_maps`, `least_overlap`, `tolerance`,
/// `refined_functions`.
/// \throw std::invalid_argument if a surface has no points, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points,
          class Parameters = internal::No_parameters>
Surface_registration_3<Kernel_of<Target>> register_surfaces(const Source& source, const Points& source_points,
                                                            const Target& target, const Target_points& target_points,
                                                            const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Map_kind_tag, internal::Reflections_tag,
                             internal::Number_of_maps_tag, internal::Least_overlap_tag, internal::Refined_functions_tag,
                             internal::Tolerance_tag>();
  return internal::registration_of<ConcurrencyTag>(source, source_points, target, target_points, parameters).result;
}

} // namespace equiaffine

#endif
