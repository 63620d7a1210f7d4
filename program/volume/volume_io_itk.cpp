// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"
#include <equiaffine/base/Input_error.h>

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

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

namespace {

using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;

/// The maximum distance of a written node from its true position, relative to the shortest step.
constexpr double largest_shift_in_cells = 1e-3;

constexpr const char* could_not_be_stored =
    "not everything could be stored; free space on the disk or choose another one";

double length_of(const Vector_3& v) { return std::hypot(v.x(), v.y(), v.z()); }

itk::ImageIOBase::Pointer make_image_io(Volume_format format) {
  switch (format) {
  case Volume_format::NRRD: return itk::NrrdImageIO::New().GetPointer();
  case Volume_format::META: {
    const itk::MetaImageIO::Pointer io = itk::MetaImageIO::New();
    io->SetDoublePrecision(17);
    return io.GetPointer();
  }
  default: return itk::NiftiImageIO::New().GetPointer();
  }
}

/// The product of the sizes after the third axis.
std::size_t number_of_volumes(const std::string& path, const itk::ImageIOBase& io) {
  if (io.GetNumberOfDimensions() < 3)
    fail_to_read_volume(path, "it has " + std::to_string(io.GetNumberOfDimensions()) + " axes",
                        "give a file with 3 axes");
  constexpr double most_volumes = 1e8;
  double count = 1;
  for (unsigned axis = 3; axis < io.GetNumberOfDimensions(); ++axis) count *= double(io.GetDimensions(axis));
  if (!(count >= 1 && count <= most_volumes))
    fail_to_read_volume(path, "its sizes beyond the third axis are invalid", "correct its header");
  return std::size_t(count);
}

Lattice_3<Kernel> lattice_of(const std::string& path, const itk::ImageIOBase& io, std::size_t bytes_of_sample) {
  Lattice_3<Kernel>::Size size;
  std::array<Vector_3, 3> steps;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::vector<double> direction = io.GetDirection(axis);
    size[axis] = io.GetDimensions(axis);
    steps[axis] = io.GetSpacing(axis) * Vector_3(direction[0], direction[1], direction[2]);
  }
  return make_lattice(path, size, Point_3(io.GetOrigin(0), io.GetOrigin(1), io.GetOrigin(2)), steps, bytes_of_sample);
}

} // namespace

void read_itk_volume(const std::string& path, Volume_format format, Samples_in where, const Volume_selection& selection,
                     Shared_volume& volume) {
  if (format == Volume_format::META) check_meta_header(path);
  check_data_files(path, format, selection.allow_outside);
  const Captured_standard_error standard_error;
  const itk::ImageIOBase::Pointer io = make_image_io(format);
  io->SetFileName(path);
  try {
    io->ReadImageInformation();
  } catch (const itk::ExceptionObject& exception) {
    fail_to_read_volume(path, "its header cannot be read" + reason_of(exception),
                        "check that the extension is right and the file is complete");
  }
  const std::size_t type = sample_type_of(path, *io), components = io->GetNumberOfComponents(),
                    times = number_of_volumes(path, *io);
  const Lattice_3<Kernel> lattice = lattice_of(path, *io, size_of_sample(type));
  admit_nodes(path, lattice.size(), size_of_sample(type) * times * components);
  const std::size_t nodes = lattice.number_of_nodes(), component = chosen_component(path, selection, components),
                    time = chosen_time(path, selection, times);
  if (where == Samples_in::FILE && components == 1)
    if (auto data = find_raw_data(path, format, type, nodes * times)) {
      data->first += time * nodes * size_of_sample(type);
      return volume.refer_to(lattice, type, *data);
    }
  io->SetIORegion(whole_region(*io));
  const bool is_all = components * times == 1;
  std::vector<char> all;
  if (!is_all) {
    admit_nodes(path, {lattice.size()[0], lattice.size()[1], lattice.size()[2] * times * components},
                size_of_sample(type));
    all.resize(nodes * times * components * size_of_sample(type));
  }
  void* const samples = volume.allocate(lattice, type);
  try {
    io->Read(is_all ? samples : all.data());
    // ITK 5.2 reports MetaImage data that are truncated or cannot be decompressed only on standard error.
    const std::string report = standard_error.text();
    if (report.find("not read completely") != std::string::npos ||
        report.find("Uncompress failed") != std::string::npos)
      fail_to_read_volume_data(path);
  } catch (const itk::ExceptionObject&) {
    fail_to_read_volume_data(path);
  }
  if (!is_all) copy_samples(type, all.data(), time * nodes * components + component, components, nodes, samples);
}

namespace {

/// Reads back a written file, for two reasons: ITK does not detect a full disk for MetaImage and NIfTI, and some
/// formats cannot store every lattice (NIfTI stores only orthogonal steps, in single precision).
void check_written(const std::string& path, Volume_format format, const Lattice_3<Kernel>& lattice) {
  const Lattice_3<Kernel> stored = [&] {
    try {
      Shared_volume volume;
      if (format == Volume_format::NIFTI) read_nifti_volume(path, Samples_in::FILE, {}, volume);
      else read_itk_volume(path, format, Samples_in::FILE, {}, volume);
      return volume.lattice();
    } catch (const Input_error&) {
      throw Input_error(could_not_be_stored);
    }
  }();
  double distance = 0, shortest_step = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const double u = corner & 1 ? double(lattice.size()[0] - 1) : 0, v = corner & 2 ? double(lattice.size()[1] - 1) : 0,
                 w = corner & 4 ? double(lattice.size()[2] - 1) : 0;
    distance = std::max(distance, length_of(stored.point(u, v, w) - lattice.point(u, v, w)));
  }
  for (const Vector_3& step : lattice.steps()) shortest_step = std::min(shortest_step, length_of(step));
  if (stored.size() != lattice.size() || !(distance <= largest_shift_in_cells * shortest_step))
    throw Input_error("the format cannot store this grid: its nodes would move by up to " + std::to_string(distance) +
                      "; write .nrrd or .mha");
}

void write_through_itk(const std::string& path, Volume_format format, const Volume_3<Kernel>& volume, bool as_float) {
  const Captured_standard_error standard_error;
  const Lattice_3<Kernel>& lattice = volume.lattice;
  const itk::ImageIOBase::Pointer io = make_image_io(format);
  io->SetNumberOfDimensions(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const Vector_3& step = lattice.steps()[axis];
    const double spacing = length_of(step);
    io->SetDimensions(axis, lattice.size()[axis]);
    io->SetOrigin(axis, lattice.origin()[int(axis)]);
    io->SetSpacing(axis, spacing);
    io->SetDirection(axis, std::vector<double>{step.x() / spacing, step.y() / spacing, step.z() / spacing});
  }
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetNumberOfComponents(1);
  io->SetComponentType(as_float ? itk::IOComponentEnum::FLOAT : itk::IOComponentEnum::DOUBLE);
  io->SetIORegion(whole_region(*io));
  io->SetFileName(path);
  try {
    if (as_float) io->Write(std::vector<float>(volume.values.begin(), volume.values.end()).data());
    else io->Write(volume.values.data());
  } catch (const itk::ExceptionObject&) {
    throw Input_error(could_not_be_stored);
  }
}

} // namespace

void write_itk_volume(const std::string& path, Volume_format format, const Volume_3<Kernel>& volume, bool as_float) {
  write_through_itk(path, format, volume, as_float);
  check_written(path, format, volume.lattice);
}

} // namespace equiaffine
