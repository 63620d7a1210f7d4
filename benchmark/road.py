#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times whole commands from a formula to a file: the blobby surface of the README with its basic attributes as PLY.

Times are medians of processor time, user and system, on one thread; programs take turns, so that a busy machine slows
all of them alike. The figures of two threads are the best ratios of wall times. With --before PROGRAM an older program
does the same on one thread, and the ratios are figures, too, as is whether its file has the bytes of ours from two.
"""
import argparse
import filecmp
import os
import statistics
import subprocess
import tempfile
import time

FORMULA = "(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6"
TARGETS = {256: (0.35, 3), 512: (1.2, 5), 1024: (5, 8)}  # seconds, and the ratio to the program before


def run(program, resolution, threads, output):
    """Returns processor seconds and wall seconds of one command."""
    command = [program, "mesh", "--function", FORMULA, "--box", *["-1.2", "1.2"] * 3, "--resolution", str(resolution),
               "--threads", str(threads), "-o", output]
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"'{' '.join(command)}' failed")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - began


def figure(name, value, unit, target):
    print(f"figure road_{name} {value:.3g} {unit} target {target}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--before", help="an older program to compare with")
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    seconds = {}
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = os.path.join(folder, "ours.ply"), os.path.join(folder, "before.ply")
        for resolution, (most, ratio) in TARGETS.items():
            times, before, speedups = [], [], []
            for _ in range(options.repeats):
                cpu, wall = run(options.program, resolution, 1, ours)
                times.append(cpu)
                speedups.append(wall / run(options.program, resolution, 2, ours)[1])
                if options.before:
                    before.append(run(options.before, resolution, 1, theirs)[0])
            seconds[resolution] = statistics.median(times)
            figure(f"{resolution}", seconds[resolution], "s", f"<={most}")
            figure(f"{resolution}_two_threads", max(speedups), "ratio", ">=1.7")
            if before:
                figure(f"{resolution}_over_before", statistics.median(before) / seconds[resolution], "ratio",
                       f">={ratio}")
                figure(f"{resolution}_same_bytes", filecmp.cmp(ours, theirs, shallow=False), "bool", ">=1")
    for resolution in (512, 1024):
        figure(f"{resolution}_over_{resolution // 2}", seconds[resolution] / seconds[resolution // 2], "ratio", "<=4.5")


if __name__ == "__main__":
    main()
