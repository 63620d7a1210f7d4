# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares vtkEquiaffineSurface with vtkFlyingEdges3D in the same pipeline, in one or more processes:
  mpirun -np 2 --bind-to none pvtkpython benchmark/vtk_filters.py FOLDER_OF_THE_MODULE [NODES] [ATTRIBUTES] [ROW]
Prints median times, vertices, and the peak memory of a process beyond that of the pipeline without a filter. Memory is
that of the first run; give the number of a row, from 0, to measure it in separate processes."""
import re
import statistics
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

sys.path.insert(0, sys.argv[1])
from equiaffine_vtk.equiaffineVTK import vtkEquiaffineSurface  # noqa: E402

NODES = int(sys.argv[2]) if len(sys.argv) > 2 else 256
ATTRIBUTES = sys.argv[3] if len(sys.argv) > 3 else "basic"
ROW = int(sys.argv[4]) if len(sys.argv) > 4 else None
CONTROLLER = vtk.vtkMultiProcessController.GetGlobalController()
RANK, RANKS = (CONTROLLER.GetLocalProcessId(), CONTROLLER.GetNumberOfProcesses()) if CONTROLLER else (0, 1)


def memory(name):
    """VmRSS or VmHWM of this process, in MB."""
    with open("/proc/self/status", encoding="ascii") as file:
        return int(re.search(name + r":\s+(\d+)", file.read()).group(1)) / 1024


def reset_peak():
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")


def piece_of_gyroid(ghosts):
    """The part of this process of NODES^3 floats, divided along z, with the ghost levels provided by a source."""
    first, end = ((NODES - 1) * n // RANKS for n in (RANK, RANK + 1))
    low, high = max(first - ghosts, 0), min(end + ghosts, NODES - 1)
    x = np.linspace(0, 8 * np.pi, NODES, dtype=np.float32)
    image = vtk.vtkImageData()
    image.SetExtent(0, NODES - 1, 0, NODES - 1, low, high)
    values = np.empty((high - low + 1, NODES, NODES), np.float32)
    sx, cx, sy, cy = np.sin(x)[None, :], np.cos(x)[None, :], np.sin(x)[:, None], np.cos(x)[:, None]
    for n, z in enumerate(x[low:high + 1]):
        values[n] = sx * cy + sy * np.cos(z) + np.sin(z) * cx
    array = numpy_to_vtk(values.ravel(), deep=1)
    array.SetName("gyroid")
    image.GetPointData().SetScalars(array)
    return image


def measure(make, repetitions=3):
    """The median time of the slowest process, the output, and the maximum peak memory beyond the input."""
    seconds, peaks = [], []
    for _ in range(repetitions):
        one = make()
        reset_peak()
        before = memory("VmRSS")
        if RANKS > 1:
            CONTROLLER.Barrier()
        start = time.perf_counter()
        one.UpdatePiece(RANK, RANKS, 0)
        if RANKS > 1:
            CONTROLLER.Barrier()
        seconds.append(time.perf_counter() - start)
        peaks.append(memory("VmHWM") - before)
    return statistics.median(seconds), one.GetOutput(), peaks[0]


def main():
    levels = vtkEquiaffineSurface().GetNumberOfGhostLevels()
    image = piece_of_gyroid(levels if RANKS > 1 else 0)

    source = vtk.vtkTrivialProducer()
    source.SetOutput(image)
    source.SetWholeExtent(0, NODES - 1, 0, NODES - 1, 0, NODES - 1)

    def flying_edges(normals):
        edges = vtk.vtkFlyingEdges3D()
        edges.SetInputConnection(source.GetOutputPort())
        edges.SetValue(0, 0)
        edges.SetComputeNormals(normals)
        edges.SetComputeGradients(normals)
        return edges

    def ours(attributes, project=True):
        surface = vtkEquiaffineSurface()
        surface.SetInputConnection(source.GetOutputPort())
        surface.SetAttributes(attributes)
        surface.SetVertices(surface.PROJECTED if project else surface.LINEAR)
        surface.EstimateErrorsOff()  # the peers have none
        return surface

    rows = [("vtkFlyingEdges3D", lambda: flying_edges(False)),
            ("vtkFlyingEdges3D, normals and gradients", lambda: flying_edges(True)),
            ("vtkEquiaffineSurface, none, not projected", lambda: ours("none", False)),
            ("vtkEquiaffineSurface, none", lambda: ours("none")),
            (f"vtkEquiaffineSurface, {ATTRIBUTES}", lambda: ours(ATTRIBUTES))]
    if RANK == 0:
        print(f"{RANKS} processes, {NODES}^3 nodes, {levels} ghost levels, input of a process "
              f"{image.GetActualMemorySize() / 1024:.0f} MB")
    for name, make in rows if ROW is None else rows[ROW:ROW + 1]:
        seconds, output, peak = measure(make)
        if RANK == 0:
            print(f"{name}: {seconds:.3f} s, {output.GetNumberOfPoints()} vertices, output "
                  f"{output.GetActualMemorySize() / 1024:.0f} MB, peak {peak:.0f} MB beyond the input", flush=True)


main()
