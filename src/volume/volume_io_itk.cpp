// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/Temporary_folder.h"
#include "volume/header_checks.h"
#include "volume/raw_data.h"
#include "volume/sample_type.h"
#include "volume/volume_formats.h"
#include <equiaffine/Input_error.h>

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImage.h>
#include <itkImageSeriesReader.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

namespace {

using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;

/// The largest distance of a written node from its true place, in shortest steps.
constexpr double largest_shift_in_cells = 1e-3;

/// The largest relative deviation of the distance of two DICOM slices from the mean: places are rounded decimals.
constexpr double largest_deviation_of_slices = 1e-2;

constexpr const char* could_not_be_stored =
    "not everything could be stored; make room on the disk or choose another one";

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

/// The text of an ITK exception, without the places in ITK and the libraries below it where it was found: the last
/// line, after "): " and after "[library] function: ". The text is empty for "Reason: ", with which MetaImage
/// introduces the last error of the system, whatever that was about.
std::string reason_of(const itk::ExceptionObject& exception) {
  std::string text = exception.GetDescription();
  text.erase(text.find_last_not_of(" .\n") + 1);
  text.erase(0, text.rfind('\n') + 1);
  if (const std::size_t end = text.rfind("): "); end != std::string::npos) text.erase(0, end + 3);
  if (text.starts_with('[')) text.erase(0, text.find(": ") + 2);
  return text.starts_with("Reason: ") ? "" : " (" + text + ')';
}

void check_scalars(const std::string& path, const itk::ImageIOBase& io) {
  if (io.GetNumberOfComponents() != 1)
    fail_to_read_volume(path, "it has " + std::to_string(io.GetNumberOfComponents()) + " numbers per node",
                        "extract one of them to a file first");
  const unsigned dimension = io.GetNumberOfDimensions();
  bool is_volume = dimension >= 3;
  for (unsigned axis = 3; axis < dimension; ++axis) is_volume = is_volume && io.GetDimensions(axis) == 1;
  if (!is_volume)
    fail_to_read_volume(path, "it has " + std::to_string(dimension) + " axes",
                        dimension < 3 ? "a volume needs 3" : "extract one volume to a file first");
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

/// The name by which ITK reads a file. Its NIfTI library takes `a.nii` for `a.nii.gz` where both are there, so that the
/// latter gets a link in a folder of its own.
class Name_for_ITK {
public:
  Name_for_ITK(const std::string& path, Volume_format format) : name_(path) {
    namespace fs = std::filesystem;
    const std::string_view compressed = ".gz";
    if (format != Volume_format::NIFTI || !path.ends_with(compressed) ||
        !fs::exists(path.substr(0, path.size() - compressed.size())))
      return;
    folder_.emplace(fs::temp_directory_path());
    const fs::path link = folder_->path() / "volume.nii.gz";
    fs::create_symlink(fs::absolute(path), link);
    name_ = link.string();
  }

  const std::string& operator()() const { return name_; }

private:
  std::optional<Temporary_folder> folder_;
  std::string name_;
};

} // namespace

void read_itk_volume(const std::string& path, Volume_format format, Samples_in where, Shared_volume& volume) {
  if (format == Volume_format::NIFTI) check_nifti_header(path);
  if (format == Volume_format::META) check_meta_header(path);
  const Captured_standard_error standard_error;
  const itk::ImageIOBase::Pointer io = make_image_io(format);
  const Name_for_ITK name(path, format);
  io->SetFileName(name());
  try {
    io->ReadImageInformation();
  } catch (const itk::ExceptionObject& exception) {
    fail_to_read_volume(path, "its header is not understood" + reason_of(exception),
                        "check that the extension is right and the file complete");
  }
  check_scalars(path, *io);
  const std::size_t type = sample_type_of(path, *io);
  const Lattice_3<Kernel> lattice = lattice_of(path, *io, size_of_sample(type));
  if (where == Samples_in::FILE)
    if (const auto data = find_raw_data(path, format, type, lattice.number_of_nodes()))
      return volume.refer_to(lattice, type, *data);
  io->SetIORegion(whole_region(*io));
  try {
    io->Read(volume.allocate(lattice, type));
    // ITK 5.2 reports MetaImage data that end early or do not decompress on standard error only.
    const std::string report = standard_error.text();
    if (report.find("not read completely") != std::string::npos ||
        report.find("Uncompress failed") != std::string::npos)
      fail_to_read_volume_data(path);
  } catch (const itk::ExceptionObject&) {
    fail_to_read_volume_data(path);
  }
}

void read_dicom_series(const std::string& folder, Shared_volume& volume) {
  using Image = itk::Image<double, 3>;
  const Captured_standard_error standard_error;
  try {
    const itk::GDCMSeriesFileNames::Pointer names = itk::GDCMSeriesFileNames::New();
    names->SetUseSeriesDetails(true);
    names->SetDirectory(folder);
    const std::size_t count = names->GetSeriesUIDs().size();
    if (count != 1)
      fail_to_read_volume(folder, "the folder holds " + std::to_string(count) + " DICOM series",
                          count == 0 ? "name a folder with DICOM files or a volume file"
                                     : "move the files of one series to a folder of their own");
    const itk::ImageSeriesReader<Image>::Pointer reader = itk::ImageSeriesReader<Image>::New();
    const itk::GDCMImageIO::Pointer io = itk::GDCMImageIO::New();
    const std::vector<std::string>& files = names->GetInputFileNames();
    io->SetFileName(files.front());
    io->ReadImageInformation();
    const std::size_t frames = io->GetNumberOfDimensions() > 2 ? io->GetDimensions(2) : 1;
    admit_nodes(folder, {io->GetDimensions(0), io->GetDimensions(1), frames * files.size()});
    reader->SetImageIO(io);
    reader->SetFileNames(files);
    reader->ForceOrthogonalDirectionOff();
    reader->Update();
    check_scalars(folder, *io);
    const Image& image = *reader->GetOutput();
    double deviation = 0;
    itk::ExposeMetaData(image.GetMetaDataDictionary(), "ITK_non_uniform_sampling_deviation", deviation);
    if (deviation > largest_deviation_of_slices * image.GetSpacing()[2])
      fail_to_read_volume(folder, "its slices are not evenly spaced", "add the missing ones or resample it first");
    std::array<Vector_3, 3> steps;
    for (unsigned axis = 0; axis < 3; ++axis)
      steps[axis] = image.GetSpacing()[axis] * Vector_3(image.GetDirection()(0, axis), image.GetDirection()(1, axis),
                                                        image.GetDirection()(2, axis));
    const auto size = image.GetLargestPossibleRegion().GetSize();
    const auto origin = image.GetOrigin();
    const Lattice_3<Kernel> lattice =
        make_lattice(folder, {size[0], size[1], size[2]}, Point_3(origin[0], origin[1], origin[2]), steps);
    std::memcpy(volume.allocate(lattice, floating_sample_type(sizeof(double))), image.GetBufferPointer(),
                lattice.number_of_nodes() * sizeof(double));
  } catch (const itk::ExceptionObject& exception) {
    fail_to_read_volume(folder, "a file of the series is not understood" + reason_of(exception),
                        "get the complete series again or convert it");
  }
}

namespace {

/// Reads back a file that was written, for two reasons. ITK does not notice a disk that fills up under MetaImage or
/// NIfTI, and some formats cannot hold every lattice (NIfTI holds perpendicular steps only, in single precision).
void check_written(const std::string& path, Volume_format format, const Lattice_3<Kernel>& lattice) {
  const Lattice_3<Kernel> stored = [&] {
    try {
      Shared_volume volume;
      read_itk_volume(path, format, Samples_in::FILE, volume);
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
    throw Input_error("the format cannot hold this grid, its nodes would move by up to " + std::to_string(distance) +
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
