// SPDX-License-Identifier: GPL-3.0-or-later
// The types of samples, and volumes that a child process passes to its parent.
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

/// Copies `count` samples of the type: every `stride`-th one, starting at `first`.
inline void copy_samples(std::size_t type, const void* from, std::size_t first, std::size_t stride, std::size_t count,
                         void* to) {
  with_sample_type(type, [&](auto number) {
    const auto* const source = static_cast<const decltype(number)*>(from) + first;
    for (std::size_t n = 0; n < count; ++n) static_cast<decltype(number)*>(to)[n] = source[n * stride];
  });
}

/// The position in raw_types of the integers of 1, 2, 4 or 8 bytes. Throws `std::invalid_argument` for other sizes.
constexpr std::size_t integer_sample_type(std::size_t bytes, bool is_signed) {
  switch (bytes) {
  case 1: return 0 + std::size_t(is_signed);
  case 2: return 2 + std::size_t(is_signed);
  case 4: return 4 + std::size_t(is_signed);
  case 8: return 6 + std::size_t(is_signed);
  default: throw std::invalid_argument("integers must have 1, 2, 4 or 8 bytes");
  }
}

/// The position in raw_types of float (4 bytes) or double (8 bytes). Throws `std::invalid_argument` for other sizes.
constexpr std::size_t floating_sample_type(std::size_t bytes) {
  switch (bytes) {
  case 4: return 8;
  case 8: return 9;
  default: throw std::invalid_argument("floating-point numbers must have 4 or 8 bytes");
  }
}

/// Whether samples whose layout in the file is that in memory stay in the file, which must not be truncated then, or
/// are read into memory.
enum class Samples_in { FILE, MEMORY };

/// The position in a file where the samples of a volume are contiguous, with the layout of memory.
struct Raw_data {
  std::string path;
  std::size_t first; ///< the offset of the first byte
};

/// A volume with the sample type of its file, in shared memory: a child process allocates and fills it, and its parent
/// reads the lattice and the samples.
class Shared_volume {
public:
  /// Allocates the samples of a lattice, and returns the address of the first one. `type` is a position in raw_types.
  void* allocate(const Lattice_3<Kernel>& lattice, std::size_t type);

  /// Stores a reference to samples in a file instead.
  void refer_to(const Lattice_3<Kernel>& lattice, std::size_t type, const Raw_data& data);

  Lattice_3<Kernel> lattice();

  /// A view of the samples. A file with samples must not be truncated during the lifetime of the view and its copies.
  /// Throws `Input_error` about the volume `path` if the file no longer contains the samples.
  Volume_view_3<Kernel> view(const std::string& path);

private:
  std::shared_ptr<Shared_memory> memory_ = std::make_shared<Shared_memory>();
};

} // namespace equiaffine

#endif
