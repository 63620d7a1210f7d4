// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/volume_io.h"

#include "system/file_memory.h"
#include "system/front_end.h"
#include "system/memory_limit.h"
#include "system/process.h"
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/volume_formats.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <unistd.h>

namespace equiaffine {

namespace fs = std::filesystem;

namespace {

struct Extension {
  std::string_view text;
  Volume_format format;
  bool is_written;
};

constexpr std::array extensions = {
    Extension{".nrrd", Volume_format::NRRD, true}, Extension{".nhdr", Volume_format::NRRD, false},
    Extension{".mhd", Volume_format::META, true},  Extension{".mha", Volume_format::META, true},
    Extension{".nii", Volume_format::NIFTI, true}, Extension{".nii.gz", Volume_format::NIFTI, true},
    Extension{".inr", Volume_format::INR, false},  Extension{".inr.gz", Volume_format::INR, false},
    Extension{".vti", Volume_format::VTI, true},   Extension{".dcm", Volume_format::DICOM, false}};

/// Whether a file has the mark of DICOM, since DICOM files often have no extension.
bool is_dicom(const std::string& path) {
  constexpr std::string_view mark = "DICM";
  constexpr std::streamoff place = 128;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<char, mark.size()> word{};
  file.seekg(place).read(word.data(), word.size());
  return std::string_view(word.data(), word.size()) == mark;
}

std::optional<Extension> find_extension(const std::string& path) {
  for (const Extension& extension : extensions)
    if (has_extension(path, extension.text)) return extension;
  return is_dicom(path) ? std::optional(extensions.back()) : std::nullopt;
}

#ifdef EQUIAFFINE_WITH_ITK
constexpr bool has_itk = true;
#else
constexpr bool has_itk = false;
#endif
#ifdef EQUIAFFINE_WITH_VTK
constexpr bool has_vtk = true;
#else
constexpr bool has_vtk = false;
#endif

/// The library for a format if this program was built without it; otherwise empty.
std::string_view missing_library(Volume_format format, bool is_written) {
  if (format == Volume_format::INR || (format == Volume_format::NIFTI && !is_written)) return {};
  if (format == Volume_format::VTI) return has_vtk ? "" : "VTK";
  return has_itk ? "" : "ITK";
}

/// The extensions that this program can read, or those that it can write.
std::string known_extensions(bool written_only) {
  std::string list;
  for (const Extension& extension : extensions)
    if (missing_library(extension.format, written_only).empty() && (extension.is_written || !written_only))
      list.append(list.empty() ? "" : " ").append(extension.text);
  return list;
}

std::string built_without(std::string_view library) {
  return "this equiaffine was built without " + std::string(library);
}

[[noreturn]] void fail_to_read_volume_without(std::string_view library, const std::string& path) {
  fail_to_read_volume(path, built_without(library), "convert it to one of " + known_extensions(false));
}

std::string advice_for_writing() {
  const std::string list = known_extensions(true);
  return list.empty() ? "build it with ITK (.nrrd .mhd .mha .nii) or VTK (.vti)" : "use one of " + list;
}

Extension find_written_extension(const std::string& path) {
  const std::optional<Extension> extension = find_extension(path);
  if (!extension || !extension->is_written)
    throw Input_error(
        "cannot write the volume '" + path +
        "': " + (extension ? std::string(extension->text) + " cannot be written, only read" : "unknown extension") +
        "; " + advice_for_writing());
  if (const auto library = missing_library(extension->format, true); !library.empty())
    throw Input_error("cannot write the volume '" + path + "': " + built_without(library) + "; " +
                      advice_for_writing());
  return *extension;
}

/// The bytes of the files of a volume, or 0 if unknown.
double bytes_in_files(const std::string& path) {
  if (const std::optional<Extension> extension = find_extension(path)) return size_of_volume(path, extension->format);
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : double(size);
}

} // namespace

void fail_to_read_volume(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the volume '" + path + "': " + reason + "; " + advice);
}

void fail_to_read_volume_data(const std::string& path) {
  fail_to_read_volume(path, "the data are damaged or shorter than stated in the header", "get the complete file again");
}

void fail_to_read_volume_type(const std::string& path) {
  fail_to_read_volume(path, "its sample type is not supported", "convert it to float or double");
}

namespace {

std::size_t chosen(const std::string& path, const std::string& option, std::optional<std::size_t> number,
                   std::size_t count, const std::string& text) {
  if (!number && count == 1) return 0;
  if (number && *number <= count) return *number - 1;
  fail_to_read_volume(
      path, "it has " + std::to_string(count) + ' ' + text,
      count == 1 ? "leave out " + option_text(option)
                 : by_front_end("choose one with " + option_text(option, "N") + ", from 1 to " + std::to_string(count),
                                "give a file with only one"));
}

} // namespace

std::size_t chosen_component(const std::string& path, const Volume_selection& selection, std::size_t count) {
  return chosen(path, "component", selection.component, count, count == 1 ? "component" : "components");
}

std::size_t chosen_time(const std::string& path, const Volume_selection& selection, std::size_t count) {
  return chosen(path, "time", selection.time, count, count == 1 ? "volume" : "volumes");
}

void admit_nodes(const std::string& path, const Lattice_3<Kernel>::Size& size, std::size_t bytes_of_sample) {
  // A reader may hold the samples once or twice, at most as doubles, in addition to those in shared memory.
  constexpr double copies = 4, for_small_volumes = 1 << 28;
  const double nodes = double(size[0]) * double(size[1]) * double(size[2]);
  const std::string size_text =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
  if (*std::min_element(size.begin(), size.end()) < 2)
    fail_to_read_volume(path, "it has " + size_text + " nodes", "give a volume with at least 2 nodes along each axis");
  const double bytes = double(bytes_of_sample) * nodes;
  if (bytes > physical_memory() && bytes > bytes_in_files(path)) // otherwise they may stay in the file
    fail_to_read_volume(path, "it has " + size_text + " nodes, which do not fit into memory",
                        "check its header or crop it");
  allow_memory(copies * sizeof(double) * nodes + for_small_volumes);
}

Lattice_3<Kernel> make_lattice(const std::string& path, const Lattice_3<Kernel>::Size& size,
                               const Kernel::Point_3& origin, const std::array<Kernel::Vector_3, 3>& steps,
                               std::size_t bytes_of_sample) {
  admit_nodes(path, size, bytes_of_sample);
  const double determinant = CGAL::determinant(steps[0], steps[1], steps[2]);
  const bool is_finite =
      std::isfinite(determinant) && std::isfinite(origin.x()) && std::isfinite(origin.y()) && std::isfinite(origin.z());
  if (!is_finite || determinant == 0)
    fail_to_read_volume(path, "its origin, spacings and directions do not define a grid", "correct its header");
  return Lattice_3<Kernel>(size, origin, steps);
}

Captured_standard_error::Captured_standard_error() : file_(std::tmpfile(), std::fclose) {
  if (!file_) throw Input_error("cannot create a temporary file; free space in the folder for temporary files");
  std::fflush(stderr);
  saved_ = ::dup(STDERR_FILENO);
  ::dup2(::fileno(file_.get()), STDERR_FILENO);
}

Captured_standard_error::~Captured_standard_error() {
  std::fflush(stderr);
  ::dup2(saved_, STDERR_FILENO);
  ::close(saved_);
}

std::string Captured_standard_error::text() const {
  std::fflush(stderr);
  std::string text;
  std::rewind(file_.get());
  for (int c; (c = std::fgetc(file_.get())) != EOF;) text += char(c);
  return text;
}

namespace {

/// Reads a file with the reader of its format, which is DICOM for a folder.
void read_here(const std::string& path, Volume_format format, Samples_in where, const Volume_selection& selection,
               Shared_volume& volume) {
  switch (format) {
  case Volume_format::NIFTI: return read_nifti_volume(path, where, selection, volume);
  case Volume_format::INR: return read_inr_volume(path, selection, volume);
#ifdef EQUIAFFINE_WITH_VTK
  case Volume_format::VTI: return read_vti_volume(path, where, selection, volume);
#endif
#ifdef EQUIAFFINE_WITH_ITK
  case Volume_format::DICOM: return read_dicom_volume(path, selection, volume);
  case Volume_format::NRRD:
  case Volume_format::META: return read_itk_volume(path, format, where, selection, volume);
#endif
  default: fail_to_read_volume_without(missing_library(format, false), path);
  }
}

Volume_view_3<Kernel> read_in_child(const std::string& path, std::optional<Volume_format> format, Samples_in where,
                                    const Volume_selection& selection) {
  constexpr double seconds = 10, bytes_per_second = 20e6; // ten times what a reader needs
  constexpr double memory_for_header = 1 << 29, copies = 4;
  // A volume larger than the memory is not read.
  const double size = std::min(physical_memory(), size_of_volume(path, format));
  try {
    Shared_volume volume;
    run_in_child([&] { read_here(path, format.value_or(Volume_format::DICOM), where, selection, volume); },
                 {seconds + size / bytes_per_second, memory_for_header + copies * size});
    return volume.view(path);
  } catch (const Child_failure& failure) {
    fail_to_read_volume(path, std::string("the library for this format ") + failure.what(), failure.advice());
  } catch (const std::bad_alloc&) {
    fail_to_read_volume(path, "it does not fit into memory", "check its header or crop it");
  }
}

} // namespace

Volume_view_3<Kernel> read_volume(const std::string& path, Samples_in where, const Volume_selection& selection) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail_to_read_volume(path, "there is no such file", "check the path");
  if (fs::is_directory(status)) {
    if (!has_itk) fail_to_read_volume_without("ITK", path);
    return read_in_child(path, std::nullopt, where, selection);
  }
  const std::optional<Extension> extension = find_extension(path);
  if (!extension)
    fail_to_read_volume(path, "unknown extension",
                        "use one of " + known_extensions(false) + " or a folder with a DICOM series");
  if (const auto library = missing_library(extension->format, false); !library.empty())
    fail_to_read_volume_without(library, path);
  if (::access(path.c_str(), R_OK) != 0) fail_to_read_volume(path, "permission denied", "make it readable");
  if (fs::is_regular_file(status) && fs::file_size(path, error) == 0)
    fail_to_read_volume(path, "it is empty", "get the complete file again");
  return read_in_child(path, extension->format, where, selection);
}

