// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/itk_image.h"
#include "volume/sample_type.h"
#include "volume/volume_formats.h"

namespace equiaffine {

std::string reason_of(const itk::ExceptionObject& exception) {
  std::string text = exception.GetDescription();
  text.erase(text.find_last_not_of(" .\n") + 1);
  text.erase(0, text.rfind('\n') + 1);
  if (const std::size_t end = text.rfind("): "); end != std::string::npos) text.erase(0, end + 3);
  if (text.starts_with('[')) text.erase(0, text.find(": ") + 2);
  return text.starts_with("Reason: ") ? "" : " (" + text + ')';
}

itk::ImageIORegion whole_region(const itk::ImageIOBase& io) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) region.SetSize(axis, io.GetDimensions(axis));
  return region;
}

std::size_t sample_type_of(const std::string& path, const itk::ImageIOBase& io) {
  using Type = itk::IOComponentEnum;
  const auto bytes = std::size_t(io.GetComponentSize());
  switch (io.GetComponentType()) {
  case Type::FLOAT:
  case Type::DOUBLE: return floating_sample_type(bytes);
  case Type::UCHAR:
  case Type::USHORT:
  case Type::UINT:
  case Type::ULONG:
  case Type::ULONGLONG: return integer_sample_type(bytes, false);
  case Type::CHAR:
  case Type::SHORT:
  case Type::INT:
  case Type::LONG:
  case Type::LONGLONG: return integer_sample_type(bytes, true);
  default: fail_to_read_volume_type(path);
  }
}

} // namespace equiaffine
