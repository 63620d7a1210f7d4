// SPDX-License-Identifier: GPL-3.0-or-later
// The search for maps between two surfaces, and for the symmetries of one.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAPS_H
#define EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAPS_H

#include "commands/Surface_to_register.h"
#include "output/maps.h"
#include "request/options.h"
#include "system/progress.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/register_surfaces.h>

#include <cstddef>
#include <optional>
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

/// A surface whose symmetries are sought, and what was found.
struct Found_symmetries {
  Symmetries symmetries;
  Indexed_triangle_mesh_3<Kernel> mesh;
  std::optional<Surface_to_register> level_set; ///< unless the mesh is the surface

  /// Returns the name of the surface for people.
  std::string name(const Source_options& source) const;

  /// The surface with marks of the symmetries.
  Annotated_mesh_3<Kernel> shown() const;
};

/// Finds symmetries. Points without faces become a mesh. Affine frames of a fit are tried where a mesh bounds no solid.
/// Throws `Input_error`.
Found_symmetries find_symmetries(const Symmetries_options& options, Progress& progress);

/// Returns the report on them. Throws `Input_error` if nothing is known of the surface.
Symmetries_report report_of(const Symmetries_options& options, const Found_symmetries& found);

} // namespace equiaffine

#endif
