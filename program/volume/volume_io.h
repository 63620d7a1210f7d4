// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes volumes in the format that the extension of a path names.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_VOLUME_IO_H
#define EQUIAFFINE_PROGRAM_VOLUME_VOLUME_IO_H

#include "request/source_options.h"
#include "system/files.h"
#include "system/kernel.h"
#include "volume/Shared_volume.h"
#include <equiaffine/volume/Volume_3.h>

#include <string>
#include <vector>

namespace equiaffine {

/// Reads a volume of scalars: `.nii .nii.gz`; `.nrrd .nhdr .mhd .mha`, a DICOM file with several frames or a folder
/// with one DICOM series through ITK; `.inr .inr.gz` through CGAL; `.vti` through VTK, whose nodes are the centers of
/// cells if only these have numbers. Samples keep their type, but those of DICOM and of scaled NIfTI become double.
/// Node (i, j, k) lies at origin + directions * spacings * (i, j, k): for ITK's formats in ITK's physical frame
/// (millimeters; x to the left, y to the back, z up), for `.inr` at (TX + VX i, TY + VY j, TZ + VZ k), as in
/// `CGAL::Image_3`.
/// Throws `Input_error` for everything that is not a complete volume with two nodes or more per axis.
Volume_view_3<Kernel> read_volume(const std::string& path, Samples_in where = Samples_in::FILE,
                                  const Volume_selection& selection = {});

/// Reads samples one after the other, the first index fastest, in the byte order of this computer. Throws `Input_error`
/// unless the file has exactly the size that the layout says.
Volume_view_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout);

/// The paths of the files that are read with a volume: those that its header names, or all in a folder.
std::vector<std::string> files_read_with(const std::string& path);

/// Whether a path is that of a folder or of a DICOM file, or has an extension of files that hold volumes, `.raw`
/// included.
bool is_volume(const std::string& path);

/// Throws `Input_error` unless this program, with the libraries that it was built with, writes the extension of `path`.
void check_volume_output(const std::string& path);

/// Writes `.nrrd .mhd .mha .nii .nii.gz` through ITK or `.vti` through VTK, as float or double, without committing
/// `file`. NIfTI holds its geometry in single precision and only perpendicular steps: where it would move a node by
/// more than a thousandth of the shortest step, it is refused by an `Input_error`. The other formats hold any lattice.
/// A file that ITK wrote is read back once, because ITK does not notice a full disk.
void write_volume(Output_file& file, const Volume_3<Kernel>& volume, bool as_float);

/// Writes the volume to a file of its own and commits it.
void write_volume(const std::string& path, const Volume_3<Kernel>& volume, bool as_float);

} // namespace equiaffine

#endif
