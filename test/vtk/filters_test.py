# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the filters for VTK in one process. PYTHONPATH has the folder of their module."""
import unittest

import numpy as np
import vtk
from equiaffine_vtk.equiaffineVTK import vtkEquiaffineCurvatures, vtkEquiaffineFunction, vtkEquiaffineSurface
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

RADII = np.array([7.0, 5.0, 6.0])


def ellipsoid(size=20, dtype=np.float64):
    """An image of a quadratic function, which splines reproduce, that is 0 on an ellipsoid."""
    image = vtk.vtkImageData()
    image.SetDimensions(size, size, size)
    image.SetOrigin(*[-(size - 1) / 2] * 3)
    k, j, i = np.mgrid[:size, :size, :size] - (size - 1) / 2
    set_scalars(image, (400 * ((i / RADII[0]) ** 2 + (j / RADII[1]) ** 2 + (k / RADII[2]) ** 2 - 1)).astype(dtype))
    return image


def set_scalars(image, values, name="samples"):
    array = numpy_to_vtk(values.ravel(), deep=1)
    array.SetName(name)
    image.GetPointData().SetScalars(array)


def surface(image, **properties):
    surface_filter = vtkEquiaffineSurface()
    surface_filter.SetInputData(image)
    for name, value in properties.items():
        getattr(surface_filter, "Set" + name)(value)
    surface_filter.Update()
    return surface_filter.GetOutput()


def with_warnings(image, **properties):
    """The surface of an image, and what the filter warns of."""
    surface_filter, messages = vtkEquiaffineSurface(), []

    def keep(_, __, text):
        messages.append(text)

    keep.CallDataType = "string0"
    surface_filter.AddObserver("WarningEvent", keep)
    surface_filter.SetInputData(image)
    for name, value in properties.items():
        getattr(surface_filter, "Set" + name)(value)
    surface_filter.Update()
    return surface_filter.GetOutput(), messages


def ball(change, size=60):
    """An image of a change of the distance from the middle."""
    image = ellipsoid(size)
    k, j, i = np.mgrid[:size, :size, :size] - (size - 1) / 2
    set_scalars(image, change(np.sqrt(i ** 2 + j ** 2 + k ** 2)))
    return image


