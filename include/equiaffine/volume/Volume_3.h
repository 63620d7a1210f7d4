// SPDX-License-Identifier: GPL-3.0-or-later
// Sampled functions: a volume that owns its values, a view of samples stored elsewhere, and a volume in parts.
#ifndef EQUIAFFINE_VOLUME_VOLUME_3_H
#define EQUIAFFINE_VOLUME_VOLUME_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Lattice_3.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine {

/// A sampled function: one value per node of a lattice, stored with i fastest. A NaN marks a node without a value.
template <class Kernel>
struct Volume_3 {
  Lattice_3<Kernel> lattice;               ///< where the nodes are
  std::vector<typename Kernel::FT> values; ///< one per node, i fastest

  /// The value at node (i, j, k).
  const typename Kernel::FT& operator()(std::size_t i, std::size_t j, std::size_t k) const {
    return values[lattice.index(i, j, k)];
  }
};

/// A view of samples in their own number type (integers or floating-point numbers of any size) and with any strides.
/// Samples are converted on access, a line or a block at a time. A NaN marks a node without a value.
///
///     std::vector<std::uint16_t> samples = ...; // i fastest
///     Sampled_function_traits_3<Kernel> f(Volume_view_3<Kernel>(lattice, samples.data()));
///
/// The samples must neither change nor move while a view of them, or a function made from a view, is in use. Copies
/// share them. Const members are thread-safe.
template <class Kernel>
class Volume_view_3 {
public:
  using FT = typename Kernel::FT;                ///< the number type of the kernel, to which samples are converted
  using Lattice = Lattice_3<Kernel>;             ///< the type of the lattice
  using Node = std::array<std::size_t, 3>;       ///< i, j, k
  using Strides = std::array<std::ptrdiff_t, 3>; ///< distances in bytes

  /// The number of planes that are read together: where k is fastest, 16 floats fill a cache line of 64 bytes.
  static constexpr std::size_t planes_at_once = 16;

  /// Views contiguous samples, i fastest. The view keeps `owner` alive.
  template <class Number>
  Volume_view_3(const Lattice& lattice, const Number* samples, std::shared_ptr<const void> owner = nullptr)
      : Volume_view_3(lattice, samples, packed_strides(lattice.size(), sizeof(Number)), std::move(owner)) {}

