// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/raw_volume.h"

#include "system/Mapped_file.h"
#include "volume/sample_type.h"
#include "volume/volume_formats.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>

namespace equiaffine {

Volume_view_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout) {
  const auto& [dx, dy, dz] = layout.spacing;
  const auto& [x, y, z] = layout.origin;
  const Lattice_3<Kernel> lattice =
      make_lattice(path, layout.dims, Kernel::Point_3(x, y, z),
                   {Kernel::Vector_3(dx, 0, 0), Kernel::Vector_3(0, dy, 0), Kernel::Vector_3(0, 0, dz)},
                   size_of_sample(layout.type));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail_to_read_volume(path, "there is no such file", "check the path");
  const std::size_t width = size_of_sample(layout.type);
  const double expected = double(layout.dims[0]) * double(layout.dims[1]) * double(layout.dims[2]) * double(width);
  if (double(size) != expected)
    fail_to_read_volume(path,
                        "it has " + std::to_string(size) + " bytes, and " + std::to_string(layout.dims[0]) + " x " +
                            std::to_string(layout.dims[1]) + " x " + std::to_string(layout.dims[2]) + " samples of " +
                            std::string(raw_types[layout.type]) + " have " + std::to_string(std::uint64_t(expected)),
                        "correct --dims or --type");
  std::shared_ptr<const Mapped_file> file;
  try {
    file = std::make_shared<const Mapped_file>(path);
  } catch (const std::bad_alloc&) {
    fail_to_read_volume(path, "it does not fit into memory", "crop it");
  }
  if (file->size() != size) fail_to_read_volume(path, "it cannot be read", "check its permissions");
  return with_sample_type(layout.type, [&](auto number) {
    return Volume_view_3<Kernel>(lattice, reinterpret_cast<const decltype(number)*>(file->data()), file);
  });
}

} // namespace equiaffine
