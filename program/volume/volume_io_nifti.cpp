// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Nifti_header.h"
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

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

namespace {

void reverse_bytes_of_each(std::vector<char>& bytes, std::size_t size) {
  for (auto number = bytes.begin(); number != bytes.end(); number += std::ptrdiff_t(size))
    std::reverse(number, number + std::ptrdiff_t(size));
}

} // namespace

void read_nifti_volume(const std::string& path, Samples_in where, const Volume_selection& selection,
                       Shared_volume& volume) {
  check_nifti_header(path);
  const Nifti_header header(path);
  const Lattice_3<Kernel> lattice = header.lattice();
  // The interleaved numbers run fastest, then x, y, z, the time, and other components.
  const std::size_t nodes = lattice.number_of_nodes(), type = header.sample_type(), size = size_of_sample(type),
                    times = header.size(4), side_by_side = header.numbers_side_by_side();
  const std::size_t components = side_by_side * header.size(5) * header.size(6) * header.size(7);
  const std::size_t time = chosen_time(path, selection, times),
                    component = chosen_component(path, selection, components);
  const std::size_t first = (component / side_by_side * times + time) * nodes * side_by_side * size;
  if (where == Samples_in::FILE)
    if (auto data = find_raw_data(path, Volume_format::NIFTI, type, nodes * times * components)) {
      data->first += first;
      return volume.refer_to(lattice, type, *data);
    }
  std::vector<char> bytes(nodes * side_by_side * size);
  if (!read_decompressed(path, header.first_byte() + first, bytes.size(), bytes.data())) fail_to_read_volume_data(path);
  if (header.is_swapped()) reverse_bytes_of_each(bytes, size);
  const auto scaling = header.scaling();
  if (!scaling)
    return copy_samples(type, bytes.data(), component % side_by_side, side_by_side, nodes,
                        volume.allocate(lattice, type));
  const auto [slope, intercept] = *scaling;
  auto* const values = static_cast<double*>(volume.allocate(lattice, floating_sample_type(sizeof(double))));
  with_sample_type(type, [&](auto number) {
    const auto* const samples = reinterpret_cast<const decltype(number)*>(bytes.data()) + component % side_by_side;
    for (std::size_t n = 0; n < nodes; ++n) values[n] = slope * double(samples[n * side_by_side]) + intercept;
  });
}

} // namespace equiaffine
