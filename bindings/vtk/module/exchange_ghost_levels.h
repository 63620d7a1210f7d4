// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_EXCHANGE_GHOST_LEVELS_H
#define EQUIAFFINE_BINDINGS_VTK_EXCHANGE_GHOST_LEVELS_H

#include <vtkSmartPointer.h>

#include <vector>

class vtkImageData;
class vtkMultiProcessController;

namespace equiaffine {

/// Extends images by this number of levels of points from neighboring images, of this process or of others. Levels that
/// no image contains are left out.
void exchange_ghost_levels(std::vector<vtkSmartPointer<vtkImageData>>& images, int levels,
                           vtkMultiProcessController* controller);

} // namespace equiaffine

#endif
