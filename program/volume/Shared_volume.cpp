// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Shared_volume.h"

#include "system/file_memory.h"
#include "volume/volume_formats.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace equiaffine {

namespace {

/// The data before the samples.
struct Header {
  Lattice_3<Kernel>::Size size;
  std::array<double, 3> origin;
  std::array<std::array<double, 3>, 3> steps;
  std::size_t type;
  std::size_t length_of_path; ///< if not 0, the path of the file with the samples replaces them
  std::size_t first_in_file;
};

static_assert(std::is_trivially_copyable_v<Header>);

/// The header is padded to align samples of every type.
constexpr std::size_t size_of_header = (sizeof(Header) + 63) / 64 * 64;

Header header_in(const std::byte* bytes) {
  Header header;
  std::memcpy(&header, bytes, sizeof header);
  return header;
}

Kernel::Vector_3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Lattice_3<Kernel> lattice_of(const Header& header) {
  return {header.size,
          CGAL::ORIGIN + to_vector(header.origin),
          {to_vector(header.steps[0]), to_vector(header.steps[1]), to_vector(header.steps[2])}};
}

Header header_of(const Lattice_3<Kernel>& lattice, std::size_t type) {
  Header header = {lattice.size(), {}, {}, type, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    header.origin[std::size_t(axis)] = lattice.origin()[axis];
    for (std::size_t step = 0; step < 3; ++step) header.steps[step][std::size_t(axis)] = lattice.steps()[step][axis];
  }
  return header;
}

} // namespace

void* Shared_volume::allocate(const Lattice_3<Kernel>& lattice, std::size_t type) {
  std::byte* const bytes = memory_->allocate(size_of_header + lattice.number_of_nodes() * size_of_sample(type));
  const Header header = header_of(lattice, type);
  std::memcpy(bytes, &header, sizeof header);
  return bytes + size_of_header;
}

void Shared_volume::refer_to(const Lattice_3<Kernel>& lattice, std::size_t type, const Raw_data& data) {
  std::byte* const bytes = memory_->allocate(size_of_header + data.path.size());
  Header header = header_of(lattice, type);
  header.length_of_path = data.path.size();
  header.first_in_file = data.first;
  std::memcpy(bytes, &header, sizeof header);
  std::memcpy(bytes + size_of_header, data.path.data(), data.path.size());
}

Lattice_3<Kernel> Shared_volume::lattice() { return lattice_of(header_in(memory_->data())); }

Volume_view_3<Kernel> Shared_volume::view(const std::string& path) {
  const std::byte* samples = memory_->data();
  const Header header = header_in(samples);
  const Lattice_3<Kernel> lattice = lattice_of(header);
  samples += size_of_header;
  std::shared_ptr<const void> owner = memory_;
  if (header.length_of_path > 0) {
    const auto file =
        std::make_shared<const Mapped_file>(std::string(reinterpret_cast<const char*>(samples), header.length_of_path));
    if (file->size() < header.first_in_file + lattice.number_of_nodes() * size_of_sample(header.type))
      fail_to_read_volume(path, file->data() ? "its data file was truncated" : "its data file cannot be read",
                          file->data() ? "read it again when it is complete" : "check the permissions of the file");
    samples = file->data() + header.first_in_file;
    owner = file;
  }
  return with_sample_type(header.type, [&](auto number) {
    return Volume_view_3<Kernel>(lattice, reinterpret_cast<const decltype(number)*>(samples), owner);
  });
}

} // namespace equiaffine
