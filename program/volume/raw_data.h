// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_RAW_DATA_H
#define EQUIAFFINE_PROGRAM_VOLUME_RAW_DATA_H

#include "volume/Shared_volume.h"
#include "volume/volume_formats.h"

#include <cstddef>
#include <optional>
#include <string>

namespace equiaffine {

/// Finds so many samples of a MetaImage, NRRD, NIfTI-1 or VTI file, if they are neither compressed nor in another byte
/// order than that of this computer, nor to be scaled, and lie in one file. `type` is a position in raw_types. The
/// header has been checked.
std::optional<Raw_data> find_raw_data(const std::string& path, Volume_format format, std::size_t type,
                                      std::size_t count);

} // namespace equiaffine

#endif
