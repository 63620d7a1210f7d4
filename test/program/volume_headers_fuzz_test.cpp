// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of headers of volumes accept or refuse any bytes, and the size of what they name is found.
#include "support/Scratch_file.h"
#include "support/fuzz_target.h"
#include "volume/data_files.h"
#include "volume/volume_formats.h"

namespace volume_headers_fuzz_test {

EQUIAFFINE_FUZZ_TARGET(volume_headers) {
  using namespace equiaffine;
  static const test::Scratch_file file("volume");
  const std::string path = file.write(input);
  for (const auto check : {check_inr_header, check_meta_header, check_nifti_header, check_vti_header})
    test::accepts([&] { check(path); });
  for (const auto format : {Volume_format::META, Volume_format::NRRD}) {
    test::accepts([&] { check_data_files(path, format, false); });
    test::expect(size_of_volume(path, format) >= double(input.size()), "a volume is no smaller than its header");
  }
}

} // namespace volume_headers_fuzz_test
