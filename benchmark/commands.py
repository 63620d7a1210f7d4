#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times complete commands from a formula or a volume to a file: the blobby surface of the README with its basic
attributes as PLY, and the gyroid with two periods per axis in a volume of floats, a MetaImage file.

Times are medians of CPU time, user and system, with one thread; programs alternate, so that a busy machine slows all of
them equally. The figures for two threads are the best ratios of wall times. With --before PROGRAM, an older program
runs with one thread for comparison, and its file must be identical to ours with two threads. Memory is the maximum
resident set of a command, including mapped files. The peer for volumes is VTK's vtkFlyingEdges3D, which reads the same
file and writes a PLY file without attributes. Commands with --memory must keep their limit within a tenth, and write
the same bytes. --large adds a volume of 1024^3 floats, without a limit for the peer, and a formula at 2048^3; this
takes ten minutes, 20 GB of disk and 8 GB of memory.
"""
import argparse
import filecmp
import importlib.util
import os
import statistics
import subprocess
import tempfile
import time

FORMULA = "(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6"
HAS_VTK = importlib.util.find_spec("vtk") is not None
TARGETS = {256: (0.35, 3), 512: (1.2, 5), 1024: (5, 8)}  # seconds, and the ratio to the older program
GYROID = "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)"
VOLUMES = {400: (5, 0.6, 400), 640: (None, 2.2, 700)}  # seconds, GB, and the limit in MiB
FLYING_EDGES = """
import sys, vtk
reader = vtk.vtkMetaImageReader()
reader.SetFileName(sys.argv[1])
surface = vtk.vtkFlyingEdges3D()
surface.SetInputConnection(reader.GetOutputPort())
surface.SetValue(0, 0)
surface.ComputeNormalsOff()
writer = vtk.vtkPLYWriter()
writer.SetInputConnection(surface.GetOutputPort())
writer.SetFileName(sys.argv[2])
writer.Write()
"""


def run_command(command):
    """Returns CPU seconds, wall seconds and the maximum resident set in GB of one command.

    Removes its output, the last word, first, since replacing a large file makes the file system write to the disk.
    """
    if os.path.exists(command[-1]):
        os.remove(command[-1])
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"'{' '.join(command)}' failed")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - began, usage.ru_maxrss * 1024 / 1e9


def run_flying_edges(volume, output):
    return run_command(["/usr/bin/python3", "-c", FLYING_EDGES, volume, output])


def mesh_of_formula(program, resolution, *options):
    return [program, "mesh", "--function", FORMULA, "--box", *["-1.2", "1.2"] * 3, "--resolution", str(resolution),
    *options]


def sample_of_gyroid(program, nodes, *options):
    return [program, "sample", "--function", GYROID, "--box", *["-6.283185307", "6.283185307"] * 3, "--resolution",
            str(nodes), "--type", "float", *options]


def run(program, resolution, threads, output):
    """Returns CPU seconds and wall seconds of one command."""
    return run_command(mesh_of_formula(program, resolution, "--threads", str(threads), "-o", output))[:2]


def figure(name, value, unit, target):
    print(f"figure commands_{name} {value:.3g} {unit} target {target}", flush=True)


def figure_of_limit(name, limit, gigabytes):
    figure(f"{name}_limited_to_{limit}M", gigabytes, "GB", f"<={1.1 * limit * 2**20 / 1e9:.3g}")


def time_volume(options, folder, nodes, seconds, gigabytes, limit):
    volume = os.path.join(folder, "gyroid.mha")
    ours, theirs = os.path.join(folder, "ours.ply"), os.path.join(folder, "theirs.ply")
    run_command(sample_of_gyroid(options.program, nodes, "-o", volume))
    mesh = ["mesh", "--volume", volume, "--threads"]
    one, two, peer, before = [], [], [], []
    for _ in range(options.repeats):
        one.append(run_command([options.program, *mesh, "1", "-o", ours]))
        two.append(run_command([options.program, *mesh, "2", "-o", ours]))
        if HAS_VTK:
            peer.append(run_flying_edges(volume, theirs))
        if options.before:
            before.append(run_command([options.before, *mesh, "1", "-o", theirs]))
    median = lambda runs, column: statistics.median(run[column] for run in runs)
    figure(f"volume_{nodes}", median(one, 0), "s", f"<={seconds}" if seconds else "-")
    figure(f"volume_{nodes}_memory", max(run[2] for run in one + two), "GB", f"<={gigabytes}")
    figure(f"volume_{nodes}_two_threads", max(a[1] / b[1] for a, b in zip(one, two)), "ratio", ">=1.7")
    of_limited = os.path.join(folder, "limited.ply")
    limited = run_command([options.program, *mesh, "2", "--memory", f"{limit}M", "-o", of_limited])
    figure_of_limit(f"volume_{nodes}", limit, limited[2])
    figure(f"volume_{nodes}_limited_same_bytes", filecmp.cmp(ours, of_limited, shallow=False), "bool", ">=1")
    figure(f"volume_{nodes}_limited_over_free", limited[0] / median(two, 0), "ratio", "-")
    if peer:
        figure(f"volume_{nodes}_flying_edges", median(peer, 0), "s", "-")
        figure(f"volume_{nodes}_flying_edges_memory", max(run[2] for run in peer), "GB", "-")
    if before:
        figure(f"volume_{nodes}_over_before", median(before, 0) / median(one, 0), "ratio", ">=1")
        figure(f"volume_{nodes}_memory_before", max(run[2] for run in before), "GB", "-")
        figure(f"volume_{nodes}_same_bytes", filecmp.cmp(ours, theirs, shallow=False), "bool", ">=1")


def time_large(options, folder):
    volume, output = os.path.join(folder, "large.mha"), os.path.join(folder, "large.ply")
    memory = ["--memory", "1G", "-o", output]
    run_command(sample_of_gyroid(options.program, 1024, "--memory", "1G", "-o", volume))
    of_volume = run_command([options.program, "mesh", "--volume", volume, *memory])
    figure("volume_1024", of_volume[0], "s", "-")
    figure("volume_1024_wall", of_volume[1], "s", "-")
    figure_of_limit("volume_1024", 1024, of_volume[2])
    if HAS_VTK:
        peer = run_flying_edges(volume, output)
        figure("volume_1024_flying_edges", peer[0], "s", "-")
        figure("volume_1024_flying_edges_wall", peer[1], "s", "-")
        figure("volume_1024_flying_edges_memory", peer[2], "GB", "-")
    os.remove(volume)
    of_formula = run_command([options.program, "mesh", "--function", GYROID, "--box", *["-6.283185307", "6.283185307"] * 3,
                              "--resolution", "2048", *memory])
    figure("2048", of_formula[0], "s", "-")
    figure_of_limit("2048", 1024, of_formula[2])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--before", help="an older program to compare with")
    parser.add_argument("--large", action="store_true", help="also do what takes ten minutes and 20 GB of disk")
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
        for nodes, targets in VOLUMES.items():
            time_volume(options, folder, nodes, *targets)
        if options.large:
            time_large(options, folder)
    for resolution in (512, 1024):
        figure(f"{resolution}_over_{resolution // 2}", seconds[resolution] / seconds[resolution // 2], "ratio", "<=4.5")


if __name__ == "__main__":
    main()
