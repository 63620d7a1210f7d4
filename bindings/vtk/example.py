# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the level set 157 of VTK's wavelet with its curvatures: example.py FILE.vtp"""
import sys

import vtk
from equiaffine_vtk.equiaffineVTK import vtkEquiaffineSurface

source = vtk.vtkRTAnalyticSource()
source.SetWholeExtent(-20, 20, -20, 20, -20, 20)
surface = vtkEquiaffineSurface()
surface.SetInputConnection(source.GetOutputPort())
surface.SetLevel(157)
surface.Update()
data = surface.GetOutput().GetPointData()
for name in ("mean_curvature", "affine_mean_curvature"):
    print(name, "from %g to %g" % data.GetArray(name).GetRange())
writer = vtk.vtkXMLPolyDataWriter()
writer.SetInputConnection(surface.GetOutputPort())
writer.SetFileName(sys.argv[1])
writer.Write()
