# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes before and after affine maps: figures 1, 3 and 12."""

import math

from ..lab import item
from ..plot import histograms
from ..program import determinant, image, image_of_box, read_ply, transformed, words_of
from ..statistics import kolmogorov_smirnov, quantile, scaled_wasserstein
from .beyond import BLOBBY, BOX, SHEAR, unimodular

PAIRS = [("affine_gaussian_curvature", "gaussian_curvature", "K", "Kₑ", 1.0),
         ("affine_mean_curvature", "mean_curvature", "H", "Hₑ", 0.5)]


@item("fig3", "The blobby surface",
      "The affine normal ξ, the curvatures K and H, and in green the degenerate curve.")
def fig3(lab):
    words = ["--function", BLOBBY, "--box", *BOX, "--resolution", lab.choose(128, 24)]
    draw = lambda name, color: ["--parabolic-curves", "curves.obj", "--png", name + ".png", "--color", color,
                                "--size", *lab.picture_size]
    lab.mesh("mean", *words, *draw("mean", "affine_mean_curvature"))
    lab.mesh("normals", *words, *draw("normals", "plain"), "--arrows", "affine_normal")
    surface = lab.mesh("gaussian", *words, *draw("gaussian", "affine_gaussian_curvature"))
    lab.pictured("normals", "The affine normal: along the degenerate curve its length is without bound")
    lab.pictured("gaussian", "K, on a logarithmic scale")
    lab.pictured("mean", "H, on a logarithmic scale")
    matrix = unimodular(SHEAR)
    after = lab.evaluate([image(matrix, p) for p in surface.points], "--function", BLOBBY, "--transform", *words_of(matrix))
    errors = []
    for i in range(len(surface)):
        if surface["status"][i] != 0 or after["status"][i] != "regular":
            continue
        K, H = surface["affine_gaussian_curvature"][i], surface["affine_mean_curvature"][i]
        scale = abs(K) + H * H
        errors.append(max(abs(after["affine_gaussian_curvature"][i] - K) / scale,
                          abs(after["affine_mean_curvature"][i] - H) / math.sqrt(scale)))
    lab.check("99 % of the vertices: relative change of K and H under a map of determinant 1", quantile(errors, 0.99), "<=",
              1e-10)
    with open(lab.folder / "curves.obj", encoding="ascii") as file:
        points = [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]
    on_curve = lab.evaluate(points, "--function", BLOBBY, "--attributes", "gaussian_curvature")["gaussian_curvature"]
    typical = quantile([abs(k) for k in surface["gaussian_curvature"]], 0.5)
    lab.check("greatest |Kₑ| on the degenerate curve, over its median on the surface", max(map(abs, on_curve)) / typical,
              "<=", 1e-11)


def compare(lab, name, before, after, scale, bound, are_used=(None, None)):
    """Distances of the distributions of affine and Euclidean curvatures; `scale` is |det| of the map between them."""
    rows, ratios = [], {}
    for affine, euclidean, K, K_e, power in PAIRS:
        numbers = {}
        for column, label, factor in ((affine, K, scale**power), (euclidean, K_e, 1.0)):
            pair = [surface.distribution(column, number, is_used) for surface, number, is_used in zip(
                (before, after), (1.0, factor), are_used)]
            numbers[column] = kolmogorov_smirnov(*pair), scaled_wasserstein(*pair)
            rows.append([f"{name}: {label}", *numbers[column]])
            low, high = pair[0].quantile(0.05), pair[0].quantile(0.95)
            lab.plot(f"{name}-{column}".replace(" ", "-"), histograms([("before", pair[0]), ("after", pair[1])], label, low, high),
                     f"{name}: distribution of {label}")
        ratios[K] = [a / b for a, b in zip(numbers[affine], numbers[euclidean])]
        for kind, ratio in zip(("Kolmogorov-Smirnov", "Wasserstein"), ratios[K]):
            lab.check(f"{name}: {kind} distance of {K} before and after, over that of {K_e}", ratio, "<=", bound)
    lab.table(["", "Kolmogorov-Smirnov", "Wasserstein, of x / (m + |x|), m the median of |x|"], rows)


IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def read_off(path):
    numbers = path.read_text(encoding="ascii").split()
    n_points, n_faces = int(numbers[1]), int(numbers[2])
    points = [tuple(map(float, numbers[4 + 3 * i : 7 + 3 * i])) for i in range(n_points)]
    faces = numbers[4 + 3 * n_points :]
    return points, [tuple(map(int, faces[4 * i + 1 : 4 * i + 4])) for i in range(n_faces)]


def write_off(path, points, triangles, flips):
    """`flips`: a map of negative determinant turns every triangle over."""
    rows = [f"OFF\n{len(points)} {len(triangles)} 0"]
    rows += [f"{x!r} {y!r} {z!r}" for x, y, z in points]
    rows += [f"3 {a} {c} {b}" if flips else f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(rows) + "\n", encoding="ascii")


