// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of single files, in whose source it is defined, and of DICOM series ask of ITK.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_ITK_IMAGE_H
#define EQUIAFFINE_PROGRAM_VOLUME_ITK_IMAGE_H

#include <itkImageIOBase.h>

#include <cstddef>
#include <string>

namespace equiaffine {

/// The text of an ITK exception in parentheses, without the places in ITK and the libraries below it where it was
/// found: the last line, after "): " and after "[library] function: ". The text is empty for "Reason: ", with which
/// MetaImage introduces the last error of the system, whatever that was about.
std::string reason_of(const itk::ExceptionObject& exception);

/// All nodes of an image.
itk::ImageIORegion whole_region(const itk::ImageIOBase& io);

/// The position in raw_types of the type of an image. Throws `Input_error` for others.
std::size_t sample_type_of(const std::string& path, const itk::ImageIOBase& io);

} // namespace equiaffine

#endif
