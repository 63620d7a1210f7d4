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
/// `Input_error` with the name of the field for invalid contents.
class Nifti_header {
public:
  explicit Nifti_header(const std::string& path);

  /// Whether the byte order of the file is not that of this computer.
  bool is_swapped() const { return is_swapped_; }

  /// The number of nodes along an axis from 1 to 7; 1 for missing axes.
  std::size_t size(std::size_t axis) const;

  /// The position in raw_types of the sample type.
  std::size_t sample_type() const;

  /// The number of interleaved numbers per node: 3 or 4 of a color, 2 of a complex number, otherwise 1.
  std::size_t numbers_side_by_side() const;

  /// The offset of the first number in the decompressed file.
  std::size_t first_byte() const;

  /// The bytes from the beginning of the file to the end of the data.
  double size_of_file() const;

  /// Slope and intercept, if the values are not the stored numbers.
  std::optional<std::array<double, 2>> scaling() const;

  /// The lattice in ITK's frame, in millimeters: from the sform if there is no qform or the sform is that of the
  /// scanner, otherwise from the qform; without both, from the spacings.
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
