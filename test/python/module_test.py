# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests what the module for Python computes, beside the program of the same build: EQUIAFFINE_PROGRAM names it."""
import doctest
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

import numpy as np

import equiaffine as ea
from module_support import BLOBBY, InTemporaryFolder, run_program


def edges_are_paired(F):
    """Whether each edge has two triangles, which run along it in both directions."""
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    _, counts = np.unique(edges, axis=0, return_counts=True)
    forth = set(map(tuple, edges.tolist()))
    return bool((counts == 1).all()) and all((b, a) in forth for a, b in forth)


class SameAsProgram(InTemporaryFolder):
    def test_formulas(self):
        path = self.folder / "a.ply"
        run_program("mesh", "--function", BLOBBY, "--box", -1.2, 1.2, -1.2, 1.2, -1.2, 1.2, "--resolution", 40, "-o", path)
        self.assert_same(ea.mesh(BLOBBY, box=1.2, resolution=40), ea.read(path))

    def test_delaunay_meshes(self):
        path = self.folder / "a.ply"
        run_program("mesh", "--function", "x^2 + 2*y^2 + z^2 = 1", "--box", -2, 2, -2, 2, -2, 2, "--method", "delaunay",
                    "--radius", 0.3, "-o", path)
        self.assert_same(ea.mesh("x^2 + 2*y^2 + z^2 = 1", box=2, method="delaunay", radius=0.3), ea.read(path))

    def test_volumes_of_any_type_and_strides(self):
        x, y, z = np.mgrid[-1:1:20j, -1:1:17j, -1:1:15j]
        values = 200 * np.exp(-x**2 - 2 * y**2 - 3 * z**2 - 0.5 * x * y)
        for dtype in (np.uint8, np.int16, np.float32, np.float64, ">f8", np.float16):
            samples = values.astype(dtype)
            volume = ea.Volume(samples.astype(float), (0.1, 0.12, 0.13), (1, 2, 3))
            volume.save(self.folder / "v.nrrd")
            run_program("mesh", "--volume", self.folder / "v.nrrd", "--level", 100, "-o", self.folder / "v.ply")
            expected = ea.read(self.folder / "v.ply")
            twice = np.repeat(np.repeat(samples, 2, axis=0), 3, axis=2)
            for array in (samples, np.asfortranarray(samples), twice[::2, :, ::3], samples[::-1, ::-1][::-1, ::-1]):
                found = ea.mesh(array, level=100, spacing=(0.1, 0.12, 0.13), origin=(1, 2, 3))
                np.testing.assert_array_equal(found.F, expected.F, err_msg=str(dtype))
                np.testing.assert_array_equal(found.V, expected.V, err_msg=str(dtype))

    def test_curvatures_of_meshes_and_points(self):
        surface = ea.mesh("x^2 + 2*y^2 + 3*z^2 = 1", box=1.1, resolution=16, attributes="none")
        surface.save(self.folder / "a.ply")
        np.savetxt(self.folder / "a.xyz", surface.V, fmt="%.17g")
        for name, F in (("a.ply", surface.F), ("a.xyz", None)):
            run_program("annotate", self.folder / name, "--attributes", "all", "-o", self.folder / "b.ply")
            found = ea.curvatures(surface.V, F)
            self.assert_same(found, ea.read(self.folder / "b.ply"))
            self.assertIn("affine_gaussian_curvature_error", found)

    def test_registration_and_symmetries(self):
        surface = ea.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=24)
        surface.save(self.folder / "a.ply")
        shear = np.array([[1, 0.5, 0], [0.1, 1, 0.2], [0, 0.3, 1]])
        moved = ea.Surface(surface.V @ shear.T + [1, 2, 3], surface.F)
        moved.save(self.folder / "b.ply")
        by_arrays = ea.register(surface, (moved.V, moved.F))
        by_files = ea.register(self.folder / "a.ply", self.folder / "b.ply")
        self.assertTrue(by_arrays)
        np.testing.assert_array_equal(by_arrays.matrix, by_files.matrix)
        np.testing.assert_allclose(by_arrays.matrix[:3, :3], shear, atol=1e-3)
        np.testing.assert_allclose(by_arrays.apply(surface.V), moved.V, atol=5e-3)
        self.assertLess(by_arrays.log10_false_alarms, -6)
        found, from_file = ea.symmetries(surface), ea.symmetries(self.folder / "a.ply")
        self.assertEqual(found.report["order"], from_file.report["order"])
        self.assertEqual(found.summary, from_file.summary)


