# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the module for Python, beside the program of the same build: EQUIAFFINE_PROGRAM names it."""
import doctest
import gc
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import equiaffine as ea

PROGRAM = os.environ["EQUIAFFINE_PROGRAM"]
BLOBBY = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6"


def run_program(*words):
    subprocess.run([PROGRAM, *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def resident_memory():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def edges_are_paired(F):
    """Whether each edge has two triangles, which run along it in both directions."""
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    _, counts = np.unique(edges, axis=0, return_counts=True)
    forth = set(map(tuple, edges.tolist()))
    return bool((counts == 1).all()) and all((b, a) in forth for a, b in forth)


class InTemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assert_same(self, ours, theirs):
        """Asserts that two surfaces are the same bit for bit."""
        np.testing.assert_array_equal(ours.V, theirs.V)
        np.testing.assert_array_equal(ours.F, theirs.F)
        np.testing.assert_array_equal(ours.status, theirs.status)
        self.assertGreater(len(theirs.attributes), 5)
        for name, values in theirs.attributes.items():
            np.testing.assert_array_equal(ours.attributes[name], values, err_msg=name)


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
            run_program("mesh", "--volume", self.folder / "v.nrrd", "--isovalue", 100, "-o", self.folder / "v.ply")
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
        with self.assertWarnsRegex(UserWarning, 'have 2 distinct values only.*smoothing="auto"'):
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


class Errors(InTemporaryFolder):
    def assert_sentence(self, pattern, function, *arguments, **options):
        with self.assertRaisesRegex(ValueError, pattern):
            function(*arguments, **options)

    def test_sentences_name_arguments(self):
        self.assert_sentence(r"(?s)missing operator.*\n2x\n *\^", ea.mesh, "2x", box=1)
        self.assert_sentence("box", ea.mesh, "x")
        self.assert_sentence("no 'b'", ea.mesh, "x", box=1, constants={"b": 1})
        self.assert_sentence("unknown name|'a'", ea.mesh, "a*x", box=1)
        self.assert_sentence("method", ea.mesh, "x", box=1, method="magic")
        self.assert_sentence("resolution", ea.mesh, "x", box=1, resolution=1)
        self.assert_sentence("level", ea.mesh, "x^2", box=1, level=-1)
        self.assert_sentence("give one of marching-cubes", ea.mesh, "x", box=1, method=None)
        self.assert_sentence("constants=.*VALUE", ea.mesh, "q*x", box=1)
        self.assert_sentence("such as box=2", ea.mesh, "x")
        self.assert_sentence("level: give a number", ea.mesh, "x", box=1, level=[1, 2])
        self.assert_sentence("level: give a finite", ea.mesh, "x", box=1, level=np.nan)
        self.assert_sentence("level: give a number", ea.mesh, "x", box=1, level=True)
        self.assert_sentence("whole number", ea.mesh, "x", box=1, resolution=8.7)
        self.assert_sentence("whole number", ea.mesh, "x", box=1, threads=1.5)
        self.assert_sentence("attributes", ea.mesh, "x", box=1, attributes=None)
        self.assert_sentence("cannot name a constant", ea.mesh, "c*x", box=1, constants={"c": 1, "c=3": 1})
        self.assert_sentence("GB", ea.mesh, "x", box=1, resolution=20000)
        self.assert_sentence("unknown name 'help'(?s:.*)\n--help\n  \\^", ea.mesh, "--help", box=1)
        self.assert_sentence("nothing to evaluate", ea.mesh, "", box=1)
        self.assertGreater(len(ea.mesh("-x", box=1).V), 0)
        self.assert_sentence("box: give", ea.mesh, "x", box=[[-1, -1, -1], [1, 1, 1]])
        self.assert_sentence("box: give", ea.mesh, lambda x, y, z: x, box=[1, -1, 1, -1, 1, -1])
        self.assert_sentence("complex", ea.mesh, np.zeros((3, 3, 3), complex))
        self.assert_sentence("three dimensions", ea.mesh, np.zeros((3, 3)))
        self.assert_sentence("shape", ea.curvatures, [[1, 2], [3, 4]])
        self.assert_sentence("vertex 7", ea.curvatures, np.zeros((3, 3)), [[0, 1, 7]])
        self.assert_sentence("vertex -1", ea.curvatures, np.zeros((3, 3)), [[0, 1, -1]])
        self.assert_sentence("integers", ea.curvatures, np.zeros((3, 3)), [[0.5, 1, 2]])
        self.assert_sentence("30 points are not finite", ea.curvatures, [[0, 0, np.nan]] * 30)
        self.assert_sentence("no points", ea.curvatures, np.zeros((0, 3)))
        self.assert_sentence("no file", ea.register, "missing.ply", "missing.ply")
        self.assert_sentence("missing.ply", ea.read, "missing.ply")
        self.assert_sentence("extension", ea.write, self.folder / "a.xyzzy", ea.Surface(np.zeros((3, 3))))
        for wrong in ({"smoothing": 1}, {"spacing": 1}):
            with self.assertRaises(TypeError):
                ea.mesh("x", box=1, **wrong)

    def test_no_sentence_is_half_translated(self):
        ball = ea.mesh("x^2 + 2*y^2 + z^2 = 1 + 0.3*x*y*z", box=1.4, resolution=12)
        page = self.folder / "page.html"
        found = []
        for call in (lambda: ea.mesh("x", box=1, attributes="k1_error"), lambda: ea.fit(ball).mesh(level=5, resolution=16),
                     lambda: ea.view(ea.Surface(ball.V), page), lambda: ea.view(ball, page, size=(9, 9)),
                     lambda: ea.curvatures(ball, degree=7), lambda: ea.mesh(np.ones((9, 9, 9)), smoothing=-1)):
            with self.assertRaises(ValueError) as caught:
                call()
            found.append(str(caught.exception))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            ea.curvatures(ball.V[::3], scale=0.9)
        found += [str(warning.message) for warning in told]
        self.assertGreater(len(found), 6)
        for sentence in found:
            self.assertNotRegex(sentence, r'--|="or"|html=|use f or| png;|choose an level', sentence)

    def test_arguments_of_a_wrong_form_are_named(self):
        samples, ball = np.ones((9, 9, 9)), ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=8)
        bad = ball.V.copy()
        bad[3] = np.nan
        for name, call in {
                "spacing": lambda: ea.mesh(samples, spacing=(1, 2)), "origin": lambda: ea.Volume(samples, origin="abc"),
                "direction": lambda: ea.mesh(samples, direction=np.diag([1, 1, 2])), "values": lambda: ea.Volume(samples[0]),
                "constants['r']": lambda: ea.mesh("x + r", box=1, constants={"r": "a"}),
                "range": lambda: ea.view(ball, self.folder / "a.html", range=1),
                "size": lambda: ea.view(ball, self.folder / "a.png", size=(100,)),
                "normals": lambda: ea.curvatures(ball.V, normals=ball.V[:5]), "points": lambda: ea.register(ball, ball).apply([1]),
                "progress": lambda: ea.evaluate("x", [[1, 2, 3]], progress=3),
                "reflection": lambda: ea.symmetries(ball, reflection="no"), "V": lambda: ea.curvatures(bad, ball.F),
                "a": lambda: ea.register(ea.fit(ball), ball), "f": lambda: ea.mesh(lambda x, y, z: x[:, :3], box=1),
                "attributes": lambda: ea.Surface(ball.V, ball.F, {"status": ball["k1"]}).save(self.folder / "a.ply")}.items():
            with self.assertRaisesRegex(ValueError, "^" + re.escape(name) + ": "):
                call()
        with self.assertRaises(TypeError):
            ea.evaluate("x", [[1, 2, 3]], box=1)

    def test_masks_are_no_samples_or_refused(self):
        x, y, z = np.mgrid[-1:1:20j, -1:1:20j, -1:1:20j]
        values = x**2 + y**2 + z**2
        masked = ea.mesh(np.ma.masked_where(x > 0, values), level=0.5)
        np.testing.assert_array_equal(masked.V, ea.mesh(np.where(x > 0, np.nan, values), level=0.5).V)
        self.assert_sentence("masked", ea.curvatures, np.ma.masked_where(values.reshape(-1, 1) > 1, np.zeros((8000, 1))))

    def test_a_status_that_is_none_is_refused(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=12)
        for status in (np.full(len(ball.V), 200), np.full(len(ball.V), -1), ball.status[:3], np.full(len(ball.V), 0.5)):
            wrong = ea.Surface(ball.V, ball.F, {}, status)
            self.assert_sentence("status", wrong.save, self.folder / "a.csv")
            self.assert_sentence("status", ea.view, wrong, self.folder / "a.html", color="status")

    def test_what_cannot_be_shown_is_refused_and_leaves_nothing(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=12)
        before = set(pathlib.Path(tempfile.gettempdir()).glob("equiaffine-*.html"))
        self.assert_sentence("nope", ea.view, ball, color="nope")
        self.assert_sentence("has no faces", ea.view, ea.Surface(ball.V))
        self.assertEqual(set(pathlib.Path(tempfile.gettempdir()).glob("equiaffine-*.html")), before)

    def test_exceptions_of_progress_stay_as_they_are(self):
        class Enough(ValueError):
            pass
        def end(*_):
            raise Enough("use --my-option")
        with self.assertRaisesRegex(Enough, "use --my-option"):
            ea.mesh(BLOBBY, box=1.2, resolution=200, progress=end)

    def test_a_map_is_never_invented(self):
        a = ea.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=20)
        b = ea.mesh("x^2 + y^2 + z^2 + 0.4*sin(5*x)*sin(4*y)*z = 1", box=1.5, resolution=20)
        found = ea.register(a.V[::3], b.V[::3])
        self.assertFalse(found)
        self.assertIsNone(found.matrix)
        self.assertIn("no map", found.summary)
        with self.assertRaises(ValueError):
            found.apply(a.V)

    def test_warnings_are_those_of_the_program(self):
        ball = ea.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=12)
        signs = np.random.default_rng(1).choice([-1, 1], size=(len(ball.V), 1))
        with self.assertWarnsRegex(UserWarning, "normal"):
            ea.curvatures(ball.V, normals=signs * ball["normal"])

    def test_an_output_is_whole_or_absent(self):
        surface = ea.mesh("x^2 + y^2 + z^2 = 1", box=2, resolution=12)
        path = self.folder / "a.ply"
        surface.save(path)
        before = path.read_bytes()
        broken = ea.Surface(surface.V, surface.F, {"short": np.zeros(3)})
        self.assert_sentence("'short' has 3 numbers", broken.save, path)
        self.assertEqual(path.read_bytes(), before)
        self.assertEqual(list(self.folder.iterdir()), [path])


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


