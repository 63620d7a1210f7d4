// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/volume_formats.h"

#include <CGAL/Image_3.h>

#include <cstdint>
#include <vector>

namespace equiaffine {

namespace {

template <class Word>
std::vector<double> to_doubles(const CGAL::Image_3& image) {
  const Word* const words = static_cast<const Word*>(image.data());
  return {words, words + image.size()};
}

std::vector<double> values_of(const CGAL::Image_3& image) {
  using namespace CGAL; // where CGAL 6 has the constants, which are global in CGAL 5
  const std::size_t bytes = image.image()->wdim;
  if (image.image()->wordKind == WK_FLOAT) return bytes == 4 ? to_doubles<float>(image) : to_doubles<double>(image);
  const bool is_signed = image.image()->sign == SGN_SIGNED;
  switch (bytes) {
  case 1: return is_signed ? to_doubles<std::int8_t>(image) : to_doubles<std::uint8_t>(image);
  case 2: return is_signed ? to_doubles<std::int16_t>(image) : to_doubles<std::uint16_t>(image);
  case 4: return is_signed ? to_doubles<std::int32_t>(image) : to_doubles<std::uint32_t>(image);
  default: return is_signed ? to_doubles<std::int64_t>(image) : to_doubles<std::uint64_t>(image);
  }
}

} // namespace

Volume_3<Kernel> read_inr_volume(const std::string& path) {
  CGAL::Image_3 image;
  bool has_been_read = false;
  {
    const Captured_standard_error standard_error;
    has_been_read = image.read(path);
  }
  if (!has_been_read) fail_to_read_volume(path, "it is not a complete INRIMAGE-4 file", "get the complete file again");
  const auto& header = *image.image();
  if (header.vdim != 1)
    fail_to_read_volume(path, "it has " + std::to_string(header.vdim) + " numbers per node",
                        "extract one of them to a file first");
  if (header.rx != 0 || header.ry != 0 || header.rz != 0)
    fail_to_read_volume(path, "its axes are rotated (RX, RY, RZ), which .inr readers ignore",
                        "convert it to .nrrd or .mha");
  return {make_lattice(path, {header.xdim, header.ydim, header.zdim}, Kernel::Point_3(header.tx, header.ty, header.tz),
                       {Kernel::Vector_3(header.vx, 0, 0), Kernel::Vector_3(0, header.vy, 0),
                        Kernel::Vector_3(0, 0, header.vz)}),
          values_of(image)};
}

} // namespace equiaffine