def cubic_voxels(points, nodes):
    """The box of `--distance-to` with that many nodes along its longest side, and voxels that are cubes."""
    lengths = [max(p[axis] for p in points) - min(p[axis] for p in points) for axis in range(3)]
    lengths = [length + 0.2 * max(lengths) for length in lengths]
    return [max(16, round(nodes * length / max(lengths))) for length in lengths]


def compare_distance_fields(lab, name, points, triangles, matrix, nodes):
    """The distances to a mesh and to its image, each on a grid of its own; only vertices whose error estimates are less
    than half of the number are compared."""
    nodes = nodes if not lab.is_small else 32
    surfaces, are_used = [], []
    for when, map_of in (("before", IDENTITY), ("after", matrix)):
        stem = f"{name}-{when}"
        moved = [image(map_of, p) for p in points]
        write_off(lab.folder / (stem + ".off"), moved, triangles, determinant(map_of) < 0)
        surface = lab.mesh(stem, "--distance-to", stem + ".off", "--resolution", *cubic_voxels(moved, nodes), *SMOOTHED)
        columns = (surface[c] for c in ("affine_gaussian_curvature", "affine_gaussian_curvature_error",
                                        "affine_mean_curvature", "affine_mean_curvature_error", "status"))
        trusted = [s == 0 and e < 0.5 * abs(x) and f < 0.5 * abs(y) for x, e, y, f, s in zip(*columns)]
        surfaces.append(surface)
        are_used.append(trusted)
        lab.say(f"{name}, {when}: {100 * sum(trusted) / len(surface):.0f} % of {len(surface)} vertices have an error "
                "estimate below half of K and of H.")
    compare(lab, f"{name}, distance field", *surfaces, abs(determinant(matrix)), 1 / 3, are_used)
    return surfaces


def draw(lab, name, captions, up):
    """K and H of the surface before and after, on one scale each."""
    for column, label in (("affine_gaussian_curvature", "K"), ("affine_mean_curvature", "H"), ("mean_curvature", "Hₑ")):
        surface = read_ply(lab.folder / f"{name}-before.ply")
        bound = quantile([abs(x) for x in surface[column]], 0.9)
        for when, caption in captions.items():
            lab.picture(f"{name}-{when}-{column}", f"{label}, {caption}", "--color", column, "--up", up,
                        "--range", -bound, bound, of=f"{name}-{when}")


SMOOTHED = ["--smoothing", "6", "--attributes", "normal,mean_curvature,gaussian_curvature,affine_gaussian_curvature,"
            "affine_mean_curvature,affine_gaussian_curvature_error,affine_mean_curvature_error"]


@item("fig1", "The Stanford bunny and its image",
      "On a discretization of the distance to the Stanford bunny on a 129³ grid the estimated affine Gaussian curvatures "
      "correspond.")
def fig1(lab):
    if lab.bunny:
        points, triangles = read_off(lab.bunny)
    elif lab.is_small:  # any mesh will do to see that everything runs
        mesh = lab.mesh("banana", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", 24, "--attributes", "none")
        points, triangles = mesh.points, mesh.triangles
    else:
        return lab.fail("the mesh of the bunny", "it is not given: --bunny FILE, or scripts/reproduce, which fetches it")
    compare_distance_fields(lab, "bunny", points, triangles, unimodular(SHEAR), 129)
    draw(lab, "bunny", {"before": "the bunny", "after": "its image"}, "y")


BANANA = "(sqrt(x^2+y^2) - 1)^2 + z^2 - 0.09*(1 - (atan2(y,x)/1.2)^2)"
BANANA_BOX = [0.2, 1.37, -1.19, 1.2, -0.35, 0.36]


@item("fig12", "The banana and its images",
      "On a distance field to a banana on a 256³ grid Euclidean curvatures do not match through affine maps, but affine "
      "ones do.")
def fig12(lab):
    matrix = unimodular(SHEAR)
    n = lab.choose((176, 352, 110), (24, 40, 16))
    before = lab.mesh("formula-before", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", *n)
    after = lab.mesh("formula-after", "--function", transformed(BANANA, matrix), "--box",
                     *image_of_box(matrix, BANANA_BOX), "--resolution", lab.choose(264, 48))
    compare(lab, "banana, formula", before, after, 1.0, lab.choose(0.01, 0.05))
    draw(lab, "formula", {"before": "the banana", "after": "its image"}, "z")
    mesh = lab.mesh("banana", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", lab.choose(100, 32),
                    "--attributes", "none")
    compare_distance_fields(lab, "banana", mesh.points, mesh.triangles, matrix, 256)
