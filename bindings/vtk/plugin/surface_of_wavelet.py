# SPDX-License-Identifier: GPL-3.0-or-later
# Shows the mean curvature of a level set. Load it in ParaView (File > Load State), or run it with pvbatch in any number
# of processes to write a picture and a state file to a folder:
#   mpirun -np 4 pvbatch surface_of_wavelet.py FOLDER
import sys
from pathlib import Path

from paraview.simple import (ColorBy, EquiaffineSurface, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar, Render,
                             ResetCamera, SaveScreenshot, SaveState, Show, Wavelet)

wavelet = Wavelet(WholeExtent=[-30, 30, -30, 30, -30, 30])
surface = EquiaffineSurface(Input=wavelet, Level=157, Attributes="all")

view = GetActiveViewOrCreate("RenderView")
display = Show(surface, view)
ColorBy(display, ("POINTS", "mean_curvature"))
GetColorTransferFunction("mean_curvature").RescaleTransferFunction(-0.5, 0.5)
display.SetScalarBarVisibility(view, True)
bar = GetScalarBar(GetColorTransferFunction("mean_curvature"), view)
bar.Title = "Mean curvature"
bar.TitleFontSize = bar.LabelFontSize = 8
bar.WindowLocation = "Lower Right Corner"
view.CameraPosition = [150, 110, 170]
ResetCamera(view)
Render(view)

if len(sys.argv) > 1:
    folder = Path(sys.argv[1])
    SaveScreenshot(str(folder / "surface.png"), view, ImageResolution=[900, 700])
    SaveState(str(folder / "surface.pvsm"))