std::vector<std::string> files_read_with(const std::string& path) {
  const std::optional<Extension> extension = find_extension(path);
  return files_of_volume(path, extension ? std::optional(extension->format) : std::nullopt);
}

bool is_volume(const std::string& path) {
  std::error_code error;
  return find_extension(path) || has_extension(path, ".raw") || fs::is_directory(path, error);
}

void check_volume_output(const std::string& path) { find_written_extension(path); }

void write_volume(Output_file& file, const Volume_3<Kernel>& volume, bool as_float) {
  const Volume_format format = find_written_extension(file.path()).format;
  try {
    if constexpr (has_vtk)
      if (format == Volume_format::VTI) write_vti_volume(file.stream(), volume, as_float);
    if constexpr (has_itk)
      if (format != Volume_format::VTI) write_itk_volume(file.temporary_path().string(), format, volume, as_float);
  } catch (const Input_error& error) {
    throw Input_error("cannot write the volume '" + file.path() + "': " + error.what());
  }
}

void write_volume(const std::string& path, const Volume_3<Kernel>& volume, bool as_float) {
  check_volume_output(path);
  Output_file file(path);
  write_volume(file, volume, as_float);
  file.commit();
}

Volume_view_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout) {
  const auto& [dx, dy, dz] = layout.spacing;
  const auto& [x, y, z] = layout.origin;
  const Lattice_3<Kernel> lattice =
      make_lattice(path, layout.dims, Kernel::Point_3(x, y, z),
                   {Kernel::Vector_3(dx, 0, 0), Kernel::Vector_3(0, dy, 0), Kernel::Vector_3(0, 0, dz)},
                   size_of_sample(layout.type));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail_to_read_volume(path, "there is no such file", "check the path");
  const std::size_t width = size_of_sample(layout.type);
  const double expected = double(layout.dims[0]) * double(layout.dims[1]) * double(layout.dims[2]) * double(width);
  if (double(size) != expected)
    fail_to_read_volume(path,
                        "it has " + std::to_string(size) + " bytes, but " + std::to_string(layout.dims[0]) + " x " +
                            std::to_string(layout.dims[1]) + " x " + std::to_string(layout.dims[2]) + " samples of " +
                            std::string(raw_types[layout.type]) + " need " + std::to_string(std::uint64_t(expected)),
                        "correct " + option_text("dims") + " or " + option_text("type"));
  std::shared_ptr<const Mapped_file> file;
  try {
    file = std::make_shared<const Mapped_file>(path);
  } catch (const std::bad_alloc&) {
    fail_to_read_volume(path, "it does not fit into memory", "crop it");
  }
  if (file->size() != size) fail_to_read_volume(path, "it cannot be read", "check its permissions");
  return with_sample_type(layout.type, [&](auto number) {
    return Volume_view_3<Kernel>(lattice, reinterpret_cast<const decltype(number)*>(file->data()), file);
  });
}

} // namespace equiaffine
