// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume_io.h"

#include "volume_formats.h"
#include <equiaffine/Input_error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
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
    Extension{".vti", Volume_format::VTI, true}};

std::optional<Extension> find_extension(const std::string& path) {
  std::string lower = path;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const Extension& extension : extensions)
    if (lower.ends_with(extension.text)) return extension;
  return std::nullopt;
}

std::string known_extensions(bool written_only) {
  std::string list;
  for (const Extension& extension : extensions)
    if (extension.is_written || !written_only) list.append(list.empty() ? "" : " ").append(extension.text);
  return list;
}

Extension find_written_extension(const std::string& path) {
  const std::optional<Extension> extension = find_extension(path);
  if (!extension || !extension->is_written)
    throw Input_error("cannot write the volume '" + path + "': " +
                      (extension ? std::string(extension->text) + " is only read" : "its extension is not known") +
                      "; use one of " + known_extensions(true));
  return *extension;
}

} // namespace

void fail_to_read_volume(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the volume '" + path + "': " + reason + "; " + advice);
}

void fail_to_read_volume_data(const std::string& path) {
  fail_to_read_volume(path, "the data are damaged or end before the size stated in the header",
                      "get the complete file again");
}

Lattice_3<Kernel> make_lattice(const std::string& path, const Lattice_3<Kernel>::Size& size,
                               const Kernel::Point_3& origin, const std::array<Kernel::Vector_3, 3>& steps) {
  const std::string size_text =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
  if (*std::min_element(size.begin(), size.end()) < 2)
    fail_to_read_volume(path, "it has " + size_text + " nodes",
                        "a volume needs at least 2 nodes along each of its axes");
  const double determinant = CGAL::determinant(steps[0], steps[1], steps[2]);
  const bool is_finite =
      std::isfinite(determinant) && std::isfinite(origin.x()) && std::isfinite(origin.y()) && std::isfinite(origin.z());
  if (!is_finite || determinant == 0)
    fail_to_read_volume(path, "its origin, spacings and directions do not span a grid in space", "correct its header");
  return Lattice_3<Kernel>(size, origin, steps);
}

Captured_standard_error::Captured_standard_error() : file_(std::tmpfile(), std::fclose) {
  if (!file_) throw Input_error("cannot make a temporary file; make room in the folder for temporary files");
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

Volume_3<Kernel> read_volume(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail_to_read_volume(path, "there is no such file", "check the path");
  if (fs::is_directory(status)) return read_dicom_series(path);
  const std::optional<Extension> extension = find_extension(path);
  if (!extension)
    fail_to_read_volume(path, "its extension is not known",
                        "use one of " + known_extensions(false) + " or a folder with a DICOM series");
  if (::access(path.c_str(), R_OK) != 0) fail_to_read_volume(path, "permission denied", "make it readable");
  try {
    switch (extension->format) {
    case Volume_format::INR: return read_inr_volume(path);
    case Volume_format::VTI: return read_vti_volume(path);
    default: return read_itk_volume(path, extension->format);
    }
  } catch (const std::bad_alloc&) {
    fail_to_read_volume(path, "it does not fit into memory", "check its header or crop it");
  }
}

void check_volume_output(const std::string& path) { find_written_extension(path); }

void write_volume(Output_file& file, const Volume_3<Kernel>& volume, bool as_float) {
  const Volume_format format = find_written_extension(file.path()).format;
  try {
    if (format == Volume_format::VTI) write_vti_volume(file.stream(), volume, as_float);
    else write_itk_volume(file.temporary_path().string(), format, volume, as_float);
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

#ifndef EQUIAFFINE_WITH_ITK
namespace {
constexpr const char* no_itk = "this equiaffine was built without ITK";
constexpr const char* instead_of_itk = "build it with ITK, or use .inr or .vti";
} // namespace

Volume_3<Kernel> read_itk_volume(const std::string& path, Volume_format) {
  fail_to_read_volume(path, no_itk, instead_of_itk);
}
Volume_3<Kernel> read_dicom_series(const std::string& folder) { fail_to_read_volume(folder, no_itk, instead_of_itk); }
void write_itk_volume(const std::string&, Volume_format, const Volume_3<Kernel>&, bool) {
  throw Input_error(std::string(no_itk) + "; build it with ITK, or write .vti");
}
#endif

#ifndef EQUIAFFINE_WITH_VTK
namespace {
constexpr const char* no_vtk = "this equiaffine was built without VTK";
} // namespace

Volume_3<Kernel> read_vti_volume(const std::string& path) {
  fail_to_read_volume(path, no_vtk, "build it with VTK, or use one of the other formats");
}
void write_vti_volume(std::ostream&, const Volume_3<Kernel>&, bool) {
  throw Input_error(std::string(no_vtk) + "; build it with VTK, or write one of the other formats");
}
#endif

} // namespace equiaffine
