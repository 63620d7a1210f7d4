// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes level sets of functions by Marching Cubes.
#ifndef EQUIAFFINE_BINDINGS_BROWSER_SAMPLE_H
#define EQUIAFFINE_BINDINGS_BROWSER_SAMPLE_H

#include "module.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

/// Makes the zero set of a function the surface of the module, with the attributes of a comma-separated list.
template <class Traits>
void sample(const Traits& traits, const char* attributes, const equiaffine::Marching_cubes_options& options = {}) {
  surface.mesh = equiaffine::marching_cubes(traits, options);
  surface.attributes = equiaffine::compute_attributes(traits, surface.mesh, equiaffine::select_attributes(attributes),
                                                      surface.mesh.vertex_status);
}

#endif
