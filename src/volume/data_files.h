// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_VOLUME_DATA_FILES_H
#define EQUIAFFINE_SRC_VOLUME_DATA_FILES_H

#include "volume/volume_formats.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// The names of the files with the data, from the field of a MetaImage or NRRD header that has them and the lines after
/// it; none if the data follow the header. A name with a % stands for several files.
std::vector<std::string> data_files_in(std::string_view content, std::string_view following_lines);

/// The bytes that a reader has to look at: those of the file, with the files that a MetaImage or NRRD header names, or
/// those of all files in a folder, which has no format. A file that cannot be read counts for nothing.
double size_of_volume(const std::string& path, std::optional<Volume_format> format);

} // namespace equiaffine

#endif
