// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Shared_volume.h"

#include "volume/sample_type.h"
#include <equiaffine/base/internal/shared/large_pages.h>
#include <equiaffine/base/internal/shared/parallel_for.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace equiaffine {

namespace {

/// What stands before the samples.
struct Header {
  Lattice_3<Kernel>::Size size;
  std::array<double, 3> origin;
  std::array<std::array<double, 3>, 3> steps;
  std::size_t type;
};

static_assert(std::is_trivially_copyable_v<Header>);

/// The samples begin at a multiple of the size of every type.
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

} // namespace

void* Shared_volume::allocate(const Lattice_3<Kernel>& lattice, std::size_t type) {
  std::byte* const bytes = memory_.allocate(size_of_header + lattice.number_of_nodes() * size_of_sample(type));
  Header header = {lattice.size(), {}, {}, type};
  for (int axis = 0; axis < 3; ++axis) {
    header.origin[std::size_t(axis)] = lattice.origin()[axis];
    for (std::size_t step = 0; step < 3; ++step) header.steps[step][std::size_t(axis)] = lattice.steps()[step][axis];
  }
  std::memcpy(bytes, &header, sizeof header);
  return bytes + size_of_header;
}

Lattice_3<Kernel> Shared_volume::lattice() { return lattice_of(header_in(memory_.data())); }

Volume_3<Kernel> Shared_volume::to_volume() {
  const std::byte* const bytes = memory_.data();
  const Header header = header_in(bytes);
  const Lattice_3<Kernel> lattice = lattice_of(header);
  Volume_3<Kernel> volume{lattice, {}};
  resize_with_large_pages(volume.values, lattice.number_of_nodes());
  with_sample_type(header.type, [&](auto number) {
    const auto* const samples = reinterpret_cast<const decltype(number)*>(bytes + size_of_header);
    const auto& [nx, ny, nz] = lattice.size();
    parallel_for<CGAL::Parallel_if_available_tag>(0, nz, [&, slab = nx * ny](std::size_t k) {
      std::transform(samples + k * slab, samples + (k + 1) * slab, volume.values.begin() + std::ptrdiff_t(k * slab),
                     [](auto sample) { return double(sample); });
    });
  });
  return volume;
}

} // namespace equiaffine
