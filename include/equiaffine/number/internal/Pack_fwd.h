// SPDX-License-Identifier: GPL-3.0-or-later
// Declares Pack, for headers that only name it.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_PACK_FWD_H
#define EQUIAFFINE_NUMBER_INTERNAL_PACK_FWD_H

#include <equiaffine/number/internal/native_lanes.h>

namespace equiaffine {

template <class T, class Lanes = internal::Native_lanes<T>>
struct Pack;

} // namespace equiaffine

#endif
