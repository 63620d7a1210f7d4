// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_HEADER_CHECKS_H
#define EQUIAFFINE_PROGRAM_VOLUME_HEADER_CHECKS_H

// The readers of ITK, VTK and CGAL believe what a header says. These functions read it before them and throw
// `Input_error`, which names the field, for what makes these readers crash, run forever or return another volume.

#include <string>

namespace equiaffine {

/// Checks the fields of an INRIMAGE-4 header, and that the data, decompressed, are as long as it says.
void check_inr_header(const std::string& path);

/// Checks the numbers of axes and nodes of a MetaImage, and its frame.
void check_meta_header(const std::string& path);

/// Checks the frame of a NIfTI-1 file, and that the data, decompressed, are as long as its header says.
void check_nifti_header(const std::string& path);

/// Checks the extent and the frame of a VTI file, and the types of its arrays.
void check_vti_header(const std::string& path);

} // namespace equiaffine

#endif