class Memory(unittest.TestCase):
    def test_arrays_share_the_memory_of_the_library_and_keep_it(self):
        values = ea.mesh(BLOBBY, box=1.2, resolution=40)["mean_curvature"]
        self.assertFalse(values.flags.owndata)
        copy = values.copy()
        gc.collect()
        for _ in range(5):
            ea.mesh(BLOBBY, box=1.2, resolution=40)
        np.testing.assert_array_equal(values, copy)

    def test_a_thousand_calls_take_no_memory(self):
        samples = np.linspace(-1, 1, 12**3).reshape(12, 12, 12)
        def calls(count):
            for _ in range(count):
                ea.mesh("x^2 + y^2 + z^2 = 1", box=2, resolution=12)
                ea.mesh(samples)
                with self.assertRaises(ValueError):
                    ea.mesh("x +", box=1)
        calls(100)
        before = resident_memory()
        calls(1000)
        self.assertLess(resident_memory() - before, 2**23)

    def test_a_volume_is_not_copied(self):
        samples = np.zeros((160, 160, 160), np.uint8)
        samples[40:120, 40:120, 40:120] = 200
        code = ("import resource, sys, numpy, equiaffine as ea; v = numpy.load(sys.argv[1]); m = lambda: "
                "resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024; b = m(); s = ea.mesh(v, level=100); print(m() - b)")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "v.npy"
            np.save(path, samples)
            growth = int(subprocess.run([sys.executable, "-c", code, path], check=True, capture_output=True).stdout)
        self.assertLess(growth, 8 * samples.size)  # what the samples would take as doubles


