// SPDX-License-Identifier: GPL-3.0-or-later
// In a file of its own because this header of VTK 9.1 is not C++20.
#include <vtkSMPTools.h>

void set_vtk_threads(int n) { vtkSMPTools::Initialize(n); }
