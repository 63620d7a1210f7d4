// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes volumes, in the format of the path's extension.
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

/// Reads a volume of scalars: `.nii .nii.gz`; `.nrrd .nhdr .mhd .mha`, a multi-frame DICOM file or a folder with one
/// DICOM series with ITK; `.inr .inr.gz` with CGAL; `.vti` with VTK, with nodes at the centers of cells if only cells
/// have numbers. Samples keep their type, except those of DICOM and of scaled NIfTI, which become double.
/// Node (i, j, k) is at origin + directions * spacings * (i, j, k): for ITK's formats in ITK's physical frame
/// (millimeters; x to the left, y to the back, z up), for `.inr` at (TX + VX i, TY + VY j, TZ + VZ k), as in
/// `CGAL::Image_3`.
/// Throws `Input_error` for anything other than a complete volume with at least two nodes per axis.
Volume_view_3<Kernel> read_volume(const std::string& path, Samples_in where = Samples_in::FILE,
                                  const Volume_selection& selection = {});

/// Reads contiguous samples, the first index fastest, in the byte order of this computer. Throws `Input_error` unless
/// the file has exactly the size of the layout.
Volume_view_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout);

/// The files that are read with a volume: those named by its header, or all files of a folder.
std::vector<std::string> files_read_with(const std::string& path);

/// Whether a path is a folder or a DICOM file, or has an extension of volumes, including `.raw`.
bool is_volume(const std::string& path);

/// Throws `Input_error` unless this program, with its libraries, can write the extension of `path`.
void check_volume_output(const std::string& path);

/// Writes `.nrrd .mhd .mha .nii .nii.gz` with ITK or `.vti` with VTK, as float or double, without committing `file`.
/// NIfTI stores only orthogonal steps, in single precision: throws `Input_error` if that would move a node by more than
/// 1/1000 of the shortest step. The other formats store any lattice. Files of ITK are read back once, because ITK does
/// not detect a full disk.
void write_volume(Output_file& file, const Volume_3<Kernel>& volume, bool as_float);

/// Writes the volume to a file and commits it.
void write_volume(const std::string& path, const Volume_3<Kernel>& volume, bool as_float);

} // namespace equiaffine

#endif