  /// Views samples whose neighbors along each axis are `strides` bytes apart. Strides may be negative and need not be
  /// multiples of the size of a number.
  template <class Number>
  Volume_view_3(const Lattice& lattice, const Number* samples, const Strides& strides,
                std::shared_ptr<const void> owner = nullptr)
      : lattice_(lattice), first_(reinterpret_cast<const std::byte*>(samples)), strides_(strides),
        convert_(&convert<Number>), owner_(std::move(owner)), cells_(cells_of(lattice.size())) {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>); // not every byte is a valid bool
  }

  /// Views the samples of a part of a volume, at the nodes of some cells of the lattice; `samples` points to the
  /// first one. The other samples are unknown and must not be accessed. \throw std::invalid_argument unless the cells
  /// are a non-empty block of the lattice
  template <class Number>
  static Volume_view_3 part(const Lattice& lattice, const Cell_block& cells, const Number* samples,
                            const Strides& strides, std::shared_ptr<const void> owner = nullptr) {
    for (std::size_t a = 0; a < 3; ++a)
      check_argument(cells.first[a] < cells.end[a] && cells.end[a] < lattice.size()[a],
                     "a part of a volume has no cells or extends beyond its lattice: choose cells of the lattice");
    Volume_view_3 view(lattice, samples, strides, std::move(owner));
    view.cells_ = cells;
    for (std::size_t a = 0; a < 3; ++a) view.to_first_ += std::ptrdiff_t(cells.first[a]) * strides[a];
    return view;
  }

  /// Views the values of a volume, which must outlive the view. \throw std::invalid_argument unless there is one
  /// value per node
  static Volume_view_3 of(const Volume_3<Kernel>& volume) {
    check_argument(volume.values.size() == volume.lattice.number_of_nodes(),
                   "the number of values of a volume differs from the number of nodes of its lattice: correct one");
    return Volume_view_3(volume.lattice, volume.values.data());
  }
  static Volume_view_3 of(Volume_3<Kernel>&&) = delete;

  /// Takes ownership of a volume. \throw std::invalid_argument unless there is one value per node
  Volume_view_3(Volume_3<Kernel> volume) // NOLINT(google-explicit-constructor): a volume is a view of its own values
      : Volume_view_3(std::make_shared<const Volume_3<Kernel>>(std::move(volume))) {}

  /// The same samples in another kernel with the same number type.
  template <class Other>
  explicit Volume_view_3(const Volume_view_3<Other>& other) requires std::is_same_v<typename Other::FT, FT>
      : lattice_(other.lattice_),
        first_(other.first_),
        strides_(other.strides_),
        convert_(other.convert_),
        owner_(other.owner_),
        cells_(other.cells_),
        to_first_(other.to_first_) {}

  const Lattice& lattice() const { return lattice_; } ///< where the samples are
  const Cell_block& cells() const { return cells_; }  ///< the cells at whose nodes samples are known: see part()
  /// Whether some samples are unknown.
  bool is_part() const { return cells_ != cells_of(lattice_.size()); }

  /// The sample at node (i, j, k).
  FT operator()(std::size_t i, std::size_t j, std::size_t k) const {
    FT sample;
    convert_(at({i, j, k}), 0, 1, &sample);
    return sample;
  }

  /// Copies out.size() samples, from the one at `first` onward along an axis.
  void copy_line(const Node& first, std::size_t axis, std::span<FT> out) const {
    convert_(at(first), strides_[axis], out.size(), out.data());
  }

  /// Copies out.size() samples, from the one at `last` backward along an axis.
  void copy_line_backwards(const Node& last, std::size_t axis, std::span<FT> out) const {
    convert_(at(last), -strides_[axis], out.size(), out.data());
  }

  /// Copies the samples at the nodes of a block of the given size, i fastest. Reads the samples in the order of their
  /// memory.
  void copy_block(const Node& first, const Node& size, std::span<FT> out) const {
    const auto distance = [&](std::size_t axis) { return strides_[axis] < 0 ? -strides_[axis] : strides_[axis]; };
    std::size_t line = 0; // the axis with the smallest stride
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (distance(axis) < distance(line)) line = axis;
    const Node steps = {1, size[0], size[0] * size[1]};
    const std::size_t inner = (line + 1) % 3, outer = (line + 2) % 3;
    std::vector<FT> samples(line == 0 ? 0 : size[line]);
    Node node;
    for (std::size_t b = 0; b < size[outer]; ++b)
      for (std::size_t a = 0; a < size[inner]; ++a) {
        node[line] = first[line];
        node[inner] = first[inner] + a;
        node[outer] = first[outer] + b;
        fetch_ahead(at(node), line == 0 ? 0 : strides_[inner]);
        FT* const to = out.data() + a * steps[inner] + b * steps[outer];
        convert_(at(node), strides_[line], size[line], line == 0 ? to : samples.data());
        for (std::size_t n = 0; n < samples.size(); ++n) to[n * steps[line]] = samples[n];
      }
  }

  /// Copies all samples. \pre all are known
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Volume_3<Kernel> to_volume() const {
    CGAL_precondition(!is_part());
    Volume_3<Kernel> result{lattice_, {}};
    resize_with_large_pages(result.values, lattice_.number_of_nodes());
    const std::size_t nx = lattice_.size()[0], ny = lattice_.size()[1], nz = lattice_.size()[2];
    parallel_for<ConcurrencyTag>(0, (nz + planes_at_once - 1) / planes_at_once, [&](std::size_t n) {
      const std::size_t k = n * planes_at_once, planes = std::min(planes_at_once, nz - k);
      copy_block({0, 0, k}, {nx, ny, planes}, std::span(result.values).subspan(k * nx * ny, planes * nx * ny));
    });
    return result;
  }

