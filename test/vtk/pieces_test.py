# SPDX-License-Identifier: GPL-3.0-or-later
# The surfaces of the pieces of an image, in the processes that run this, are together the surface of the whole image in
# one process, bit for bit. Run it with
#   mpirun -np 4 pvtkpython test/vtk/pieces_test.py FOLDER_OF_THE_MODULE FOLDER_FOR_RESULTS
import os
import pickle
import sys
import traceback
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, sys.argv[1])
from equiaffine_vtk.equiaffineVTK import vtkEquiaffineSurface  # noqa: E402

FOLDER = Path(sys.argv[2])
CONTROLLER = vtk.vtkMultiProcessController.GetGlobalController()
RANK, RANKS = CONTROLLER.GetLocalProcessId(), CONTROLLER.GetNumberOfProcesses()
WHOLE = (3, 37, -5, 28, 10, 70)


def waves(i, j, k):
    """A function of the indices with noise, as floats."""
    noise = ((i * 7919 + j * 104729 + k * 1299709) % 1009) / 1009 - 0.5
    return (np.sin(0.23 * i) + np.cos(0.21 * j) * np.sin(0.19 * k) + 1e-3 * noise).astype(np.float32)


def ball(i, j, k):
    """A small ball in one corner, as integers."""
    return np.minimum((i - 8) ** 2 + (j - 1) ** 2 + (k - 15) ** 2, 30000).astype(np.int16)


def steps(i, j, k):
    """Integers of few values."""
    return np.round(6 * np.sin(0.35 * i) * np.cos(0.3 * j) + 4 * np.sin(0.33 * k)).astype(np.int16)


def with_holes(i, j, k):
    """Some points have no value."""
    values = waves(i, j, k)
    values[(i + 2 * j + 3 * k) % 97 == 0] = np.nan
    return values


def image_of(function, extent):
    image = vtk.vtkImageData()
    image.SetExtent(extent)
    image.SetOrigin(0.1, 0.2, -3)
    image.SetSpacing(0.5, 0.7, 0.9)
    image.SetDirectionMatrix(0, -1, 0, 0.6, 0, 0.8, 0.8, 0, -0.6)  # a rotation and a mirror
    k, j, i = np.mgrid[extent[4] : extent[5] + 1, extent[2] : extent[3] + 1, extent[0] : extent[1] + 1]
    array = numpy_to_vtk(function(i, j, k).ravel(), deep=1)
    array.SetName("samples")
    image.GetPointData().SetScalars(array)
    return image


