// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_RAW_VOLUME_H
#define EQUIAFFINE_PROGRAM_VOLUME_RAW_VOLUME_H

#include "request/Raw_layout.h"
#include "system/kernel.h"
#include <equiaffine/volume/Volume_view_3.h>

#include <string>

namespace equiaffine {

/// Reads samples one after the other, the first index fastest, in the byte order of this computer. Throws `Input_error`
/// unless the file has exactly the size that the layout says.
Volume_view_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout);

} // namespace equiaffine

#endif