class Threads(unittest.TestCase):
    def test_other_threads_run_meanwhile(self):
        steps, stop = [0], threading.Event()
        def count():
            while not stop.is_set():
                steps[0] += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        ea.mesh(BLOBBY, box=1.2, resolution=150)
        stop.set()
        thread.join()
        self.assertGreater(steps[0], 10)

    def test_a_pool_gets_the_same_results(self):
        formulas = [f"x^2 + y^2 + {a}*z^2 = 1" for a in range(1, 9)]
        mesh = lambda formula: ea.mesh(formula, box=1.2, resolution=24)
        expected = [mesh(formula) for formula in formulas]
        with ThreadPoolExecutor(4) as pool:
            for ours, theirs in zip(pool.map(mesh, formulas), expected):
                np.testing.assert_array_equal(ours.V, theirs.V)
                np.testing.assert_array_equal(ours["mean_curvature"], theirs["mean_curvature"])

    def test_one_thread_gives_the_same_bits(self):
        one, all_of_them = (ea.mesh(BLOBBY, box=1.2, resolution=30, threads=threads) for threads in (1, None))
        np.testing.assert_array_equal(one.V, all_of_them.V)

    def test_a_forked_process_computes(self):
        ea.mesh("x^2 + y^2 + z^2 = 1", box=2, resolution=12)
        process = os.fork()
        if process == 0:
            os._exit(0 if len(ea.mesh("x^2 + y^2 + z^2 = 1", box=2, resolution=12, threads=1).V) > 100 else 1)
        self.assertEqual(os.waitpid(process, 0)[1], 0)

    def test_a_process_ends_while_a_daemon_thread_computes(self):
        code = ("import threading, time, equiaffine as ea; threading.Thread(target=lambda: ea.mesh('sin(x)*y + z', box=5, "
                "resolution=500), daemon=True).start(); time.sleep(0.3)")
        self.assertEqual(subprocess.run([sys.executable, "-c", code], check=False, capture_output=True).returncode, 0)

    def test_progress_is_told_and_may_end_the_work(self):
        seen = []
        ea.mesh(BLOBBY, box=1.2, resolution=200, progress=lambda *step: seen.append(step))
        self.assertTrue(seen)
        self.assertTrue(all(stage > 0 and 0 <= done <= total for stage, done, total in seen))
        class Enough(Exception):
            pass
        def end(*_):
            raise Enough
        with self.assertRaises(Enough):
            ea.mesh(BLOBBY, box=1.2, resolution=200, progress=end)

    def test_control_c_ends_each_long_function(self):
        ball = ea.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=40)
        x, y, z = np.mgrid[-1:1:150j, -1:1:150j, -1:1:150j]
        samples = np.sin(20 * x) * np.sin(20 * y) * np.sin(20 * z)
        calls = {
            "mesh": lambda progress: ea.mesh("sin(30*x)*sin(30*y)*sin(30*z) = 0.1", box=3, resolution=300, progress=progress),
            "volume": lambda progress: ea.mesh(samples, level=0.1, attributes="all", progress=progress),
            "delaunay": lambda progress: ea.mesh(BLOBBY, box=1.2, method="delaunay", radius=0.02, progress=progress),
            "curvatures": lambda progress: ea.curvatures(ball.V, ball.F, progress=progress),
            "fit": lambda progress: ea.fit(ball.V, ball.F, progress=progress),
            "register": lambda progress: ea.register(ball, (ball.V[:, [1, 0, 2]] * [1, 2, 3], ball.F), progress=progress),
            "symmetries": lambda progress: ea.symmetries(ball, progress=progress),
        }
        before = threading.active_count()
        for name, call in calls.items():
            with self.assertRaises(KeyboardInterrupt, msg=name):
                call(lambda *_: signal.raise_signal(signal.SIGINT))
        self.assertEqual(threading.active_count(), before)


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
