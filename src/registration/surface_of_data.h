// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a surface to data for registration or for symmetries.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SURFACE_OF_DATA_H
#define EQUIAFFINE_SRC_REGISTRATION_SURFACE_OF_DATA_H

#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/registration/internal/Surface_to_register.h>

namespace equiaffine::internal {

/// The purpose of a fitted surface.
enum class Use_of_surface {
  REGISTRATION, ///< it can be refitted at other scales if the data choose the scale
  SYMMETRIES    ///< points without faces are meshed
};

/// Makes the surface of a fit to data, which must outlive it. Throws `Input_error` about the member `fit`.
Surface_to_register surface_of_data(bool in_threads, const Surface_data_3& data, const Fit_options& options,
                                    Use_of_surface use);

} // namespace equiaffine::internal

#endif
