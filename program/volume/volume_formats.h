// SPDX-License-Identifier: GPL-3.0-or-later
// The readers and writers for volume_io.h, and their common functions. Those of a library exist only in a program built
// with it.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_VOLUME_FORMATS_H
#define EQUIAFFINE_PROGRAM_VOLUME_VOLUME_FORMATS_H

#include "request/source_options.h"
#include "system/kernel.h"
#include "volume/Shared_volume.h"
#include <equiaffine/volume/Volume_3.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <ostream>
#include <string>

namespace equiaffine {

enum class Volume_format { NRRD, META, NIFTI, INR, VTI, DICOM };

/// `where`: whether the volume may refer to the file.
void read_itk_volume(const std::string& path, Volume_format format, Samples_in where, const Volume_selection& selection,
                     Shared_volume& volume);
void read_inr_volume(const std::string& path, const Volume_selection& selection, Shared_volume& volume);
void read_vti_volume(const std::string& path, Samples_in where, const Volume_selection& selection,
                     Shared_volume& volume);
void read_nifti_volume(const std::string& path, Samples_in where, const Volume_selection& selection,
                       Shared_volume& volume);

/// Reads the frames of a DICOM file, or of all files in a folder, which must be one series. The positions of the frames
/// define the lattice, whatever their order.
void read_dicom_volume(const std::string& path, const Volume_selection& selection, Shared_volume& volume);

void write_itk_volume(const std::string& path, Volume_format format, const Volume_3<Kernel>& volume, bool as_float);
void write_vti_volume(std::ostream& stream, const Volume_3<Kernel>& volume, bool as_float);

// The readers of ITK, VTK and CGAL trust the header. These functions check it first, and throw `Input_error` with the
// name of the field if the readers would crash, run forever or return another volume.

/// Checks the fields of an INRIMAGE-4 header, and that the decompressed data have the stated length.
void check_inr_header(const std::string& path);

/// Checks the numbers of axes and nodes of a MetaImage, and its frame.
void check_meta_header(const std::string& path);

/// Checks the frame of a NIfTI-1 file, and that the decompressed data have the stated length.
void check_nifti_header(const std::string& path);

/// Checks the extent and the frame of a VTI file, and the types of its arrays.
void check_vti_header(const std::string& path);

/// Throws `Input_error`: "cannot read the volume 'path': reason; advice".
[[noreturn]] void fail_to_read_volume(const std::string& path, const std::string& reason, const std::string& advice);

/// Throws `Input_error` for truncated or damaged data.
[[noreturn]] void fail_to_read_volume_data(const std::string& path);

/// Throws `Input_error` for an unsupported type of samples.
[[noreturn]] void fail_to_read_volume_type(const std::string& path);

/// The index, from 0, that `component` selects among `count` numbers per node. Throws `Input_error` if it is required
/// and missing, or too large.
std::size_t chosen_component(const std::string& path, const Volume_selection& selection, std::size_t count);

/// The same for `time` and the volumes of a 4D file.
std::size_t chosen_time(const std::string& path, const Volume_selection& selection, std::size_t count);

/// Allows a child process the memory that a reader needs for the nodes stated in a header. Call it before decompressing
/// them. Throws `Input_error` if there are too few nodes for a volume, or too many for the memory of this computer.
void admit_nodes(const std::string& path, const Lattice_3<Kernel>::Size& size,
                 std::size_t bytes_of_sample = sizeof(double));

/// The lattice of a file; calls admit_nodes(). Throws `Input_error` if origin and steps do not define a lattice.
Lattice_3<Kernel> make_lattice(const std::string& path, const Lattice_3<Kernel>::Size& size,
                               const Kernel::Point_3& origin, const std::array<Kernel::Vector_3, 3>& steps,
                               std::size_t bytes_of_sample = sizeof(double));

/// Captures the process's standard error during its lifetime: libraries that read volumes report errors there, one of
/// them only there.
class Captured_standard_error {
public:
  Captured_standard_error();
  ~Captured_standard_error();
  Captured_standard_error(const Captured_standard_error&) = delete;
  Captured_standard_error& operator=(const Captured_standard_error&) = delete;

  std::string text() const;

private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  int saved_;
};

} // namespace equiaffine

#endif
