// SPDX-License-Identifier: GPL-3.0-or-later
// The types of samples, and samples that a child process hands to its parent.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_SHARED_VOLUME_H
#define EQUIAFFINE_PROGRAM_VOLUME_SHARED_VOLUME_H

#include "request/source_options.h"
#include "system/kernel.h"
#include "system/process.h"
#include <equiaffine/volume/Volume_3.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace equiaffine {

/// Calls f(T()), where T is the type at this position of raw_types.
template <class F>
auto with_sample_type(std::size_t type, const F& f) {
  switch (type) {
  case 0: return f(std::uint8_t());
  case 1: return f(std::int8_t());
  case 2: return f(std::uint16_t());
  case 3: return f(std::int16_t());
  case 4: return f(std::uint32_t());
  case 5: return f(std::int32_t());
  case 6: return f(std::uint64_t());
  case 7: return f(std::int64_t());
  case 8: return f(float());
  default: return f(double());
  }
}

inline std::size_t size_of_sample(std::size_t type) {
  return with_sample_type(type, [](auto number) { return sizeof number; });
}

/// Copies `count` samples of that type, from the one at `first` on every `stride`-th one.
inline void copy_samples(std::size_t type, const void* from, std::size_t first, std::size_t stride, std::size_t count,
                         void* to) {
  with_sample_type(type, [&](auto number) {
    const auto* const source = static_cast<const decltype(number)*>(from) + first;
    for (std::size_t n = 0; n < count; ++n) static_cast<decltype(number)*>(to)[n] = source[n * stride];
  });
}

/// The position in raw_types of the integers of 1, 2, 4 or 8 bytes. Throws `std::invalid_argument` for others.
constexpr std::size_t integer_sample_type(std::size_t bytes, bool is_signed) {
  switch (bytes) {
  case 1: return 0 + std::size_t(is_signed);
  case 2: return 2 + std::size_t(is_signed);
  case 4: return 4 + std::size_t(is_signed);
  case 8: return 6 + std::size_t(is_signed);
  default: throw std::invalid_argument("integers have 1, 2, 4 or 8 bytes");
  }
}

/// The position in raw_types of float, with 4 bytes, and double, with 8. Throws `std::invalid_argument` for others.
constexpr std::size_t floating_sample_type(std::size_t bytes) {
  switch (bytes) {
  case 4: return 8;
  case 8: return 9;
  default: throw std::invalid_argument("floating-point numbers have 4 or 8 bytes");
  }
}

/// Samples that a file has as they are in memory stay in the file, which then must not be cut short, or are read into
/// memory.
enum class Samples_in { FILE, MEMORY };

/// This is the place in a file where the samples of a volume lie one after the other, as they are in memory.
struct Raw_data {
  std::string path;
  std::size_t first; ///< the place of the first byte
};

/// A volume in the type of numbers of its file, in memory that a child process shares with its parent: the child
/// allocates and fills it, and the parent takes the lattice and the samples from it.
class Shared_volume {
public:
  /// Makes room for the samples of a lattice and returns the place of the first one. `type` is a position in raw_types.
  void* allocate(const Lattice_3<Kernel>& lattice, std::size_t type);

  /// Says instead that the parent finds the samples at that place of a file.
  void refer_to(const Lattice_3<Kernel>& lattice, std::size_t type, const Raw_data& data);

  Lattice_3<Kernel> lattice();

  /// The samples, where they are. A file must not be cut short as long as there is a copy of the view. Throws
  /// `Input_error` about the volume `path` if the samples are in a file and no longer there.
  Volume_view_3<Kernel> view(const std::string& path);

private:
  std::shared_ptr<Shared_memory> memory_ = std::make_shared<Shared_memory>();
};

} // namespace equiaffine

#endif
