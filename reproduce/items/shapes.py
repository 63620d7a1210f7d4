# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes before and after affine maps: figures 1, 3 and 12."""

import math

from ..lab import item
from ..plot import histograms
from ..program import image, image_of_box, read_ply, transformed, words_of
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
    after = lab.evaluate([image(matrix, p) for p in surface.points], "--function", BLOBBY, "--transform",
                         *words_of(matrix))
    errors = []
    for i in range(len(surface)):
        if surface["status"][i] != 0 or after["status"][i] != "regular":
            continue
        K, H = surface["affine_gaussian_curvature"][i], surface["affine_mean_curvature"][i]
        scale = abs(K) + H * H
        errors.append(max(abs(after["affine_gaussian_curvature"][i] - K) / scale,
                          abs(after["affine_mean_curvature"][i] - H) / math.sqrt(scale)))
    lab.check("99 % of the vertices: relative change of K and H under a map of determinant 1", quantile(errors, 0.99),
              "<=",
              1e-10)
    with open(lab.folder / "curves.obj", encoding="ascii") as file:
        points = [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]
    on_curve = lab.evaluate(points, "--function", BLOBBY, "--attributes", "gaussian_curvature")["gaussian_curvature"]
    typical = quantile([abs(k) for k in surface["gaussian_curvature"]], 0.5)
    lab.check("greatest |Kₑ| on the degenerate curve, over its median on the surface", max(map(abs,
                                                                                               on_curve)) / typical,
              "<=", 1e-11)


def distances(before, after, scale=1.0, are_used=(None, None)):
    """Kolmogorov-Smirnov and Wasserstein distance of the distributions before and after a map of |determinant| `scale`,
    and the distributions, by the names of the curvatures."""
    result = {}
    for affine, euclidean, K, K_e, power in PAIRS:
        for column, label, factor in ((affine, K, scale**power), (euclidean, K_e, 1.0)):
            pair = [surface.distribution(column, weight, is_used) for surface, weight, is_used in zip(
                (before, after), (1.0, factor), are_used)]
            result[label] = kolmogorov_smirnov(*pair), scaled_wasserstein(*pair), pair
    return result


def tabulate(lab, name, found):
    lab.table([name, "Kolmogorov-Smirnov", "Wasserstein, of x / (m + |x|), m the median of |x|"],
              [[label, ks, w] for label, (ks, w, _) in found.items()])


def compare(lab, name, found, bound, paper=None):
    """Affine distances have to be below `bound` times the Euclidean ones; `paper` is what the paper's method has."""
    for _, _, K, K_e, _ in PAIRS:
        for i, kind in enumerate(("Kolmogorov-Smirnov", "Wasserstein")):
            lab.check(f"{name}: {kind} distance of {K} before and after, over that of {K_e}",
                      found[K][i] / found[K_e][i], "<=", bound,
                      paper and paper[K][i] / paper[K_e][i])
        for label in (K, K_e):
            pair = found[label][2]
            file = f"{name}-{label}".replace(",", "").replace(" ", "-").replace("ₑ", "_e")
            low, high = pair[0].quantile(0.05), pair[0].quantile(0.95)
            lab.plot(file, histograms(list(zip(("before", "after"), pair)), label, low, high),
                     f"{name}: distribution of {label}")
    tabulate(lab, name, found)


def read_off(path):
    numbers = path.read_text(encoding="ascii").split()
    n_points, n_faces = int(numbers[1]), int(numbers[2])
    points = [tuple(map(float, numbers[4 + 3 * i : 7 + 3 * i])) for i in range(n_points)]
    faces = numbers[4 + 3 * n_points :]
    return points, [tuple(map(int, faces[4 * i + 1 : 4 * i + 4])) for i in range(n_faces)]


def write_off(path, points, triangles):
    rows = [f"OFF\n{len(points)} {len(triangles)} 0"]
    rows += [f"{x!r} {y!r} {z!r}" for x, y, z in points]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(rows) + "\n", encoding="ascii")


def cubic_voxels(points, nodes):
    """The box of `--distance-to` with that many nodes along its longest side, and voxels that are cubes."""
    lengths = [max(p[axis] for p in points) - min(p[axis] for p in points) for axis in range(3)]
    lengths = [length + 0.2 * max(lengths) for length in lengths]
    return [max(16, round(nodes * length / max(lengths))) for length in lengths]


def trusted(surface):
    """Where the error estimates are less than half of K and of H."""
    columns = (surface[c] for c in ("affine_gaussian_curvature", "affine_gaussian_curvature_error",
                                    "affine_mean_curvature",
                                    "affine_mean_curvature_error", "status"))
    return [s == 0 and e < 0.5 * abs(x) and f < 0.5 * abs(y) for x, e, y, f, s in zip(*columns)]


def distance_field(lab, name, points, triangles, nodes):
    """Samples the distance to a mesh, `name`.nrrd."""
    write_off(lab.folder / (name + ".off"), points, triangles)
    lab.program.run("sample", "--distance-to", name + ".off", "--resolution", *cubic_voxels(points, lab.choose(nodes,
                                                                                                               32)),
                    "-o", name + ".nrrd")


