// SPDX-License-Identifier: GPL-3.0-or-later
// A separate file, since this header of VTK 9.1 is not valid C++20.
#include <vtkSMPTools.h>

void set_vtk_threads(int n) { vtkSMPTools::Initialize(n); }
