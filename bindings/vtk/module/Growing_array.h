// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_GROWING_ARRAY_H
#define EQUIAFFINE_BINDINGS_VTK_GROWING_ARRAY_H

#include "growing_memory.h"

#include <vtkAbstractArray.h>
#include <vtkType.h>

#include <cstddef>
#include <span>
#include <utility>

namespace equiaffine {

/// Numbers that are added block by block, and finally transferred to an array of VTK. They exist only once in memory at
/// any time, whereas arrays of VTK need more than twice the memory when they grow.
template <class Number>
class Growing_array {
public:
  Growing_array() = default;
  Growing_array(Growing_array&& other) noexcept
      : numbers_(std::exchange(other.numbers_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  Growing_array& operator=(Growing_array&&) = delete;
  ~Growing_array() { free_memory(numbers_); }

  /// Appends `count` uninitialized numbers, and returns them for writing.
  std::span<Number> grow(std::size_t count) {
    numbers_ = static_cast<Number*>(resized_memory(numbers_, (size_ + count) * sizeof(Number)));
    size_ += count;
    return {numbers_ + size_ - count, count};
  }

  std::span<const Number> numbers() const { return {numbers_, size_}; }

  /// Transfers the numbers to an array.
  template <class Array>
  void move_to(Array& array) {
    if (size_ == 0) return;
    array.SetArray(std::exchange(numbers_, nullptr), vtkIdType(std::exchange(size_, 0)), 0,
                   vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
    array.SetArrayFreeFunction(&free_memory);
  }

private:
  Number* numbers_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace equiaffine

#endif
