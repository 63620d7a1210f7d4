// SPDX-License-Identifier: GPL-3.0-or-later
// The location of a volume's data: the files that its header names, and the offset in one of them.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_DATA_FILES_H
#define EQUIAFFINE_PROGRAM_VOLUME_DATA_FILES_H

#include "volume/Shared_volume.h"
#include "volume/volume_formats.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// The data files named by a MetaImage or NRRD header.
struct Data_files {
  std::string content;            ///< of the field that names them
  std::vector<std::string> names; ///< in their order; none if the data follow the header
  std::size_t expected = 0;       ///< the number of files required by the sizes of a MetaImage
  bool are_understood = true;     ///< false if a pattern of names is invalid
};

/// The files named by the content of a field and the lines after it: a list, a pattern such as slice%03d.raw with the
/// first and last number and the step, or one file. `sizes` are those of a MetaImage along its axes, or empty.
Data_files data_files_in(std::string_view content, std::string_view following_lines,
                         const std::vector<std::size_t>& sizes);

/// Throws `Input_error` unless the files named by a MetaImage or NRRD header exist, match the number of slices, and are
/// in the folder of the header or below it, unless `allows_outside`. Targets of links there are allowed.
void check_data_files(const std::string& path, Volume_format format, bool allows_outside);

/// The number of bytes to read: those of the file and of the files named by a MetaImage or NRRD header, or those of all
/// files in a folder, which has no format. A file that cannot be read counts as 0.
double size_of_volume(const std::string& path, std::optional<Volume_format> format);

/// The files that are read with a volume: those named by its header, or all files of a folder.
std::vector<std::string> files_of_volume(const std::string& path, std::optional<Volume_format> format);

/// Finds the `count` samples of a MetaImage, NRRD, NIfTI-1 or VTI file if they are in one file, uncompressed, unscaled
/// and in the byte order of this computer. `type` is a position in raw_types. \pre the header has been checked
std::optional<Raw_data> find_raw_data(const std::string& path, Volume_format format, std::size_t type,
                                      std::size_t count);

} // namespace equiaffine

#endif
