# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests what the module for Python says of wrong arguments."""
import pathlib
import re
import tempfile
import unittest
import warnings

import numpy as np

import equiaffine as ea
from module_support import BLOBBY, InTemporaryFolder


class Errors(InTemporaryFolder):
    def assert_sentence(self, pattern, function, *arguments, **options):
        with self.assertRaisesRegex(ValueError, pattern):
            function(*arguments, **options)

    def test_sentences_name_arguments(self):
        self.assert_sentence(r"(?s)missing operator.*\n2x\n *\^", ea.mesh, "2x", box=1)
        self.assert_sentence("box", ea.mesh, "x")
        self.assert_sentence("not contain 'b'", ea.mesh, "x", box=1, constants={"b": 1})
        self.assert_sentence("unknown name|'a'", ea.mesh, "a*x", box=1)
        self.assert_sentence("method", ea.mesh, "x", box=1, method="magic")
        self.assert_sentence("resolution", ea.mesh, "x", box=1, resolution=1)
        self.assert_sentence("level", ea.mesh, "x^2", box=1, level=-1)
        self.assert_sentence("method: give marching-cubes or", ea.mesh, "x", box=1, method=None)
        self.assert_sentence("constants=.*VALUE", ea.mesh, "q*x", box=1)
        self.assert_sentence("such as box=2", ea.mesh, "x")
        self.assert_sentence("level: give a number", ea.mesh, "x", box=1, level=[1, 2])
        self.assert_sentence("level: 'nan' is not a finite number", ea.mesh, "x", box=1, level=np.nan)
        for wrong in (True, np.True_, "2", "2*pi", None, 2j, b"1", {"a": 1}, object()):
            self.assert_sentence("^level: .*number", ea.mesh, "x", box=1, level=wrong)
        self.assert_sentence("whole number", ea.mesh, "x", box=1, resolution=8.7)
        self.assert_sentence("whole number", ea.mesh, "x", box=1, threads=1.5)
        self.assert_sentence("attributes", ea.mesh, "x", box=1, attributes=None)
        nested = []
        nested.append(nested)
        for wrong in (nested, [["k1"]], "\ud800", (name for name in iter(lambda: "k1", ""))):
            self.assert_sentence("^attributes: give", ea.mesh, "x", box=1, attributes=wrong)
        for wrong in ([], (2, 3), [2, [3], 4], 1 << 70):
            self.assert_sentence("^resolution: ", ea.mesh, "x", box=1, resolution=wrong)
        self.assert_sentence("constants c=3=1: ", ea.mesh, "c*x", box=1, constants={"c": 1, "c=3": 1})
        self.assert_sentence("constants: give a dictionary", ea.mesh, "c*x", box=1, constants="c=1")
        self.assert_sentence("GB", ea.mesh, "x", box=1, resolution=20000)
        self.assert_sentence("unknown name 'help'(?s:.*)\n--help\n  \\^", ea.mesh, "--help", box=1)
        self.assert_sentence("nothing to evaluate", ea.mesh, "", box=1)
        self.assertGreater(len(ea.mesh("-x", box=1).V), 0)
        self.assert_sentence("box: give", ea.mesh, "x", box=[[-1, -1, -1], [1, 1, 1]])
        self.assert_sentence("box: give", ea.mesh, lambda x, y, z: x, box=[1, -1, 1, -1, 1, -1])
        self.assert_sentence("complex", ea.mesh, np.zeros((3, 3, 3), complex))
        self.assert_sentence("three-dimensional", ea.mesh, np.zeros((3, 3)))
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
                     lambda: ea.fit(ball).mesh(method="remesh"),
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
                "constants r=a": lambda: ea.mesh("x + r", box=1, constants={"r": "a"}),
                "min_overlap": lambda: ea.register(ball, ball, min_overlap=2), "scale": lambda: ea.fit(ball, scale="large"),
                "range": lambda: ea.view(ball, self.folder / "a.html", range=1),
                "size": lambda: ea.view(ball, self.folder / "a.png", size=(100,)),
                "normals": lambda: ea.curvatures(ball.V, normals=ball.V[:5]), "points": lambda: ea.register(ball, ball).apply([1]),
                "progress": lambda: ea.evaluate("x", [[1, 2, 3]], progress=3),
                "reflections": lambda: ea.symmetries(ball, reflections="no"), "V": lambda: ea.curvatures(bad, ball.F),
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
        self.assert_sentence("'short': give one number for each of the .* vertices, not 3", broken.save, path)
        self.assertEqual(path.read_bytes(), before)
        self.assertEqual(list(self.folder.iterdir()), [path])


if __name__ == "__main__":
    unittest.main()
