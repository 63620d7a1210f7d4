# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares times of the Python module and of the program of the same build: python_module.py PROGRAM, with the module
in PYTHONPATH.

Each line `figure NAME VALUE UNIT [target <=X]` is a measured figure. Times are median wall times of alternating
runs."""
import json
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np

RUNS = 9
BLOBBY = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6"


def figure(name, value, unit, target=None):
    name = name.replace(", ", "_").replace(" ", "_")
    print(f"figure {name} {value:.3g} {unit}" + (f" target <={target}" if target is not None else ""), flush=True)


def seconds(call):
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def time_import():
    code = "import time, numpy; t = time.perf_counter(); import equiaffine; print(time.perf_counter() - t)"
    times = [float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout) for _ in range(RUNS)]
    figure("import", statistics.median(times), "s", 0.3)


def time_beside_program(ea, program, folder):
    """Compares calls of the module with the program, without writing files, from the stages that it prints, and with
    it."""
    samples = np.fromfunction(lambda i, j, k: ((i - 127.5)**2 + 2 * (j - 127.5)**2 + (k - 127.5)**2) / 127.5**2, (256,) * 3,
                              dtype=np.float32)
    ea.Volume(samples).save(folder / "v.nrrd")
    box = [str(x) for x in (-1.2, 1.2) * 3]
    cases = {
        "formula at 256^3": (["--function", BLOBBY, "--box", *box, "--resolution", "256"],
                             lambda: ea.mesh(BLOBBY, box=1.2, resolution=256)),
        "volume of 256^3 floats": (["--volume", folder / "v.nrrd", "--level", "0.5"], lambda: ea.mesh(samples, level=0.5)),
    }
    for name, (words, call) in cases.items():
        def run_program():
            subprocess.run([program, "mesh", *words, "-o", folder / "program.ply", "--stats", folder / "program.json"],
                           check=True, stdout=subprocess.DEVNULL)
            stages = json.loads((folder / "program.json").read_text())["seconds"]
            return sum(stages[stage] for stage in ("sample", "project", "annotate"))
        times = [(seconds(call), run_program()) for _ in range(RUNS)]
        figure(f"call over stages of the program, {name}", statistics.median(ours / theirs for ours, theirs in times), "ratio", 1.05)
        times = [(seconds(lambda: call().save(folder / "module.ply")), seconds(run_program)) for _ in range(RUNS)]
        figure(f"with writing over the program, {name}", statistics.median(ours / theirs for ours, theirs in times), "ratio")


def measure_memory():
    code = ("import numpy as np, equiaffine as ea; x = np.linspace(-1, 1, 256); v = np.empty((256,) * 3, np.float32)\n"
            "for n in range(256): v[n] = x[n]**2 + 2 * x[:, None]**2 + x**2\n"
            "m = lambda: 1024 * int(open('/proc/self/status').read().split('VmHWM:')[1].split()[0]); "
            "b = m(); s = ea.mesh(v, level=0.5); "
            "o = s.V.nbytes + s.F.nbytes + sum(a.nbytes for a in s.attributes.values()); "
            "print((m() - b + v.nbytes) / (v.nbytes + o))")
    result = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    figure("input and growth of memory over input and output, volume of 256^3 floats", float(result.stdout), "ratio", 1.1)


def time_interrupts(ea):
    """The maximum time from Ctrl-C to the exception, over several moments in each function."""
    ball = ea.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=40)
    i, j, k = np.ogrid[-1:1:200j, -1:1:200j, -1:1:200j]
    samples = np.sin(20 * i) * np.sin(20 * j) * np.sin(20 * k)
    calls = {
        "mesh": lambda: ea.mesh("sin(30*x)*sin(30*y)*sin(30*z) = 0.1", box=3, resolution=400, attributes="all"),
        "mesh of a volume": lambda: ea.mesh(samples, level=0.1, attributes="all"),
        "Delaunay mesh": lambda: ea.mesh(BLOBBY, box=1.2, method="delaunay", radius=0.01),
        "curvatures": lambda: ea.curvatures(ball.V, ball.F),
        "fit": lambda: ea.fit(ball.V, ball.F),
        "register": lambda: ea.register(ball, (ball.V[:, [1, 0, 2]] * [1, 2, 3], ball.F)),
        "symmetries": lambda: ea.symmetries(ball),
    }
    for name, call in calls.items():
        latencies = []
        for delay in (0.1, 0.2, 0.4, 0.8, 1.6):
            sent = []
            def interrupt():
                sent.append(time.perf_counter())
                os.kill(os.getpid(), signal.SIGINT)
            timer = threading.Timer(delay, interrupt)
            try:
                timer.start()
                call()
                timer.cancel()
                timer.join()
            except KeyboardInterrupt:
                latencies.append(time.perf_counter() - sent[0])
        if latencies:
            figure(f"Ctrl-C in {name}", max(latencies), "s", 0.2)


def main():
    import equiaffine as ea
    time_import()
    with tempfile.TemporaryDirectory() as folder:
        time_beside_program(ea, sys.argv[1], pathlib.Path(folder))
    measure_memory()
    time_interrupts(ea)


if __name__ == "__main__":
    main()
