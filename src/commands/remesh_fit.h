// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_COMMANDS_REMESH_FIT_H
#define EQUIAFFINE_SRC_COMMANDS_REMESH_FIT_H

#include "output/statistics.h"
#include "request/options.h"
#include "source/source.h"
#include "system/kernel.h"
#include <equiaffine/surface/Isosurface_3.h>

#include <vector>

namespace equiaffine {

/// The data of a fit, remeshed and moved onto it.
struct Remeshed_fit {
  Isosurface_3<Kernel> mesh;    ///< vertices beside the fit are UNCONVERGED
  std::vector<double> outcomes; ///< the number of the Fit_outcome of each vertex
  Remesh_statistics statistics;
};

/// Remeshes the data of a fit. Throws `Input_error` if they have no faces, or if they are no mesh.
Remeshed_fit remesh_fit(const Source& source, const Source_options& options, const Remesh_options& how);

} // namespace equiaffine

#endif