private:
  template <class>
  friend class Volume_view_3;

  explicit Volume_view_3(std::shared_ptr<const Volume_3<Kernel>> volume) : Volume_view_3(of(*volume)) {
    owner_ = std::move(volume);
  }

  static Strides packed_strides(const Node& size, std::size_t width) {
    const auto step = std::ptrdiff_t(width), row = step * std::ptrdiff_t(size[0]);
    return {step, row, row * std::ptrdiff_t(size[1])};
  }

  template <class Number>
  static void convert(const std::byte* first, std::ptrdiff_t stride, std::size_t count, FT* out) {
    constexpr std::size_t width = sizeof(Number), at_once = 16; // enough for the compiler to vectorize the conversion
    std::array<Number, at_once> numbers;                        // a copy, because samples may not be aligned
    std::size_t n = 0;
    if (stride == std::ptrdiff_t(width))
      for (; n + at_once <= count; n += at_once) {
        std::memcpy(numbers.data(), first + n * width, sizeof numbers);
        for (std::size_t i = 0; i < at_once; ++i) out[n + i] = FT(numbers[i]);
      }
    for (; n < count; ++n) {
      std::memcpy(numbers.data(), first + std::ptrdiff_t(n) * stride, width);
      out[n] = FT(numbers[0]);
    }
  }

  /// Prefetches the memory some strides ahead: the processor does not do so by itself if short lines are far apart.
  static void fetch_ahead([[maybe_unused]] const std::byte* here, [[maybe_unused]] std::ptrdiff_t stride) {
#ifdef __GNUC__
    constexpr std::ptrdiff_t lines = 12;
    const auto place = reinterpret_cast<std::uintptr_t>(here) + std::uintptr_t(lines * stride); // may be out of range
    __builtin_prefetch(reinterpret_cast<const void*>(place));
#endif
  }

  const std::byte* at(const Node& n) const {
    return first_ + (std::ptrdiff_t(n[0]) * strides_[0] + std::ptrdiff_t(n[1]) * strides_[1] +
                     std::ptrdiff_t(n[2]) * strides_[2] - to_first_);
  }

  Lattice lattice_;
  const std::byte* first_;
  Strides strides_;
  void (*convert_)(const std::byte*, std::ptrdiff_t, std::size_t, FT*); // for the type of the samples
  std::shared_ptr<const void> owner_;
  Cell_block cells_;
  std::ptrdiff_t to_first_ = 0; // from node (0, 0, 0) to the first known node
};

/// The parts of a volume that this process has, and how it exchanges numbers with the processes that have the other
/// parts. All processes call the same algorithms with their own parts and get the same results, bit for bit, for
/// every partition of the volume.
template <class Kernel>
struct Volume_parts_3 {
  /// The samples of a part and around it, and the cells that belong to this part and to no other in any process.
  struct Part {
    Volume_view_3<Kernel> volume; ///< see Volume_view_3::part()
    Cell_block cells;             ///< the cells that belong to the part
  };
  using Numbers = std::vector<double>; ///< the message of a process to the others

  Lattice_3<Kernel> lattice; ///< of the whole volume
  std::vector<Part> parts;   ///< those of this process; may be empty
  /// Given the numbers of this process, returns those of all processes, concatenated in an order that is the same in
  /// all of them.
  std::function<Numbers(Numbers)> gather = [](Numbers numbers) { return numbers; };

  /// The single part of a whole volume. \pre all samples are known
  static Volume_parts_3 of(const Volume_view_3<Kernel>& volume) {
    CGAL_precondition(!volume.is_part());
    return {volume.lattice(), {{volume, volume.cells()}}};
  }
};

} // namespace equiaffine

#endif
