// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled as C++17, since some headers of VTK 9.1 are not valid C++20.
#include "exchange_ghost_levels.h"

#include <vtkDIYGhostUtilities.h>
#include <vtkDummyController.h>
#include <vtkImageData.h>
#include <vtkNew.h>

namespace equiaffine {

void exchange_ghost_levels(std::vector<vtkSmartPointer<vtkImageData>>& images, int levels,
                           vtkMultiProcessController* controller) {
  const vtkNew<vtkDummyController> one_process;
  std::vector<vtkSmartPointer<vtkImageData>> results;
  std::vector<vtkImageData*> inputs, outputs;
  for (vtkImageData* const image : images) {
    results.push_back(vtkSmartPointer<vtkImageData>::New());
    inputs.push_back(image);
    outputs.push_back(results.back());
  }
  vtkDIYGhostUtilities::GenerateGhostCells(inputs, outputs, levels, controller ? controller : one_process.GetPointer());
  images = results;
}

} // namespace equiaffine
