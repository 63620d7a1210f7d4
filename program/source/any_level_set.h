// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_ANY_LEVEL_SET_H
#define EQUIAFFINE_PROGRAM_SOURCE_ANY_LEVEL_SET_H

#include "source/source_function.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>

namespace equiaffine {

/// The function whose zero set is a level set, behind one type, for what takes little time to run and long to compile.
Any_function_3 any_level_set(const Source_function& function, double isovalue,
                             Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT);

} // namespace equiaffine

#endif