def points(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def array(mesh, name):
    return vtk_to_numpy(mesh.GetPointData().GetArray(name))


class Surface(unittest.TestCase):
    def test_an_ellipsoid_has_the_affine_curvatures_of_the_sphere_of_its_volume(self):
        mesh = surface(ellipsoid())
        self.assertGreater(mesh.GetNumberOfPolys(), 500)
        np.testing.assert_allclose(((points(mesh) / RADII) ** 2).sum(axis=1), 1, atol=1e-12)
        radius = RADII.prod() ** (1 / 3)  # of the sphere
        curvature = radius ** -1.5
        np.testing.assert_allclose(np.abs(array(mesh, "affine_mean_curvature")), curvature, rtol=1e-6)
        np.testing.assert_allclose(array(mesh, "affine_gaussian_curvature"), curvature ** 2, rtol=1e-6)
        np.testing.assert_allclose(array(mesh, "pick_invariant"), 0, atol=1e-6)
        gradient = points(mesh) / RADII ** 2
        normal = gradient / np.linalg.norm(gradient, axis=1)[:, None]
        np.testing.assert_allclose(array(mesh, "normal"), normal, atol=1e-10)
        for name in ("direction1", "direction2"):
            np.testing.assert_allclose((array(mesh, name) * normal).sum(axis=1), 0, atol=1e-8)
        self.assertEqual(mesh.GetPointData().GetNormals().GetName(), "normal")
        self.assertEqual(mesh.GetPointData().GetArray("metric").GetNumberOfComponents(), 6)
        self.assertEqual(set(array(mesh, "status")), {0})
        field = mesh.GetFieldData()
        self.assertEqual(field.GetArray("vertices").GetValue(0), mesh.GetNumberOfPoints())
        self.assertEqual(field.GetArray("triangles").GetValue(0), mesh.GetNumberOfPolys())
        self.assertAlmostEqual(field.GetArray("affine_gaussian_curvature_range").GetComponent(0, 1), curvature ** 2)

    def test_smoothing_is_chosen_so_that_a_mask_does_not_take_the_surface_away(self):
        image = ellipsoid(60)
        k, j, i = np.mgrid[:60, :60, :60] - 29.5
        values = np.sqrt(i ** 2 + j ** 2 + k ** 2) - 12 + np.random.default_rng(1).normal(0, 0.1, (60, 60, 60))
        values[values > 20] = np.nan
        set_scalars(image, values)
        mesh = surface(image, AutomaticSmoothing=True, Attributes="normal")
        self.assertGreater(mesh.GetFieldData().GetArray("smoothing").GetValue(0), 1)
        self.assertGreater(mesh.GetNumberOfPoints(), 2000)

    def test_pieces_that_are_made_one_after_the_other_are_smoothed_alike(self):
        whole = ellipsoid(48)
        set_scalars(whole, vtk_to_numpy(whole.GetPointData().GetScalars()) + np.random.default_rng(1).normal(0, 9, 48 ** 3))
        parts = vtk.vtkPartitionedDataSet()
        parts.SetPartition(0, whole)
        scales = []
        for data in (whole, parts):
            for piece in range(2):
                surface_filter = vtkEquiaffineSurface()
                surface_filter.SetInputDataObject(data)
                surface_filter.SetAutomaticSmoothing(True)
                surface_filter.UpdatePiece(piece, 2, 0)
                scales.append(surface_filter.GetOutput().GetFieldData().GetArray("smoothing").GetValue(0))
        self.assertGreater(scales[0], 1)
        self.assertEqual(scales, [scales[0]] * 4)

    def test_smoothing_is_chosen_from_the_noise(self):
        image = ellipsoid(64)
        k, j, i = np.mgrid[:64, :64, :64]
        waves = image.NewInstance()
        waves.CopyStructure(image)
        set_scalars(waves, np.sin(0.4 * i) + np.sin(0.5 * j) + np.sin(0.6 * k))
        smooth = surface(waves, AutomaticSmoothing=True, Attributes="none")
        self.assertEqual(smooth.GetFieldData().GetArray("smoothing").GetValue(0), 0)
        random = np.random.default_rng(1)
        set_scalars(image, vtk_to_numpy(image.GetPointData().GetScalars()) + random.normal(0, 3, 64 ** 3))
        chosen = surface(image, AutomaticSmoothing=True)
        scale = chosen.GetFieldData().GetArray("smoothing").GetValue(0)
        self.assertGreaterEqual(scale, 1.5)
        same = surface(image, Smoothing=scale)
        np.testing.assert_array_equal(points(chosen), points(same))
        np.testing.assert_array_equal(array(chosen, "pick_invariant"), array(same, "pick_invariant"))

    def test_noise_is_not_shown_as_a_curvature(self):
        def noisy(r):
            return r - 20 + np.random.default_rng(1).normal(0, 0.1, r.shape)

        mesh, messages = with_warnings(ball(noisy))
        K, error = array(mesh, "affine_gaussian_curvature"), array(mesh, "affine_gaussian_curvature_error")
        self.assertEqual(mesh.GetPointData().GetScalars().GetName(), "mean_curvature")
        self.assertGreater(np.isnan(K).mean(), 0.9)
        self.assertEqual(len(messages), 2)
        self.assertIn("Affine Gaussian curvature is unknown at 98 % of the vertices", messages[0])
        self.assertAlmostEqual(mesh.GetFieldData().GetArray("noise").GetValue(0), 0.1, delta=0.005)

        shown, messages = with_warnings(ball(noisy), HideUnknown=False)
        all_K = array(shown, "affine_gaussian_curvature")
        self.assertEqual(len(messages), 2)
        self.assertTrue(np.isfinite(all_K[array(shown, "status") == 0]).all())
        np.testing.assert_array_equal(K[np.isfinite(K)], all_K[np.isfinite(K)])
        size = np.abs(all_K) + array(shown, "affine_mean_curvature") ** 2
        self.assertTrue((error <= size / 2)[np.isfinite(K)].all())

        plain, messages = with_warnings(ball(noisy), EstimateErrors=False)
        self.assertEqual(messages, [])
        self.assertIsNone(plain.GetPointData().GetArray("affine_gaussian_curvature_error"))
        np.testing.assert_array_equal(array(plain, "affine_gaussian_curvature"), all_K)

    def test_what_is_known_is_shown(self):
        mesh, messages = with_warnings(ball(lambda r: r - 20))
        self.assertEqual(messages, [])
        self.assertEqual(mesh.GetPointData().GetScalars().GetName(), "affine_gaussian_curvature")
        off = np.abs(array(mesh, "affine_gaussian_curvature") - 20.0 ** -3)
        self.assertTrue((off <= array(mesh, "affine_gaussian_curvature_error")).mean() > 0.95)

    def test_curvatures_of_a_mask_are_those_of_its_steps(self):
        def mask(r):
            return (r < 20).astype(np.uint8)

        mesh, messages = with_warnings(ball(mask), Level=0.5)
        self.assertEqual(mesh.GetPointData().GetScalars().GetName(), "mean_curvature")
        self.assertIn("the samples have only 2 distinct values, and the curvatures show the steps between them",
                      messages[0])
        messages = with_warnings(ball(mask), Level=0.5, AutomaticSmoothing=True)[1]
        self.assertFalse(any("distinct values" in message for message in messages))
        self.assertEqual(with_warnings(ball(mask), Level=0.5, Attributes="none")[1], [])

    def test_triangles_are_turned_to_the_side_of_normals_on_grids_of_both_hands(self):
        for matrix in ((1, 0, 0, 0, 1, 0, 0, 0, 1), (-1, 0, 0, 0, 1, 0, 0, 0, 1), (0, 1, 0, 0.6, 0, 0.8, -0.8, 0, 0.6)):
            for against in (0, 1):
                image = ellipsoid()
                image.SetDirectionMatrix(matrix)
                image.SetSpacing(0.2, 0.7, 1.3)
                mesh = surface(image, Orientation=against)
                triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
                a, b, c = (points(mesh)[triangles[:, n]] for n in range(3))
                sides = (np.cross(b - a, c - a) * array(mesh, "normal")[triangles[:, 0]]).sum(axis=1)
                self.assertTrue((sides > 0).all())
                edges = vtk.vtkFeatureEdges()
                edges.SetInputData(mesh)
                edges.FeatureEdgesOff()
                edges.Update()
                self.assertEqual(edges.GetOutput().GetNumberOfCells(), 0, "the mesh has a boundary")

    def test_every_type_of_numbers_and_every_layout_gives_the_same(self):
        expected = points(surface(ellipsoid(dtype=np.int32), Level=20.5))
        for dtype in (np.int16, np.int64, np.float32, np.float64):
            image = ellipsoid(dtype=np.int32)
            set_scalars(image, vtk_to_numpy(image.GetPointData().GetScalars()).astype(dtype))
            np.testing.assert_array_equal(points(surface(image, Level=20.5)), expected, str(dtype))
        image = ellipsoid(dtype=np.int32)
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        vectors = numpy_to_vtk(np.column_stack([values * 0, values]), deep=1)
        vectors.SetName("vectors")
        image.GetPointData().SetScalars(vectors)
        np.testing.assert_array_equal(points(surface(image, Level=20.5, ArrayComponent=1)), expected)
        separate = vtk.vtkSOADataArrayTemplate["float64"]()  # each component has a memory of its own
        separate.DeepCopy(vectors)
        separate.SetName("vectors")
        image.GetPointData().SetScalars(separate)
        np.testing.assert_array_equal(points(surface(image, Level=20.5, ArrayComponent=1)), expected)

    def test_an_extent_may_begin_anywhere(self):
        image = ellipsoid()
        expected = points(surface(image))
        moved = vtk.vtkImageData()
        moved.ShallowCopy(image)
        moved.SetExtent(5, 24, -7, 12, 100, 119)
        moved.SetOrigin(*(np.array(image.GetOrigin()) - [5, -7, 100]))
        np.testing.assert_allclose(points(surface(moved)), expected, atol=1e-12)

    def test_pieces_and_ghost_cells_of_one_process_are_those_of_the_whole(self):
        source = vtk.vtkRTAnalyticSource()
        source.SetWholeExtent(-10, 10, -10, 10, -10, 10)
        surface_filter = vtkEquiaffineSurface()
        surface_filter.SetInputConnection(source.GetOutputPort())
        surface_filter.SetLevel(157)
        surface_filter.Update()
        whole = vtk.vtkPolyData()
        whole.DeepCopy(surface_filter.GetOutput())

        def triangles_of(mesh, cells=slice(None)):
            ids = array(mesh, "vertex_id")[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
            return {tuple(t) for t in ids[cells]}

        for ghosts in (0, 1):
            owned = []
            for piece in range(5):
                surface_filter.UpdatePiece(piece, 5, ghosts)
                mesh = surface_filter.GetOutput()
                if mesh.GetNumberOfPolys() == 0:
                    continue
                marks = mesh.GetCellData().GetArray("vtkGhostType")
                self.assertEqual(marks is not None, ghosts > 0)
                own = vtk_to_numpy(marks) == 0 if marks else slice(None)
                owned += triangles_of(mesh, own)
                self.assertLessEqual(triangles_of(mesh), triangles_of(whole))
            self.assertEqual(len(owned), whole.GetNumberOfPolys())
            self.assertEqual(set(owned), triangles_of(whole))

    def test_pieces_of_one_process_are_those_of_the_whole_where_samples_are_the_level(self):
        k, j, i = np.mgrid[:49, :49, :49]
        image = vtk.vtkImageData()
        image.SetDimensions(49, 49, 49)
        set_scalars(image, np.round(6 * np.sin(.35 * i) * np.cos(.3 * j) + 4 * np.sin(.33 * k)).astype(np.int16))
        count = 0
        for piece in range(16):
            surface_filter = vtkEquiaffineSurface()
            surface_filter.SetInputData(image)
            surface_filter.SetAttributes("none")
            surface_filter.UpdatePiece(piece, 16, 0)
            count += surface_filter.GetOutput().GetNumberOfPolys()
        self.assertEqual(count, surface(image, Attributes="none").GetNumberOfPolys())

    def test_partitions_belong_to_the_first_piece(self):
        image = ellipsoid()
        parts = vtk.vtkPartitionedDataSet()
        parts.SetPartition(0, image)
        counts = []
        for piece in range(3):
            surface_filter = vtkEquiaffineSurface()
            surface_filter.SetInputDataObject(parts)
            surface_filter.UpdatePiece(piece, 3, 0)
            counts.append(surface_filter.GetOutput().GetNumberOfPolys())
        self.assertEqual(counts, [surface(image).GetNumberOfPolys(), 0, 0])

    def test_smoothing_needs_more_ghost_levels(self):
        wide = vtkEquiaffineSurface()
        wide.SetSmoothing(4)
        self.assertGreater(wide.GetNumberOfGhostLevels(), vtkEquiaffineSurface().GetNumberOfGhostLevels())

    def test_attributes_are_chosen(self):
        mesh = surface(ellipsoid(), Attributes="nx,mean_curvature")
        names = {mesh.GetPointData().GetArrayName(n) for n in range(mesh.GetPointData().GetNumberOfArrays())}
        self.assertEqual(names, {"vertex_id", "nx", "mean_curvature", "status"})
        none = surface(ellipsoid(), Attributes="none").GetPointData()
        self.assertEqual([none.GetArrayName(n) for n in range(none.GetNumberOfArrays())], ["vertex_id"])

    def test_mistakes_are_one_sentence_and_an_empty_surface(self):
        def without_scalars(image):
            image.GetPointData().Initialize()

        def one_slab(image):
            image.SetDimensions(20, 20, 1)
            set_scalars(image, np.arange(400.0))

        def nan(image):
            set_scalars(image, np.full(8000, np.nan))

        def strings(image):
            names = vtk.vtkStringArray()
            names.SetNumberOfTuples(8000)
            image.GetPointData().Initialize()
            image.GetPointData().AddArray(names)

        def short(image):
            image.GetPointData().Initialize()
            data = numpy_to_vtk(np.arange(17.0), deep=1)
            data.SetName("samples")
            image.GetPointData().SetScalars(data)

        cases = [(without_scalars, {}, "the selected point array does not exist"),
                 (one_slab, {}, "too few points of the image along axis k: 1, but"),
                 (nan, {}, "no finite values"), (strings, {}, "the selected point array does not exist"),
                 (short, {}, "not have one tuple per point"), (None, {"Attributes": "foo"}, "unknown attribute 'foo'"),
                 (None, {"Attributes": "vertex_area"}, "a mesh with faces"),
                 (None, {"SplineDegree": 6}, "not 5, 7 or 9"), (None, {"Level": float("nan")}, "not finite"),
                 (None, {"ArrayComponent": 2}, "has 1 component, so there is no component 2")]
        for change, properties, words in cases:
            image = ellipsoid()
            if change:
                change(image)
            messages = []
            surface_filter = vtkEquiaffineSurface()

            def keep(_, __, text):
                messages.append(text)

            keep.CallDataType = "string0"
            surface_filter.AddObserver("ErrorEvent", keep)
            for name, value in properties.items():
                getattr(surface_filter, "Set" + name)(value)
            surface_filter.SetInputData(image)
            surface_filter.Update()
            self.assertEqual(len(messages), 1, words)
            self.assertIn(words, messages[0])
            self.assertEqual(surface_filter.GetOutput().GetNumberOfPoints(), 0)

    def test_progress_is_reported_and_work_may_be_aborted(self):
        surface_filter = vtkEquiaffineSurface()
        surface_filter.SetInputData(ellipsoid(40))
        parts = []
        surface_filter.AddObserver("ProgressEvent", lambda *_: parts.append(surface_filter.GetProgress()))
        surface_filter.Update()
        self.assertEqual(parts, sorted(parts))
        self.assertEqual(parts[-1], 1)
        self.assertGreater(surface_filter.GetOutput().GetNumberOfPoints(), 0)
        surface_filter.AddObserver("ProgressEvent", lambda *_: surface_filter.AbortExecuteOn())
        surface_filter.Modified()
        surface_filter.Update()
        self.assertEqual(surface_filter.GetOutput().GetNumberOfPoints(), 0)

    def test_an_implicit_function_of_VTK_is_a_source(self):
        sphere = vtk.vtkSphere()
        sphere.SetRadius(0.8)
        sample = vtk.vtkSampleFunction()
        sample.SetImplicitFunction(sphere)
        sample.SetModelBounds(-1, 1, -1, 1, -1, 1)
        sample.SetSampleDimensions(20, 20, 20)
        sample.ComputeNormalsOff()
        surface_filter = vtkEquiaffineSurface()
        surface_filter.SetInputConnection(sample.GetOutputPort())
        surface_filter.Update()
        np.testing.assert_allclose(np.linalg.norm(points(surface_filter.GetOutput()), axis=1), 0.8, atol=1e-6)


class Curvatures(unittest.TestCase):
    def test_a_sphere_has_its_curvatures_within_the_estimated_errors(self):
        sphere = vtk.vtkSphereSource()
        sphere.SetRadius(2)
        sphere.SetThetaResolution(40)
        sphere.SetPhiResolution(40)
        sphere.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        curvatures = vtkEquiaffineCurvatures()
        curvatures.SetInputConnection(sphere.GetOutputPort())
        curvatures.Update()
        mesh = curvatures.GetOutput()
        self.assertEqual(mesh.GetNumberOfPolys(), sphere.GetOutput().GetNumberOfPolys())
        self.assertLess(np.abs(array(mesh, "gaussian_curvature") - 0.25).max(), 1e-3)
        error = np.abs(array(mesh, "gaussian_curvature") - 0.25)
        self.assertTrue((error <= array(mesh, "gaussian_curvature_error")).mean() > 0.95)
        self.assertEqual(set(array(mesh, "status")), {0})

        curvatures.SetAttributes("vertex_area")
        curvatures.Update()
        area = vtk.vtkMassProperties()
        area.SetInputConnection(sphere.GetOutputPort())
        self.assertAlmostEqual(array(curvatures.GetOutput(), "vertex_area").sum() / area.GetSurfaceArea(), 1, places=9)
        curvatures.SetAttributes("all")

        strips = vtk.vtkStripper()
        strips.SetInputConnection(sphere.GetOutputPort())
        curvatures.SetInputConnection(strips.GetOutputPort())
        curvatures.Update()
        np.testing.assert_allclose(np.abs(array(curvatures.GetOutput(), "gaussian_curvature")), 0.25, atol=1e-3)

        cloud = vtk.vtkPolyData()
        cloud.SetPoints(sphere.GetOutput().GetPoints())
        curvatures.SetInputData(cloud)
        curvatures.Update()
        error = np.abs(array(curvatures.GetOutput(), "gaussian_curvature") - 0.25)
        self.assertTrue((error <= array(curvatures.GetOutput(), "gaussian_curvature_error") + 1e-3).mean() > 0.95)

    def test_mistakes_are_one_sentence(self):
        sphere = vtk.vtkSphereSource()
        sphere.Update()
        bad = vtk.vtkPolyData()
        bad.DeepCopy(sphere.GetOutput())
        bad.GetPoints().SetPoint(3, float("nan"), 0, 0)
        for data, properties in ((bad, {}), (sphere.GetOutput(), {"Degree": 3}), (sphere.GetOutput(), {"Scale": 1e9}),
                                 (sphere.GetOutput(), {"Attributes": "foo"})):
            curvatures = vtkEquiaffineCurvatures()
            messages = []
            curvatures.AddObserver("ErrorEvent", lambda *_: messages.append(1))
            for name, value in properties.items():
                getattr(curvatures, "Set" + name)(value)
            curvatures.SetInputData(data)
            curvatures.Update()
            self.assertEqual((len(messages), curvatures.GetOutput().GetNumberOfPoints()), (1, 0), properties)
        empty = vtkEquiaffineCurvatures()
        empty.SetInputData(vtk.vtkPolyData())
        empty.Update()
        self.assertEqual(empty.GetOutput().GetNumberOfPoints(), 0)


class Function(unittest.TestCase):
    def test_a_formula_is_an_implicit_function(self):
        function = vtkEquiaffineFunction()
        self.assertEqual(function.EvaluateFunction([1, 2, 3]), 0)
        function.SetFormula("x^2*y + sin(z)")
        self.assertAlmostEqual(function.EvaluateFunction([2, 3, 0.5]), 12 + np.sin(0.5))
        gradient = [0, 0, 0]
        function.EvaluateGradient([2, 3, 0.5], gradient)
        np.testing.assert_allclose(gradient, [12, 4, np.cos(0.5)])
        messages = []
        function.AddObserver("ErrorEvent", lambda *_: messages.append(1))
        function.SetFormula("x^")
        self.assertEqual(len(messages), 1)
        self.assertAlmostEqual(function.EvaluateFunction([2, 3, 0.5]), 12 + np.sin(0.5))


if __name__ == "__main__":
    unittest.main()
