# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the registration of rotated and shifted meshes with Open3D's global registration:

  rigid_registration.py BENCHMARK, with the Python module in PYTHONPATH

BENCHMARK is benchmark_registration, which writes the twelve surfaces. The source is a mesh of a surface. The target is
a mesh on a different grid, moved by a random proper motion, whole or cut in half by a random plane. Open3D follows its
tutorial on global registration: feature histograms, RANSAC and iterative closest points, with the normals of the meshes
and four voxel sizes.

Each line `figure NAME VALUE UNIT [target >=X]` is a measured figure."""
import statistics
import subprocess
import sys
import time

import equiaffine as ea
import numpy as np
import open3d

MOTIONS = 2
VOXELS = (0.015, 0.03, 0.05, 0.08)  # relative to the size of the source
RIGHT_ANGLE = np.radians(1)


def figure(name, value, unit, target=None):
    print(f"figure rigid_{name} {value:.3g} {unit}" + (f" target >={target}" if target is not None else ""), flush=True)


def surfaces(benchmark):
    lines = subprocess.run([benchmark, "1", "surfaces"], check=True, capture_output=True, text=True).stdout.splitlines()
    for line in lines:
        *box, formula = line.split("\t")
        yield [float(x) for x in box], formula


def random_rotation(random):
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def half(vertices, faces, random):
    heights = vertices @ random.normal(size=3)
    kept = heights < np.median(heights)
    number = np.cumsum(kept) - 1
    return vertices[kept], number[faces[kept[faces].all(axis=1)]]


def by_equiaffine(source, target):
    return ea.register(source, target, kind="rigid", reflections=False).matrix


def by_open3d(source, target, part):
    size = np.linalg.norm(np.ptp(source[0], axis=0))
    voxel = part * size
    clouds, features = [], []
    for vertices, faces in (source, target):
        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices), open3d.utility.Vector3iVector(faces))
        mesh.compute_vertex_normals()
        cloud = open3d.geometry.PointCloud(mesh.vertices)
        cloud.normals = mesh.vertex_normals
        clouds.append(cloud)
        features.append(cloud.voxel_down_sample(voxel))
    registration = open3d.pipelines.registration
    histograms = [registration.compute_fpfh_feature(cloud, open3d.geometry.KDTreeSearchParamHybrid(5 * voxel, 100))
                  for cloud in features]
    coarse = registration.registration_ransac_based_on_feature_matching(
        *features, *histograms, True, 1.5 * voxel, registration.TransformationEstimationPointToPoint(False), 3,
        [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9), registration.CorrespondenceCheckerBasedOnDistance(1.5 * voxel)],
        registration.RANSACConvergenceCriteria(100000, 0.999))
    return registration.registration_icp(*clouds, 0.4 * voxel, coarse.transformation,
                                         registration.TransformationEstimationPointToPlane()).transformation


def angle_between(found, rotation):
    if found is None:
        return np.pi
    return np.linalg.norm(found[:3, :3] - rotation) / np.sqrt(2)


def measure(name, cases, register):
    angles, seconds = [], []
    for source, target, rotation in cases:
        begin = time.process_time()
        found = register(source, target)
        seconds.append(time.process_time() - begin)
        angles.append(angle_between(found, rotation))
    right = [angle for angle in angles if angle <= RIGHT_ANGLE]
    figure(f"{name}_right", len(right) / len(cases), "of runs", 0.95 if name.endswith("equiaffine") else None)
    figure(f"{name}_median_angle", np.degrees(statistics.median(right or [np.pi])), "degrees")
    figure(f"{name}_seconds", statistics.median(seconds), "s of CPU time")


def main():
    open3d.utility.random.seed(0)
    whole, halves = [], []
    for n, (box, formula) in enumerate(surfaces(sys.argv[1])):
        source = ea.mesh(formula, box=box, resolution=48)
        other = ea.mesh(formula, box=box, resolution=53)
        for motion in range(MOTIONS):
            random = np.random.default_rng((n, motion))
            rotation = random_rotation(random)
            moved = other.V @ rotation.T + random.normal(size=3), other.F
            whole.append(((source.V, source.F), moved, rotation))
            halves.append(((source.V, source.F), half(*moved, random), rotation))
    for name, cases in (("whole", whole), ("half", halves)):
        measure(f"{name}_equiaffine", cases, by_equiaffine)
        for part in VOXELS:
            measure(f"{name}_Open3D_voxels_of_{part:g}", cases, lambda a, b: by_open3d(a, b, part))


if __name__ == "__main__":
    main()