def compare_field_with_image(lab, name, matrix, smoothing):
    """The surface of `name`.nrrd and its image, where the error estimates can be trusted; and by the paper's method."""
    words = ["--volume", name + ".nrrd"]
    moved = ["--transform", *words_of(matrix)]
    smoothed = [*words, "--smoothing", lab.choose(smoothing, 3), *WITH_ERRORS]
    before, after = lab.mesh(name + "-before", *smoothed), lab.mesh(name + "-after", *smoothed, *moved)
    are_used = trusted(before), trusted(after)
    paper = [*words, "--spline-scheme", "paper", "--vertices", "linear", "--estimator", "transformation"]
    by_paper = distances(lab.mesh("paper-before", *paper), lab.mesh("paper-after", *paper, *moved))
    compare(lab, f"{name}, distance field", distances(before, after, 1.0, are_used), 1 / 3, by_paper)
    lab.say(f"Samples smoothed over {lab.choose(smoothing, 3)} voxels; {100 * sum(are_used[0]) / len(before):.0f} % "
            f"of the "
            f"{len(before)} vertices have error estimates below half of K and of H, and are compared. The image is "
            f"that of "
            "the field, with derivatives in space: what is measured is the estimator, whatever noise the field has.")


def draw(lab, name, captions, up):
    """K and H of the surface before and after, on one scale each."""
    for column, label in (("affine_gaussian_curvature", "K"), ("affine_mean_curvature", "H"), ("mean_curvature", "Hₑ")):
        surface = read_ply(lab.folder / f"{name}-before.ply")
        bound = quantile([abs(x) for x in surface[column]], 0.7)
        for when, caption in captions.items():
            lab.picture(f"{name}-{when}-{column}", f"{label}, {caption}", "--color", column, "--up", up,
                        "--range", -bound, bound, of=f"{name}-{when}")


WITH_ERRORS = [
    "--attributes",
    "normal,mean_curvature,gaussian_curvature,affine_gaussian_curvature,affine_mean_curvature,"
    "affine_gaussian_curvature_error,affine_mean_curvature_error",
]


@item("fig1", "The Stanford bunny and its image",
      "On a discretization of the distance to the Stanford bunny on a 129³ grid the estimated affine Gaussian "
      "curvatures correspond.")
def fig1(lab):
    if lab.bunny:
        points, triangles = read_off(lab.bunny)
    elif lab.is_small:  # any mesh will do to see that everything runs
        mesh = lab.mesh("mesh", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", 32, "--attributes", "none")
        points, triangles = mesh.points, mesh.triangles
    else:
        return lab.fail("the mesh of the bunny", "it is not given: --bunny FILE, or scripts/reproduce, which "
                                                 "fetches it")
    matrix, smoothing = unimodular(SHEAR), 24
    distance_field(lab, "bunny", points, triangles, 129)
    compare_field_with_image(lab, "bunny", matrix, smoothing)
    draw(lab, "bunny", {"before": "the bunny", "after": "its image"}, "y")
    distance_field(lab, "moved", [image(matrix, p) for p in points], triangles, 129)
    before = read_ply(lab.folder / "bunny-before.ply")
    afresh = lab.mesh("moved", "--volume", "moved.nrrd", "--smoothing", lab.choose(smoothing, 3), *WITH_ERRORS)
    are_used = trusted(before), trusted(afresh)
    if sum(are_used[1]) > len(afresh) / 2:
        tabulate(lab, "distances to the moved mesh, measured afresh", distances(before, afresh, 1.0, are_used))
    lab.say("A scale of 24 voxels cuts off the ears, which are thinner: at smaller ones the facets of the mesh leave "
            "few vertices whose affine curvatures can be trusted, 3 % at 16 voxels and below.")
    lab.say("The distance to the image is not the image of the distance: smoothing and distances are Euclidean. "
            "Where the last table is, it is of another surface near the same facets, whose affine curvatures, "
            "derivatives of order 4, need not agree better than the Euclidean ones.")


BANANA = "(sqrt(x^2+y^2) - 1)^2 + z^2 - 0.09*(1 - (atan2(y,x)/1.2)^2)"
BANANA_BOX = [0.2, 1.37, -1.19, 1.2, -0.35, 0.36]


@item("fig12", "The banana and its images",
      "On a distance field to a banana on a 256³ grid Euclidean curvatures do not match through affine maps, but "
      "affine ones do.")
def fig12(lab):
    matrix = unimodular(SHEAR)
    n = lab.choose((176, 352, 110), (24, 40, 16))
    before = lab.mesh("formula-before", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", *n)
    after = lab.mesh("formula-after", "--function", transformed(BANANA, matrix), "--box",
                     *image_of_box(matrix, BANANA_BOX), "--resolution", lab.choose(264, 48))
    compare(lab, "banana, formula", distances(before, after), lab.choose(0.01, 0.3))
    draw(lab, "formula", {"before": "the banana", "after": "its image"}, "z")
    mesh = lab.mesh("mesh", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", lab.choose(100, 32),
                    "--attributes", "none")
    distance_field(lab, "banana", mesh.points, mesh.triangles, 256)
    compare_field_with_image(lab, "banana", matrix, 8)
