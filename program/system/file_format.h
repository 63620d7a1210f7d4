// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FILE_FORMAT_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FILE_FORMAT_H

#include <string>

namespace equiaffine {

/// The formats of files that are no volumes, for which there is Volume_format.
enum class File_format {
  PLY,
  OFF,
  OBJ,
  STL,
  VTP,
  CSV,
  XYZ,
  HTML,
  PNG,
  JSON,
  OTHER,  ///< the path has another extension
  UNNAMED ///< the path has none
};

/// The format that the extension of a path stands for, in lower or upper case.
File_format file_format(const std::string& path);

} // namespace equiaffine

#endif
