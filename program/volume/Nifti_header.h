// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_NIFTI_HEADER_H
#define EQUIAFFINE_PROGRAM_VOLUME_NIFTI_HEADER_H

#include "system/kernel.h"
#include <equiaffine/volume/Lattice_3.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace equiaffine {

/// The header of a NIfTI-1 file, which begins with its own length in the byte order of the file. Its functions throw
/// `Input_error`, which names the field, for what cannot be.
class Nifti_header {
public:
  explicit Nifti_header(const std::string& path);

  /// Whether the bytes of numbers are in another order than those of this computer.
  bool is_swapped() const { return is_swapped_; }

  /// The nodes along an axis, from 1 to 7; 1 along those that the file does not have.
  std::size_t size(std::size_t axis) const;

  /// The position in raw_types of the type of the numbers.
  std::size_t sample_type() const;

  /// The numbers that lie side by side at a node: 3 or 4 of a color, 2 of a complex number, else 1.
  std::size_t numbers_side_by_side() const;

  /// The place of the first number in the file, decompressed.
  std::size_t first_byte() const;

  /// The bytes from the beginning of the file to the end of the data.
  double size_of_file() const;

  /// The slope and the intercept of the values as functions of the numbers, if these are not the values.
  std::optional<std::array<double, 2>> scaling() const;

  /// The place of the nodes in ITK's frame, in millimeters: that of the sform if there is no qform or the sform is the
  /// scanner's, else that of the qform; without both, steps alone.
  Lattice_3<Kernel> lattice() const;

private:
  struct Datatype;

  template <class Number>
  Number number(std::size_t place, std::size_t index = 0) const;

  bool is_single_file() const;
  Datatype datatype() const;
  std::array<std::array<double, 4>, 3> sform() const;
  std::array<std::array<double, 4>, 3> qform() const;
  [[noreturn]] void fail_at(const std::string& field, double content, const std::string& advice) const;

  std::string path_, bytes_;
  bool is_swapped_ = false;
};

} // namespace equiaffine

#endif
