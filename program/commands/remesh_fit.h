// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_REMESH_FIT_H
#define EQUIAFFINE_PROGRAM_COMMANDS_REMESH_FIT_H

#include "output/statistics.h"
#include "request/options.h"
#include "source/source.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/mesh/Isosurface_3.h>

#include <vector>

namespace equiaffine {

/// The data of a fit, remeshed and moved onto it.
struct Remeshed_fit {
  Isosurface_3<Kernel> mesh;    ///< vertices beside the fit are UNCONVERGED
  std::vector<double> outcomes; ///< the number of the Fit_outcome of each vertex
  Remesh_statistics statistics;
};

/// Remeshes the data of a fit. Where they choose its scale, and many vertices would be beside the fit, that scale is too
/// large for the shape: smaller ones are tried while they leave fewer vertices beside the fit and numbers known at about
/// as many, and `source` becomes a fit at such a scale if it leaves a third fewer. Throws `Input_error` if the data have no
/// faces, or if they are no mesh.
Remeshed_fit remesh_fit(Source& source, Source_options options, const Remesh_options& how, Progress& progress);

} // namespace equiaffine

#endif
