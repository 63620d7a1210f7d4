// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_DICOM_FRAME_H
#define EQUIAFFINE_PROGRAM_VOLUME_DICOM_FRAME_H

#include "system/kernel.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// A slice of a volume: a file of a series, or one of the frames of a file.
struct Dicom_frame {
  std::string file;  ///< its path
  std::size_t index; ///< among the frames of the file
  std::string name;  ///< 'slice.dcm', or frame 3 of 'volume.dcm'
  std::array<std::size_t, 2> size;
  Kernel::Point_3 position;                     ///< of the first pixel, in millimeters
  std::array<Kernel::Vector_3, 2> steps;        ///< to the next pixel of the row, and of the column
  std::optional<std::array<double, 2>> scaling; ///< slope and intercept, if frames have their own
};

/// What the header of a file with an image says.
struct Dicom_header {
  std::string series; ///< the identifier of the series that the file belongs to
  std::vector<Dicom_frame> frames;
};

/// Reads the header of a file in DICOM's format; returns nothing for a file in another one, or without an image. The volume
/// `path` is for messages. Throws `Input_error` for a damaged header, and if it does not say where its frames lie.
std::optional<Dicom_header> read_dicom_header(const std::string& path, const std::string& file);

} // namespace equiaffine

#endif
