// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/file_format.h"

#include <equiaffine/io/internal/input_file.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

namespace equiaffine {

File_format file_format(const std::string& path) {
  using enum File_format;
  constexpr std::array<std::pair<std::string_view, File_format>, 11> formats = {{{".ply", PLY},
                                                                                 {".off", OFF},
                                                                                 {".obj", OBJ},
                                                                                 {".stl", STL},
                                                                                 {".vtp", VTP},
                                                                                 {".csv", CSV},
                                                                                 {".xyz", XYZ},
                                                                                 {".html", HTML},
                                                                                 {".htm", HTML},
                                                                                 {".png", PNG},
                                                                                 {".json", JSON}}};
  if (!std::filesystem::path(path).has_extension()) return UNNAMED;
  for (const auto& [extension, format] : formats)
    if (has_extension(path, extension)) return format;
  return OTHER;
}

} // namespace equiaffine
