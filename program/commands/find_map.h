// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAP_H
#define EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAP_H

#include "commands/Surface_to_register.h"
#include "output/maps.h"
#include "request/options.h"
#include "system/progress.h"
#include <equiaffine/registration/Surface_registration_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine {

/// Two surfaces, the map between them, and the scales of fits that were tried before there was one.
struct Found_map {
  Surface_to_register source, target;
  Surface_registration_3<Kernel> registration = {};
  std::size_t maps_left_out = 0;       ///< since too small a part agrees, or the scales do not
  std::vector<std::string> tried = {}; ///< "0.14", or "0.14 and 0.2" for the source and the target
  bool is_by_triangles = false;        ///< whether triangles without their curvature gave the map
};

/// Finds the map. Curvatures of two fits can be compared at the same scale only, so that fits whose scale is not given
/// are tried at multiples of the distance of their points, until there is a map. At last the triangles of two meshes are
/// compared without curvature, since CAD parts have none to go by. Throws `Input_error`.
Found_map find_map(const Register_options& options, Progress& progress);

/// Returns the report on it.
Registration_report report_of(const Register_options& options, const Found_map& found);

} // namespace equiaffine

#endif
