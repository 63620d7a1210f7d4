# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the module for Python share."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

PROGRAM = os.environ["EQUIAFFINE_PROGRAM"]
BLOBBY = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6"


def run_program(*words):
    subprocess.run([PROGRAM, *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


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
