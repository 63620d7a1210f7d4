// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FITS_H
#define EQUIAFFINE_FIT_INTERNAL_FITS_H

#include <equiaffine/fit/internal/declared_fits.h>

#include <Eigen/Core>

// The target equiaffine::compiled has the definitions, compiled once. A program for vector instructions with which Eigen
// aligns memory to more bytes has its own: it could not free what that library allocates.
#if !defined(EQUIAFFINE_COMPILED) || EIGEN_DEFAULT_ALIGN_BYTES != 16
#include <equiaffine/fit/internal/blended_function.h>
#include <equiaffine/fit/internal/distances_of_sheets.h>
#include <equiaffine/fit/internal/structures_of_fit.h>
#endif

#endif
