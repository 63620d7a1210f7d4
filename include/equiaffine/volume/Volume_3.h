// SPDX-License-Identifier: GPL-3.0-or-later
// Sampled functions: a volume with its values, a view of samples that lie elsewhere, and a volume in parts.
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

/// A volume whose samples stay where they are, in the type of numbers that they have: integers and floating-point
/// numbers of any size, with any distance between neighbors. They are converted when they are asked for, a line or a
/// block at a time. A NaN marks a node without a value.
///
///     std::vector<std::uint16_t> samples = ...; // i fastest
///     Sampled_function_traits_3<Kernel> f(Volume_view_3<Kernel>(lattice, samples.data()));
///
/// The samples must neither change nor move while a view of them, or a function that was made of one, is in use. Copies
/// share them. Const members may be called from many threads at once.
template <class Kernel>
class Volume_view_3 {
public:
  using FT = typename Kernel::FT;                ///< the number type of the kernel, to which samples are converted
  using Lattice = Lattice_3<Kernel>;             ///< the type of the lattice
  using Node = std::array<std::size_t, 3>;       ///< i, j, k
  using Strides = std::array<std::ptrdiff_t, 3>; ///< distances in bytes

  /// Blocks of so many planes use up what the memory hands out at once where k is fastest: 64 bytes are 16 floats.
  static constexpr std::size_t planes_at_once = 16;

  /// Views samples that lie one after the other, i fastest. If there is an `owner`, it is kept as long as the view.
  template <class Number>
  Volume_view_3(const Lattice& lattice, const Number* samples, std::shared_ptr<const void> owner = nullptr)
      : Volume_view_3(lattice, samples, packed_strides(lattice.size(), sizeof(Number)), std::move(owner)) {}

  /// Views samples whose neighbors along each axis lie `strides` apart. Strides may be negative, and need not be
  /// multiples of the size of a number.
  template <class Number>
  Volume_view_3(const Lattice& lattice, const Number* samples, const Strides& strides,
                std::shared_ptr<const void> owner = nullptr)
      : lattice_(lattice), first_(reinterpret_cast<const std::byte*>(samples)), strides_(strides),
        convert_(&convert<Number>), owner_(std::move(owner)), cells_(cells_of(lattice.size())) {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>); // a byte may be no bool
  }

  /// Views samples of a part of a volume: those at the nodes of some cells of the lattice, of which the first is at
  /// `samples`. The others are not known, and nothing may be asked for there. \throw std::invalid_argument unless the
  /// lattice has the cells
  template <class Number>
  static Volume_view_3 part(const Lattice& lattice, const Cell_block& cells, const Number* samples,
                            const Strides& strides, std::shared_ptr<const void> owner = nullptr) {
    for (std::size_t a = 0; a < 3; ++a)
      check_argument(cells.first[a] < cells.end[a] && cells.end[a] < lattice.size()[a],
                     "a part of a volume has no cells, or has some beyond its lattice: choose cells of the lattice");
    Volume_view_3 view(lattice, samples, strides, std::move(owner));
    view.cells_ = cells;
    for (std::size_t a = 0; a < 3; ++a) view.to_first_ += std::ptrdiff_t(cells.first[a]) * strides[a];
    return view;
  }

  /// Views the values of a volume, which must outlive the view. \throw std::invalid_argument unless there are as many
  /// of them as nodes
  static Volume_view_3 of(const Volume_3<Kernel>& volume) {
    check_argument(volume.values.size() == volume.lattice.number_of_nodes(),
                   "a volume has not as many values as its lattice has nodes: choose the lattice that it has");
    return Volume_view_3(volume.lattice, volume.values.data());
  }
  static Volume_view_3 of(Volume_3<Kernel>&&) = delete;

  /// Takes a volume over. \throw std::invalid_argument unless there are as many values as nodes
  Volume_view_3(Volume_3<Kernel> volume) // NOLINT(google-explicit-constructor): a volume is a view of its own values
      : Volume_view_3(std::make_shared<const Volume_3<Kernel>>(std::move(volume))) {}

  /// The same samples in another kernel with numbers of the same type.
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
  /// Whether some samples are not known.
  bool is_part() const { return cells_ != cells_of(lattice_.size()); }

  /// The sample at node (i, j, k).
  FT operator()(std::size_t i, std::size_t j, std::size_t k) const {
    FT sample;
    convert_(at({i, j, k}), 0, 1, &sample);
    return sample;
  }

  /// Copies the samples at a node and those that follow it along an axis, as many as there is room for.
  void copy_line(const Node& first, std::size_t axis, std::span<FT> out) const {
    convert_(at(first), strides_[axis], out.size(), out.data());
  }

  /// Copies the samples at a node and those before it along an axis, as many as there is room for.
  void copy_line_backwards(const Node& last, std::size_t axis, std::span<FT> out) const {
    convert_(at(last), -strides_[axis], out.size(), out.data());
  }

  /// Copies the samples at the nodes of a block of that size, i fastest. It goes through the memory of the samples in
  /// their order there.
  void copy_block(const Node& first, const Node& size, std::span<FT> out) const {
    const auto distance = [&](std::size_t axis) { return strides_[axis] < 0 ? -strides_[axis] : strides_[axis]; };
    std::size_t line = 0; // the axis along which neighbors are nearest
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

  /// Copies all samples. \pre no part of them is unknown
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
    constexpr std::size_t width = sizeof(Number), at_once = 16; // so many at a time the compiler converts in packs
    std::array<Number, at_once> numbers;                        // a copy, as samples may not be aligned
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

  /// Prefetches what lies some strides ahead: where short lines are far apart, the processor does not do that by
  /// itself.
  static void fetch_ahead([[maybe_unused]] const std::byte* here, [[maybe_unused]] std::ptrdiff_t stride) {
#ifdef __GNUC__
    constexpr std::ptrdiff_t lines = 12;
    const auto place = reinterpret_cast<std::uintptr_t>(here) + std::uintptr_t(lines * stride); // may be no sample
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
  void (*convert_)(const std::byte*, std::ptrdiff_t, std::size_t, FT*); // knows the type of the numbers
  std::shared_ptr<const void> owner_;
  Cell_block cells_;
  std::ptrdiff_t to_first_ = 0; // from node (0, 0, 0), which may not be known, to the first one that is
};

/// The parts of a volume that are known here, and how numbers are exchanged with the processes that know the other
/// parts. All processes call the same algorithms with their parts, and get the same results, bit for bit, however the
/// volume is cut.
template <class Kernel>
struct Volume_parts_3 {
  /// The samples of a part and around it, of which some cells belong to that part and to no other in any process.
  struct Part {
    Volume_view_3<Kernel> volume; ///< see Volume_view_3::part()
    Cell_block cells;             ///< that belong to it
  };
  using Numbers = std::vector<double>; ///< what a process sends to the others

  Lattice_3<Kernel> lattice; ///< of the whole volume
  std::vector<Part> parts;   ///< those of this process; there may be none
  /// Gathers the numbers of all processes, given those of this one: one process after the other, in the same order in
  /// all of them.
  std::function<Numbers(Numbers)> gather = [](Numbers numbers) { return numbers; };

  /// The one part of a whole volume. \pre no part of it is unknown
  static Volume_parts_3 of(const Volume_view_3<Kernel>& volume) {
    CGAL_precondition(!volume.is_part());
    return {volume.lattice(), {{volume, volume.cells()}}};
  }
};

} // namespace equiaffine

#endif