def cuts(first, end, parts):
    ends = [first + (end - first) * n // parts for n in range(parts + 1)]
    return list(zip(ends[:-1], ends[1:]))


def pieces(parts):
    """The extents of the pieces into which the image is cut along each axis."""
    x, y, z = (cuts(WHOLE[2 * a], WHOLE[2 * a + 1], parts[a]) for a in range(3))
    return [i + j + k for k in z for j in y for i in x]


def surface(source, prepare, controller):
    surface_filter = vtkEquiaffineSurface()
    surface_filter.SetController(controller)
    surface_filter.EstimateErrorsOff()  # which pieces do not have
    prepare(surface_filter)
    if isinstance(source, vtk.vtkDataObject):
        surface_filter.SetInputDataObject(source)
    else:
        surface_filter.SetInputConnection(source.GetOutputPort())
    if controller is None:
        surface_filter.Update()
    else:
        surface_filter.UpdatePiece(RANK, RANKS, 0)
    return surface_filter.GetOutput()


def bits(array):
    """Numbers as bytes, so that NaN equals itself."""
    values = vtk_to_numpy(array)
    return np.ascontiguousarray(values).view(np.uint8).reshape(len(values), -1)


def content(mesh):
    """The vertices by ids, the triangles, the ids that belong to this process, and the statistics."""
    data, field = mesh.GetPointData(), mesh.GetFieldData()
    statistics = {field.GetArray(n).GetName(): bits(field.GetArray(n)).tobytes()
                  for n in range(field.GetNumberOfArrays())}
    if mesh.GetNumberOfPoints() == 0:
        return {"vertices": {}, "triangles": [], "own": [], "statistics": statistics}
    ids = vtk_to_numpy(data.GetGlobalIds())
    names = [data.GetArrayName(n) for n in range(data.GetNumberOfArrays())]
    rows = np.hstack([bits(mesh.GetPoints().GetData())] +
                     [bits(data.GetArray(name)) for name in names if name != "vtkGhostType"])
    ghosts = data.GetArray("vtkGhostType")
    own = ids[vtk_to_numpy(ghosts) == 0] if ghosts else ids
    triangles = ids[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    assert len(set(ids)) == len(ids)
    return {"vertices": {int(i): row.tobytes() for i, row in zip(ids, rows)}, "triangles": triangles.tolist(),
            "own": own.tolist(), "statistics": statistics}


def expect_same(name, source, whole, prepare=lambda _: None):
    """Compares the meshes of all processes with that of the whole image in one."""
    mine = content(surface(source, prepare, CONTROLLER))
    (FOLDER / str(RANK)).write_bytes(pickle.dumps(mine))
    CONTROLLER.Barrier()
    if RANK == 0:
        expected = content(surface(whole, prepare, None))
        assert len(expected["triangles"]) > 100, name
        vertices, triangles, own = {}, [], []
        for rank in range(RANKS):
            part = pickle.loads((FOLDER / str(rank)).read_bytes())
            assert part["statistics"] == expected["statistics"], f"{name}: statistics of process {rank}"
            for i, row in part["vertices"].items():
                assert vertices.setdefault(i, row) == row, f"{name}: vertex {i} is not the same in two processes"
            triangles += part["triangles"]
            own += part["own"]
        assert vertices == expected["vertices"], f"{name}: vertices"
        assert sorted(triangles) == sorted(expected["triangles"]), f"{name}: triangles"
        assert sorted(own) == sorted(vertices), f"{name}: a vertex belongs to no process, or to two"
        print(f"{name}: {len(vertices)} vertices, {len(triangles)} triangles, the same bits", flush=True)
    CONTROLLER.Barrier()


def options(**properties):
    def prepare(surface_filter):
        for name, value in properties.items():
            getattr(surface_filter, "Set" + name)(value)
    return prepare


def test_images():
    across = RANKS if RANKS < 4 else RANKS // 2
    ways = {"one axis": (1, 1, RANKS), "two axes": (RANKS // across, across, 1)}
    for name, parts in ways.items():
        extent = pieces(parts)[RANK]
        for function, prepare in ((waves, options()), (waves, options(Smoothing=1.5, Attributes="basic")),
                                  (waves, options(SplineScheme=1, SplineDegree=5, Orientation=1)),
                                  (with_holes, options(SplineDegree=9, Vertices=1)),
                                  (ball, options(Level=20, Attributes="signature,normal"))):
            expect_same(f"{function.__name__}, cut along {name}", image_of(function, extent),
                        image_of(function, WHOLE), prepare)


def test_partitions():
    extents = pieces((2, 1, RANKS))[2 * RANK : 2 * RANK + 2]
    parts = vtk.vtkPartitionedDataSet()
    for n, extent in enumerate(extents):
        parts.SetPartition(n, image_of(waves, extent))
    expect_same("two partitions per process", parts, image_of(waves, WHOLE))


def test_source():
    extent = (-12, 12, -10, 10, -9, 9)
    source = vtk.vtkRTAnalyticSource()
    source.SetWholeExtent(*extent)
    whole = vtk.vtkRTAnalyticSource()
    whole.SetWholeExtent(*extent)
    expect_same("a source that gives any piece", source, whole, options(Level=157))


def test_blocks():
    """Blocks that other processes have are null."""
    blocks = vtk.vtkMultiBlockDataSet()
    for n, extent in enumerate(pieces((2, 1, RANKS))):
        blocks.SetBlock(n, image_of(waves, extent) if n // 2 == RANK else None)
    expect_same("blocks", blocks, image_of(waves, WHOLE))


def test_samples_at_the_level():
    """Integers have the level at many points."""
    for level in (0, 3, 5):
        expect_same(f"steps at {level}", image_of(steps, pieces((1, 1, RANKS))[RANK]), image_of(steps, WHOLE),
                    options(Level=level, Attributes="normal"))


def test_parts_that_are_not_those_of_the_source():
    """A simulation tells the whole extent, and has cut it in its own way."""
    source = vtk.vtkTrivialProducer()
    source.SetOutput(image_of(waves, pieces((RANKS, 1, 1) if RANKS < 4 else (2, 2, 1))[RANKS - 1 - RANK]))
    source.SetWholeExtent(WHOLE)
    expect_same("parts of a simulation", source, image_of(waves, WHOLE), options(SplineDegree=5))


def noisy(i, j, k):
    """Waves with much noise."""
    noise = ((i * 7919 + j * 104729 + k * 1299709) % 1009) / 1009 - 0.5
    return (np.sin(0.12 * i) + np.cos(0.11 * j) * np.sin(0.1 * k) + 0.05 * noise).astype(np.float32)


def test_automatic_smoothing():
    """All processes together choose the scale that one chooses."""
    source = vtk.vtkTrivialProducer()  # which gives as many ghost levels as are wanted
    source.SetOutput(image_of(noisy, WHOLE))
    source.SetWholeExtent(WHOLE)
    prepare = options(AutomaticSmoothing=True, SplineDegree=5, Attributes="affine_mean_curvature")
    expect_same("automatic smoothing", source, image_of(noisy, WHOLE), prepare)
    chosen = smoothing_of(surface(source, prepare, CONTROLLER))
    assert chosen >= 1.5, chosen
    if RANKS <= 2:  # others are too thin
        expect_same("automatic smoothing of images", image_of(noisy, pieces((1, 1, RANKS))[RANK]), image_of(noisy, WHOLE),
                    prepare)
    if RANKS == 2:
        empty = vtk.vtkImageData()
        expect_same("automatic smoothing beside an empty process", empty if RANK else image_of(noisy, WHOLE),
                    image_of(noisy, WHOLE), prepare)
    for piece in range(2 * RANK, 2 * RANK + 2):  # more pieces than processes
        surface_filter = vtkEquiaffineSurface()
        prepare(surface_filter)
        surface_filter.SetInputConnection(source.GetOutputPort())
        surface_filter.UpdatePiece(piece, 2 * RANKS, 0)
        assert smoothing_of(surface_filter.GetOutput()) == chosen


def smoothing_of(mesh):
    return mesh.GetFieldData().GetArray("smoothing").GetValue(0)


def test_update_without_a_piece():
    """Every process makes its piece, also if nobody says so."""
    source = vtk.vtkTrivialProducer()
    source.SetOutput(image_of(ball, WHOLE))
    source.SetWholeExtent(WHOLE)
    surface_filter = vtkEquiaffineSurface()
    surface_filter.SetInputConnection(source.GetOutputPort())
    surface_filter.SetLevel(20)
    surface_filter.Update()
    assert surface_filter.GetOutput().GetFieldData().GetArray("vertices").GetValue(0) == 352


def test_errors_of_pieces():
    """Where nobody has the whole image, K is not what is shown first, and one process says why."""
    messages = []
    surface_filter = vtkEquiaffineSurface()
    surface_filter.AddObserver("WarningEvent", lambda *_: messages.append(1))
    surface_filter.SetInputData(image_of(waves, pieces((1, 1, RANKS))[RANK]))
    surface_filter.UpdatePiece(RANK, RANKS, 0)
    data = surface_filter.GetOutput().GetPointData()
    has_errors = data.GetArray("affine_gaussian_curvature_error") is not None
    assert has_errors == (RANKS == 1)
    assert data.GetScalars().GetName() == "mean_curvature"
    assert RANKS == 1 or len(messages) == (RANK == 0)


def expect_errors(image, pieces_of_process=1, **properties):
    """Expects one sentence and an empty surface in every process, for the first of its pieces."""
    messages = []
    surface_filter = vtkEquiaffineSurface()
    surface_filter.AddObserver("ErrorEvent", lambda *_: messages.append(1))
    options(**properties)(surface_filter)
    surface_filter.SetInputData(image)
    surface_filter.UpdatePiece(pieces_of_process * RANK, pieces_of_process * RANKS, 0)
    assert len(messages) == 1 and surface_filter.GetOutput().GetNumberOfPoints() == 0


def test_more_pieces_than_processes():
    """An image in memory is one piece of its process. More are asked for in vain."""
    if RANKS > 1:
        expect_errors(image_of(waves, pieces((1, 1, RANKS))[RANK]), pieces_of_process=2)


def test_processes_that_differ():
    if RANKS == 1:
        return
    extent = pieces((1, 1, RANKS))[RANK]
    expect_errors(image_of(waves, extent), SplineDegree=5 if RANK else 7)
    expect_errors(image_of(waves, extent), AutomaticSmoothing=RANK > 0)
    expect_errors(image_of(waves, extent), Attributes="all" if RANK else "normal")
    expect_errors(image_of(waves if RANK else ball, extent))
    moved = image_of(waves, extent)
    moved.SetOrigin(0.1, 0.2, -3 + RANK)
    expect_errors(moved)
    short = image_of(waves, extent)
    if RANK == 0:
        short.GetPointData().GetScalars().SetNumberOfTuples(100)
    expect_errors(short)


def test_empty_processes():
    """All but two processes have nothing, and one of these has no surface."""
    parts = pieces((1, 1, min(RANKS, 2)))
    image = image_of(ball, parts[RANK]) if RANK < len(parts) else vtk.vtkImageData()
    expect_same("empty processes", image, image_of(ball, WHOLE), options(Level=20))


def test_failure_of_one():
    """Where one process has no scalars all have an empty output, and none waits for the others."""
    image = image_of(waves, pieces((1, 1, RANKS))[RANK])
    if RANK == RANKS - 1:
        image.GetPointData().Initialize()
    expect_errors(image)


def test_thin_pieces():
    """Only pieces beside each other exchange points. Where a piece needs those beyond, the sentence says so."""
    parts = cuts(10, 26, RANKS)
    thin = image_of(waves, WHOLE[:4] + parts[RANK])
    messages = []
    surface_filter = vtkEquiaffineSurface()
    surface_filter.AddObserver("ErrorEvent", lambda *_: messages.append(1))
    surface_filter.SetInputData(thin)
    surface_filter.UpdatePiece(RANK, RANKS, 0)
    assert len(messages) == (RANKS > 2) and (surface_filter.GetOutput().GetNumberOfPoints() > 0) == (RANKS <= 2)


def main():
    test_images()
    test_partitions()
    test_source()
    test_empty_processes()
    test_blocks()
    test_samples_at_the_level()
    test_parts_that_are_not_those_of_the_source()
    test_automatic_smoothing()
    test_update_without_a_piece()
    test_errors_of_pieces()
    test_failure_of_one()
    test_more_pieces_than_processes()
    test_processes_that_differ()
    test_thin_pieces()


try:
    main()
except BaseException:
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)  # mpirun ends the other processes, which may wait for this one