class Sources(InTemporaryFolder):
    def test_a_function_of_arrays_is_sampled(self):
        found = ea.mesh(lambda x, y, z: x**2 + y**2 + z**2, level=0.5, box=1, resolution=(20, 21, 22))
        np.testing.assert_allclose(np.linalg.norm(found.V, axis=1), 0.5**0.5, atol=1e-10)
        np.testing.assert_allclose(found["gaussian_curvature"], 2, atol=1e-6)

    def test_directions_of_a_volume_are_obeyed(self):
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
        x, y, z = np.mgrid[-1:1:20j, -1:1:20j, -1:1:20j]
        found = ea.mesh(x**2 + 2 * y**2 + 3 * z**2, level=0.5, spacing=2 / 19, origin=turn @ (-1, -1, -1), direction=turn)
        u, v, w = turn.T @ found.V.T
        np.testing.assert_allclose(u**2 + 2 * v**2 + 3 * w**2, 0.5, atol=1e-9)

    def test_a_fit_is_used_again(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=24)
        f = ea.fit(ball.V, ball.F)
        points = np.array([[0, 0, 1.02], [0.98, 0, 0], [0, 3, 0]])
        values = f(points)
        np.testing.assert_allclose(values[:2], [0.02, -0.02], atol=1e-3)
        self.assertTrue(np.isnan(values[2]))
        again = f.mesh(resolution=30)
        np.testing.assert_allclose(np.linalg.norm(again.V, axis=1), 1, atol=1e-4)
        at = f.evaluate(ball.V[:10], attributes="all")
        np.testing.assert_allclose(at["gaussian_curvature"], 1, atol=1e-2)

    def test_a_fit_is_fitted_again_after_pickling(self):
        ball = ea.mesh("x^2 + 2*y^2 + z^2 = 1", box=1.2, resolution=16)
        points = ball.V * 1.01
        fit = ea.fit(ball.V, ball.F, scale=0.5)
        again = pickle.loads(pickle.dumps(fit))
        np.testing.assert_array_equal(again(points), fit(points))
        self.assertEqual(again.scale, 0.5)

    def test_curvatures_are_those_that_are_asked_for_with_their_errors(self):
        ball = ea.mesh("x^2 + 2*y^2 + z^2 = 1", box=1.2, resolution=12)
        for attributes, names in {"none": set(), "k1": {"k1", "k1_error"}}.items():
            self.assertEqual(set(ea.curvatures(ball.V, ball.F, attributes=attributes)), names)
        self.assertEqual(set(ea.curvatures(ball.V, ball.F, attributes=["affine_normal"])),
                         {"affine_normal_x", "affine_normal_y", "affine_normal_z", "affine_normal_error"})

    def test_areas_add_up_to_those_of_the_surface(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=16, attributes=["vertex_area", "affine_area"])
        corners = ball.V[ball.F]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(normals, axis=1).sum() / 2
        for name in ("vertex_area", "affine_area"):
            self.assertAlmostEqual(ball[name].sum() / area, 1, places=9)
        fitted = ea.curvatures(ball.V, ball.F, attributes="vertex_area")
        np.testing.assert_array_equal(fitted["vertex_area"], ball["vertex_area"])
        with self.assertRaisesRegex(ValueError, "vertex_area"):
            ea.curvatures(ball.V, attributes="vertex_area")

    def test_a_surface_reports_what_was_measured_and_chosen(self):
        x, y, z = np.mgrid[-1:1:40j, -1:1:40j, -1:1:40j]
        samples = (x**2 + y**2 + z**2 + np.random.default_rng(3).normal(0, 1e-3, x.shape)).astype(np.float32)
        report = ea.mesh(samples, level=0.5, smoothing="auto").report
        self.assertAlmostEqual(report["noise"], 1e-3, delta=1e-4)
        self.assertGreater(report["smoothing"], 1)
        self.assertLess(report["max_distance"], 1e-9)

    def test_noise_of_a_volume_is_not_shown_as_fact(self):
        x, y, z = np.mgrid[-1:1:40j, -1:1:40j, -1:1:40j]
        noisy = x**2 + y**2 + z**2 + np.random.default_rng(3).normal(0, 1e-3, x.shape)
        found = ea.mesh(noisy, level=0.5, spacing=2 / 39, origin=(-1, -1, -1))
        self.assertGreater(np.median(found["affine_gaussian_curvature_error"]), 10)
        ea.view(found, self.folder / "page.html")
        self.assertIn("affine Gaussian curvature is unknown at", (self.folder / "page.html").read_text().replace("Affine", "affine"))
        smooth = ea.mesh(noisy, level=0.5, spacing=2 / 39, origin=(-1, -1, -1), smoothing="auto")
        self.assertLess(np.median(smooth["affine_gaussian_curvature_error"]),
                        np.median(found["affine_gaussian_curvature_error"]) / 10)
        self.assertNotIn("affine_gaussian_curvature_error", ea.mesh(noisy, level=0.5, attributes="k1"))
        mask = (x**2 + y**2 + z**2 < 0.5).astype(np.uint8)
        with self.assertWarnsRegex(UserWarning, 'have only 2 distinct values.*smoothing="auto"'):
            ea.mesh(mask, level=0.5)

    def test_vectors_have_three_columns(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 4", box=3, resolution=20, attributes="all")
        for name in ("normal", "affine_normal", "conormal", "direction1"):
            self.assertEqual(ball[name].shape, (len(ball.V), 3), name)
        np.testing.assert_allclose(ball["normal"], ball.V / 2, atol=1e-12)
        with self.assertRaises(KeyError):
            ball["nonsense"]

    def test_meshes_of_other_packages_are_made_as_these_take_them(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 4", box=3, resolution=20)
        pyvista, trimesh = types.ModuleType("pyvista"), types.ModuleType("trimesh")
        pyvista.PolyData = lambda points, faces: types.SimpleNamespace(points=points, faces=faces, point_data={})
        trimesh.Trimesh = lambda points, faces, **options: (points, faces, options)
        with unittest.mock.patch.dict(sys.modules, pyvista=pyvista, trimesh=trimesh):
            data = ball.to_pyvista()
            points, faces, options = ball.to_trimesh()
        np.testing.assert_array_equal(data.faces.reshape(-1, 4), np.insert(ball.F, 0, 3, axis=1))
        self.assertEqual(set(data.point_data), {*ball.attributes, "status"})
        self.assertIs(points, ball.V)
        self.assertIs(faces, ball.F)
        self.assertEqual(set(options["vertex_attributes"]), set(ball.attributes))
        self.assertFalse(options["process"])

    def test_nan_is_no_sample(self):
        x, y, z = np.mgrid[-1:1:24j, -1:1:24j, -1:1:24j]
        values = x**2 + y**2 + z**2
        values[x > 0.2] = np.nan
        found = ea.mesh(values, level=0.5, spacing=2 / 23, origin=(-1, -1, -1))
        self.assertGreater(len(found.V), 100)
        self.assertLess(found.V[:, 0].max(), 0.3)


class Files(InTemporaryFolder):
    def test_surfaces_and_volumes_come_back(self):
        surface = ea.mesh(BLOBBY, box=1.2, resolution=20)
        surface.save(self.folder / "a.ply")
        self.assertEqual(set(ea.read(self.folder / "a.ply").attributes), set(surface.attributes))
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
        values = np.random.default_rng(1).normal(size=(4, 5, 6)).astype(np.float32)
        for name in ("a.nrrd", "a.mha", "a.vti"):
            ea.Volume(values, (1, 2, 3), (4, 5, 6), turn).save(self.folder / name)
            back = ea.read(self.folder / name)
            np.testing.assert_array_equal(back.values, values, err_msg=name)
            np.testing.assert_allclose(back.spacing, (1, 2, 3), err_msg=name)
            np.testing.assert_allclose(back.origin, (4, 5, 6), err_msg=name)
            np.testing.assert_allclose(back.direction, turn, atol=1e-12, err_msg=name)

    def test_the_scale_of_a_fit_stays_known(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=20)
        f = ea.fit(ball, scale=0.5)
        for found in (ea.curvatures(ball, scale=0.5), f.mesh(resolution=30)):
            self.assertEqual(found.scale, 0.5)
            found.save(self.folder / "a.ply")
            self.assertEqual(ea.read(self.folder / "a.ply").scale, 0.5)
            ea.view(found, self.folder / "a.html")
            self.assertIn("at scale 0.5", (self.folder / "a.html").read_text(encoding="utf-8"))

    def test_files_may_have_any_name(self):
        surface = ea.mesh("x^2 + y^2 + z^2 = 1", box=2, resolution=12)
        for name in (b"\xff.ply", "\u00e4 b.ply".encode(), b"-a.ply"):
            path = os.fsencode(self.folder) + b"/" + name
            surface.save(path)
            for same in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
                np.testing.assert_array_equal(ea.read(same).V, surface.V)
        with self.assertRaises(ValueError):
            surface.save("-")

    def test_pages_and_pictures(self):
        surface = ea.mesh(BLOBBY, box=1.2, resolution=20)
        ea.view(surface, self.folder / "a.html", color="mean_curvature")
        ea.view(surface, self.folder / "a.png", size=(120, 100))
        self.assertIn("<html", (self.folder / "a.html").read_text()[:200])
        self.assertEqual((self.folder / "a.png").read_bytes()[:4], b"\x89PNG")
        self.assertIn("srcdoc=", surface._repr_html_())


class BesideScikitImage(unittest.TestCase):
    """Its open reports 8116, holes where the level is a sample, and 8109, triangles that come twice."""

    def setUp(self):
        try:
            from skimage.measure import marching_cubes
        except ImportError:
            self.skipTest("scikit-image is not installed")
        self.theirs = marching_cubes

    def test_the_same_mesh_where_there_is_no_choice(self):
        x, y, z = np.mgrid[-1:1:30j, -1:1:30j, -1:1:30j]
        values = x**2 + 2 * y**2 + 3 * z**2
        V, F, _, _ = self.theirs(values, 0.6)
        ours = ea.mesh(values, level=0.6)
        def edges_of(vertices):  # of the grid, on which the vertices lie
            beginnings, axes = np.floor(vertices).astype(int), np.argmax(vertices % 1, axis=1)
            return {(*beginning, axis) for beginning, axis in zip(beginnings.tolist(), axes.tolist())}
        self.assertEqual(edges_of(ours.V), edges_of(V.astype(float)))
        self.assertEqual(len(ours.F), len(F))

    def test_no_holes_where_samples_are_at_the_level(self):
        values = np.zeros((8, 8, 8))
        values[2:6, 2:6, 2:6] = 1
        values[3:5, 3:5, 3:5] = 2
        for level in (0.5, 1):
            ours = ea.mesh(np.pad(values, 4), level=level, attributes="none")
            self.assertTrue(edges_are_paired(ours.F), level)

    def test_no_triangle_comes_twice(self):
        rng = np.random.default_rng(2)
        for _ in range(20):
            values = np.pad(rng.integers(-1, 2, (4, 4, 4)).astype(float), 4, constant_values=-1)
            ours = ea.mesh(values, level=0.25, attributes="none")
            self.assertTrue(edges_are_paired(ours.F))


class Examples(unittest.TestCase):
    def test_those_of_the_documentation(self):
        for name in ("equiaffine", "equiaffine._functions"):
            result = doctest.testmod(sys.modules[name])
            self.assertGreater(result.attempted, 0, name)
            self.assertEqual(result.failed, 0, name)

    def test_programs_run(self):
        examples = pathlib.Path(__file__).resolve().parents[2] / "examples/python"
        with tempfile.TemporaryDirectory() as folder:
            for path in sorted(examples.glob("*.py")):
                subprocess.run([sys.executable, path], check=True, cwd=folder, stdout=subprocess.DEVNULL)
                self.assertTrue((pathlib.Path(folder) / "results" / (path.stem + ".png")).exists(), path.name)


if __name__ == "__main__":
    unittest.main()
