# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the tools of the items: python3 -m unittest reproduce.tests"""

import json
import math
import pathlib
import struct
import tempfile
import unittest

from .lab import Item, Lab
from .maps import SHEAR, determinant, image, inverted
from .program import Program, Surface, read_ply, write_ply
from .report import to_html, to_json
from .statistics import Distribution, distances, greatest, median, quantile, slope


class Statistics(unittest.TestCase):
    def test_what_is_not_a_number_counts_as_infinite(self):
        for values in ([1.0, math.nan], [math.nan, 1.0], []):
            self.assertEqual(greatest(values), math.inf)
        self.assertEqual(quantile([math.nan, 1.0, 2.0], 0.99), math.inf)
        self.assertEqual(median([3.0, math.nan, 1.0]), 3.0)

    def test_distances_of_two_uniform_distributions(self):
        first = Distribution([k / 1000 for k in range(1, 1001)], [1.0] * 1000)
        second = Distribution([2 * k / 3000 for k in range(1, 3001)], [1.0] * 3000)
        most, moved = distances(first, second)
        self.assertAlmostEqual(most, 0.5, places=2)  # at 1, where the distribution functions are 1 and 1/2
        mean = lambda end: 1 - 0.5 / end * math.log(1 + end / 0.5)  # mean of x / (1/2 + x); 1/2 is the median
        self.assertAlmostEqual(moved, mean(2) - mean(1), places=3)
        self.assertEqual(distances(first, first), (0.0, 0.0))

    def test_weights_count(self):
        heavy = Distribution([1.0, 2.0, math.inf], [3.0, 1.0, 5.0])
        self.assertEqual(heavy.weights, [0.75, 0.25])
        self.assertEqual([heavy.quantile(share) for share in (0.5, 0.8)], [1.0, 2.0])
        self.assertEqual(heavy.histogram(0.5, 2.5, 2), [0.75, 0.25])
        self.assertEqual(distances(heavy, Distribution([1.0, 2.0], [1.0, 1.0]))[0], 0.25)

    def test_slope_of_a_power(self):
        self.assertAlmostEqual(slope([2, 4, 16], [3 * n**-4 for n in (2, 4, 16)]), -4)


class Maps(unittest.TestCase):
    def test_the_inverse_undoes_a_map(self):
        self.assertAlmostEqual(determinant(SHEAR), 1)
        for a, b in zip(image(inverted(SHEAR), image(SHEAR, (1, 2, 3))), (1, 2, 3)):
            self.assertAlmostEqual(a, b)


class Surfaces(unittest.TestCase):
    def test_points_and_areas_survive_a_file(self):
        columns = {"x": [0.0, 3.0, 0.0], "y": [0.0, 0.0, 4.0], "z": [1.0, 1.0, 1.0]}
        with tempfile.TemporaryDirectory() as folder:
            write_ply(pathlib.Path(folder) / "a.ply", columns, [(0, 1, 2)])
            surface = read_ply(pathlib.Path(folder) / "a.ply")
        self.assertEqual(surface.columns, columns)
        samples = surface.samples()
        self.assertEqual([list(samples[name]) for name in ("x", "y", "z", "area")], [[1.5], [2.0], [1.0], [6.0]])

    def test_samples_fill_triangles_evenly(self):
        columns = {"x": [0.0, 1.0, 0.0], "y": [0.0, 0.0, 1.0], "z": [0.0, 0.0, 0.0]}
        faces = struct.pack("<Biii", 3, 0, 1, 2) * 1000
        samples = Surface(columns, faces).samples()
        mean = lambda values: sum(values) / len(values)
        self.assertAlmostEqual(mean(samples["x"]), 1 / 3, places=2)
        self.assertAlmostEqual(mean(samples["y"]), 1 / 3, places=2)
        self.assertAlmostEqual(mean([x * y for x, y in zip(samples["x"], samples["y"])]), 1 / 12, places=2)
        self.assertTrue(all(0 <= x and 0 <= y and x + y <= 1 for x, y in zip(samples["x"], samples["y"])))


class Report(unittest.TestCase):
    def lab(self, folder="."):
        return Lab(Program("equiaffine", folder), "", pathlib.Path(folder), True)

    def test_a_check_fails_beyond_its_bound_and_without_a_number(self):
        for ours, comparison, passes in ((1.0, "<=", True), (1.1, "<=", False), (math.nan, "<=", False),
                                         (1.0, ">=", True), (0.9, ">=", False), (math.nan, ">=", False),
                                         (1.0, "==", True), (0.9, "==", False), (math.nan, "==", False)):
            lab = self.lab()
            lab.check("a number", ours, comparison, 1.0)
            self.assertEqual(lab.passed, passes)
            self.assertEqual(bool(lab.checks[0].reason), not passes)

    def test_an_item_without_checks_or_with_a_failed_one_does_not_pass(self):
        lab = self.lab()
        self.assertFalse(lab.passed)
        lab.check("good", 0, "==", 0)
        self.assertTrue(lab.passed)
        lab.fail("no bunny")
        self.assertFalse(lab.passed or lab.is_complete)

    def test_results_are_what_the_report_says(self):
        lab = self.lab()
        lab.check("error", math.nan, "<=", 1e-3, 0.5)
        done = [(Item("fig0", "A title", "a claim", None), lab)]
        (entry,) = json.loads(to_json(done))["items"]
        self.assertEqual({name: entry[name] for name in ("name", "paper", "paper_method_measured", "ours", "target",
                                                         "pass")},
                         {"name": "fig0", "paper": "a claim", "paper_method_measured": "error: 0.5",
                          "ours": "error: nan", "target": "error: ≤ 0.001", "pass": False})
        page = to_html(done, "today")
        for text in ("0 of 1 items hold", "a claim", "nan is not ≤ 0.001", "✗ does not hold"):
            self.assertIn(text, page)
