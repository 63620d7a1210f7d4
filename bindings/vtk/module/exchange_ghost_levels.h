// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_EXCHANGE_GHOST_LEVELS_H
#define EQUIAFFINE_BINDINGS_VTK_EXCHANGE_GHOST_LEVELS_H

#include <vtkSmartPointer.h>

#include <vector>

class vtkImageData;
class vtkMultiProcessController;

namespace equiaffine {

/// Replaces images by images that have so many more levels of points around them, as far as other images have them, of
/// this process or of others.
void exchange_ghost_levels(std::vector<vtkSmartPointer<vtkImageData>>& images, int levels,
                           vtkMultiProcessController* controller);

} // namespace equiaffine

#endif
