// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_SHOW_H
#define EQUIAFFINE_PROGRAM_COMMANDS_SHOW_H

#include "output/Outputs.h"
#include "request/options.h"
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <string>

namespace equiaffine {

/// Writes the page and the picture that are asked for of a mesh of that name, and returns them. Throws `Input_error`, also
/// for a mesh without faces, and for an attribute that it has not.
Outputs show(const Annotated_mesh_3<Kernel>& surface, const std::string& name, const View_options& options);

} // namespace equiaffine

#endif
