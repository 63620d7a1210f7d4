// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_IS_ABORTED_H
#define EQUIAFFINE_BINDINGS_VTK_IS_ABORTED_H

#include <vtkAlgorithm.h>
#include <vtkVersionMacros.h>

namespace equiaffine {

/// Whether the user has aborted a filter or, since VTK 9.3, its pipeline.
inline bool is_aborted(vtkAlgorithm& filter) {
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return filter.CheckAbort();
#else
  return filter.GetAbortExecute() != 0;
#endif
}

} // namespace equiaffine

#endif
