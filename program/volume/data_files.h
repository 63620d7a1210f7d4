// SPDX-License-Identifier: GPL-3.0-or-later
// Where a volume has its data: in files that its header names, and at a place in one of them.
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

/// The files with the data that a MetaImage or NRRD header names.
struct Data_files {
  std::string content;            ///< of the field that names them
  std::vector<std::string> names; ///< in their order; none if the data follow the header
  std::size_t expected = 0;       ///< the number of them that the sizes of a MetaImage ask for
  bool are_understood = true;     ///< a pattern of names may be none
};

/// The files that the content of a field names with the lines after it: a list, a pattern such as slice%03d.raw with
/// the first and the last number and the step, or one file. `sizes` are those of a MetaImage along its axes, or none.
Data_files data_files_in(std::string_view content, std::string_view following_lines,
                         const std::vector<std::size_t>& sizes);

/// Throws `Input_error` unless the files that a MetaImage or NRRD header names exist, are as many as slices, and lie in
/// the folder of the header or below it, or are allowed outside. What a link there leads to is allowed.
void check_data_files(const std::string& path, Volume_format format, bool allows_outside);

/// The bytes that a reader has to look at: those of the file, with the files that a MetaImage or NRRD header names, or
/// those of all files in a folder, which has no format. A file that cannot be read counts for nothing.
double size_of_volume(const std::string& path, std::optional<Volume_format> format);

/// The paths of the files that are read with a volume: those that its header names, or all in a folder.
std::vector<std::string> files_of_volume(const std::string& path, std::optional<Volume_format> format);

/// Finds so many samples of a MetaImage, NRRD, NIfTI-1 or VTI file, if they are neither compressed nor in another byte
/// order than that of this computer, nor to be scaled, and lie in one file. `type` is a position in raw_types. The
/// header has been checked.
std::optional<Raw_data> find_raw_data(const std::string& path, Volume_format format, std::size_t type,
                                      std::size_t count);

} // namespace equiaffine

#endif
