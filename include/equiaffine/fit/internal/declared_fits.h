// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DECLARED_FITS_H
#define EQUIAFFINE_FIT_INTERNAL_DECLARED_FITS_H

#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fitted_function_3.h>
#include <equiaffine/fit/internal/data/Fit_data_3.h>
#include <equiaffine/fit/internal/shared/Fit_request.h>

#include <cstddef>
#include <memory>
#include <vector>

// The work of fits, which depends on no type of a user. ConcurrencyTag is CGAL::Sequential_tag or CGAL::Parallel_tag.
namespace equiaffine::internal {

/// Returns the structure at each of the given points.
template <class ConcurrencyTag>
std::vector<Fitted_structure_3<double>> structures_of_data(Fit_data_3 given, const Fit_request& request,
                                                           Orientation_of_level_set orientation);

/// Returns the structure at one vertex of a mesh.
template <class ConcurrencyTag>
Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_request& request,
                                               Orientation_of_level_set orientation, std::size_t i);

/// Returns the blend of fits to the data.
template <class ConcurrencyTag>
std::shared_ptr<const Fitted_function_3> fitted_function(Fit_data_3 given, const Fit_request& request);

/// The distances along the normals, in the coordinates of the data, between points and the next ones that are within a
/// spacing of them across and on another sheet, where these are less than `greatest` and about ten spacings. Points that
/// are not connected nearby are on different sheets, and points whose normals are opposed, as on both sides of a thin
/// plate or tube.
template <class ConcurrencyTag>
std::vector<double> distances_of_sheets(const Fitted_data_3& fit, double greatest);

} // namespace equiaffine::internal

#endif
