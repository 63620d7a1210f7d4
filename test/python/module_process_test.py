# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests what the module for Python does to its process: memory, threads and signals."""
import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import equiaffine as ea
from module_support import BLOBBY


def resident_memory():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


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


if __name__ == "__main__":
    unittest.main()
