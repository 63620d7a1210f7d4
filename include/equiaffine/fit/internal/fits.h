// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FITS_H
#define EQUIAFFINE_FIT_INTERNAL_FITS_H

#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fit_data_3.h>
#include <equiaffine/fit/internal/Fit_request.h>
#include <equiaffine/fit/internal/Fitted_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>

#include <cstddef>
#include <memory>
#include <vector>

// The library defines these functions, which do the work of fits. They run in the threads of TBB if `in_threads`. Their
// parameters name no type of Eigen, whose namespace has another name in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Returns the structure at each of the given points.
std::vector<Fitted_structure_3<double>>
structures_of_data(bool in_threads, Fit_data_3 given, const Fit_request& request, Orientation_of_level_set orientation);

/// Returns the structure at one vertex of a mesh.
Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_request& request,
                                               Orientation_of_level_set orientation, std::size_t i);

/// Returns the blend of fits to the data.
std::shared_ptr<const Fitted_function_3> fitted_function(bool in_threads, Fit_data_3 given, const Fit_request& request);

/// The distances along the normals, in the coordinates of the data, between points and the next ones that are within a
/// spacing of them across and on another sheet, where these are less than `greatest` and about ten spacings. Points that
/// are not connected nearby are on different sheets, and points whose normals are opposed, as on both sides of a thin
/// plate or tube.
std::vector<double> distances_of_sheets(bool in_threads, const Fitted_data_3& fit, double greatest);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
