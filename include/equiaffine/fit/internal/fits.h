// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FITS_H
#define EQUIAFFINE_FIT_INTERNAL_FITS_H

#include <equiaffine/fit/internal/declared_fits.h>

// The target equiaffine::compiled has the definitions, compiled once.
#ifndef EQUIAFFINE_COMPILED
#include <equiaffine/fit/internal/blended_function.h>
#include <equiaffine/fit/internal/distances_of_sheets.h>
#include <equiaffine/fit/internal/structures_of_fit.h>
#endif

#endif
