// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/header_checks.h"
#include "volume/sample_type.h"
#include "volume/volume_formats.h"

#include <CGAL/Image_3.h>

#include <cstddef>
#include <string>

namespace equiaffine {

namespace {

std::size_t sample_type_of(const CGAL::Image_3& image) {
  using namespace CGAL; // where CGAL 6 has the constants, which are global in CGAL 5
  const auto& header = *image.image();
  return header.wordKind == WK_FLOAT ? floating_sample_type(header.wdim)
                                     : integer_sample_type(header.wdim, header.sign == SGN_SIGNED);
}

} // namespace

void read_inr_volume(const std::string& path, const Volume_selection& selection, Shared_volume& volume) {
  check_inr_header(path);
  CGAL::Image_3 image;
  bool has_been_read = false;
  {
    const Captured_standard_error standard_error;
    has_been_read = image.read(path);
  }
  if (!has_been_read) fail_to_read_volume(path, "it is not a complete INRIMAGE-4 file", "get the complete file again");
  const auto& header = *image.image();
  if (header.rx != 0 || header.ry != 0 || header.rz != 0)
    fail_to_read_volume(path, "its axes are rotated (RX, RY, RZ), which .inr readers ignore",
                        "convert it to .nrrd or .mha");
  const Lattice_3<Kernel> lattice = make_lattice(
      path, {header.xdim, header.ydim, header.zdim}, Kernel::Point_3(header.tx, header.ty, header.tz),
      {Kernel::Vector_3(header.vx, 0, 0), Kernel::Vector_3(0, header.vy, 0), Kernel::Vector_3(0, 0, header.vz)});
  chosen_time(path, selection, 1);
  const std::size_t type = sample_type_of(image);
  copy_samples(type, image.data(), chosen_component(path, selection, header.vdim), header.vdim,
               lattice.number_of_nodes(), volume.allocate(lattice, type));
}

} // namespace equiaffine
