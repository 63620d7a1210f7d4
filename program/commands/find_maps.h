// SPDX-License-Identifier: GPL-3.0-or-later
// The search for maps between two surfaces, and for the symmetries of one.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAPS_H
#define EQUIAFFINE_PROGRAM_COMMANDS_FIND_MAPS_H

#include "commands/Surface_to_register.h"
#include "output/maps.h"
#include "request/Request.h"
#include "system/progress.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/register_surfaces.h>

#include <optional>
#include <string>

namespace equiaffine {

/// Makes the surfaces, and finds the map between them. Throws `Input_error`.
internal::Registration_of_surfaces find_map(const Request& options, Progress& progress);

/// Returns the report on the map.
Registration_report report_of(const Request& options, const internal::Registration_of_surfaces& found);

/// A surface and its symmetries.
struct Found_symmetries {
  Symmetries symmetries;
  Indexed_triangle_mesh_3<Kernel> mesh;
  std::optional<internal::Surface_to_register> level_set; ///< unless the mesh is the surface

  /// The name of the surface in reports.
  std::string name(const Source_options& source) const;

  /// The surface with marks of the symmetries.
  Annotated_mesh_3<Kernel> shown() const;
};

/// Makes the surface, and finds its symmetries. Throws `Input_error`.
Found_symmetries find_symmetries(const Request& options, Progress& progress);

/// Returns the report on the symmetries. Throws `Input_error` if the fit has no surface near its points.
Symmetries_report report_of(const Request& options, const Found_symmetries& found);

} // namespace equiaffine

#endif
