# SPDX-License-Identifier: GPL-3.0-or-later
# Checks in pvbatch that the surface in these processes is that of one: run it in one process first, and then in others.
#   mpirun -np 4 pvbatch pvbatch_test.py FOLDER
import hashlib
import sys
from pathlib import Path

import numpy as np
from paraview import servermanager
from paraview.simple import EquiaffineCurvatures, EquiaffineSurface, Sphere, Wavelet
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController


def digest(mesh):
    """A number for the vertices with their attributes, by ids, and for the triangles."""
    ids = vtk_to_numpy(mesh.GetPointData().GetGlobalIds())
    first = np.unique(ids, return_index=True)[1]  # of the copies at the seams
    data = mesh.GetPointData()
    result = hashlib.sha256(vtk_to_numpy(mesh.GetPoints().GetData())[first].tobytes())
    names = sorted(data.GetArrayName(n) for n in range(data.GetNumberOfArrays()))
    for name in names:
        if name != "vtkGhostType":
            result.update(vtk_to_numpy(data.GetArray(name))[first].tobytes())
    triangles = ids[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    result.update(triangles[np.lexsort(triangles.T)].tobytes())
    return f"{len(first)} vertices, {len(triangles)} triangles, {result.hexdigest()}"


surface = EquiaffineSurface(Input=Wavelet(WholeExtent=[-20, 20, -20, 20, -20, 20]), Level=157,
                            EstimateErrors=0)  # which pieces do not have
surface.UpdatePipeline()
mesh = servermanager.Fetch(surface)
sphere = EquiaffineCurvatures(Input=Sphere(ThetaResolution=30, PhiResolution=30))
sphere.UpdatePipeline()
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == 0:
    found, file = digest(mesh), Path(sys.argv[1]) / "digest.txt"
    print(f"{controller.GetNumberOfProcesses()} processes: {found}")
    if controller.GetNumberOfProcesses() == 1:
        file.write_text(found)
    assert mesh.GetNumberOfPolys() > 1000, "ParaView has carried on without points"
    assert found == file.read_text(), "the surface is not that of one process"
    assert sphere.PointData.GetArray("gaussian_curvature_error") is not None
