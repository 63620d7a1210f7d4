// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers for ITK of the readers of single files and of DICOM series; defined in volume_io_itk.cpp.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_ITK_IMAGE_H
#define EQUIAFFINE_PROGRAM_VOLUME_ITK_IMAGE_H

#include <itkImageIOBase.h>

#include <cstddef>
#include <string>

namespace equiaffine {

/// The text of an ITK exception in parentheses, without source locations: the last line, after "): " and after
/// "[library] function: ". Empty for "Reason: ", which MetaImage puts before the last error of the system, even an
/// unrelated one.
std::string reason_of(const itk::ExceptionObject& exception);

/// All nodes of an image.
itk::ImageIORegion whole_region(const itk::ImageIOBase& io);

/// The position in raw_types of the type of an image. Throws `Input_error` for other types.
std::size_t sample_type_of(const std::string& path, const itk::ImageIOBase& io);

} // namespace equiaffine

#endif
