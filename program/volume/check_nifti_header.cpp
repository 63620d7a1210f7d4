// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Nifti_header.h"
#include "volume/header_checks.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <filesystem>
#include <optional>
#include <system_error>

namespace equiaffine {

void check_nifti_header(const std::string& path) {
  const Nifti_header header(path);
  header.lattice();
  const double expected = header.size_of_file();
  std::error_code error;
  const std::optional<double> size =
      is_gzip(path) ? decompressed_size(path) : double(std::filesystem::file_size(path, error));
  if (error || !size || *size < expected) fail_to_read_volume_data(path);
}

} // namespace equiaffine
