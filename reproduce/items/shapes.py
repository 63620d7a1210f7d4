# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes before and after affine maps: figures 1, 3 and 12."""

import math

from .. import invariance
from ..lab import item
from ..maps import SHEAR, image, image_of_box, image_of_points, transformed, words_of
from ..program import read_curve_points
from ..statistics import greatest, median_size, quantile
from ..surfaces import BANANA, BANANA_BOX, BLOBBY, BLOBBY_BOX


@item("fig3", "The blobby surface",
      "The affine normal ξ, the curvatures K and H, and in green the degenerate curve.")
def fig3(lab):
    words = ["--function", BLOBBY, "--box", *BLOBBY_BOX, "--resolution", lab.choose(128, 24)]
    curvatures = ["affine_gaussian_curvature", "affine_mean_curvature"]
    surface = lab.mesh("surface", *words)
    bounds = [quantile([abs(x) for x in surface[column]], 0.75) for column in curvatures]
    for name, *options in (("normals", "--color", "plain", "--arrows", "affine_normal"),
                           ("K", "--color", curvatures[0], "--range", -bounds[0], bounds[0]),
                           ("H", "--color", curvatures[1], "--range", -bounds[1], bounds[1])):
        lab.mesh(name, *words, "--parabolic-curves", "curves.obj", "--png", name + ".png", *options, *lab.size)
    lab.pictured("normals", "The affine normal ξ; it grows without bound towards the black degenerate curves, where "
                            "long arrows are cut to one length")
    lab.pictured("K", "K: the sign changes where it passes through infinity, on the degenerate curve, and through zero")
    lab.pictured("H", "H")

    after = lab.evaluate_many("after", image_of_points(SHEAR, surface), "--function", BLOBBY, "--transform",
                              *words_of(SHEAR))
    errors = []
    for i, is_regular in enumerate(surface.is_regular()):
        if is_regular:
            (K, K1), (H, H1) = ((surface[column][i], after[column][i]) for column in curvatures)
            scale = abs(K) + H * H
            errors.append(max(abs(K1 - K) / scale, abs(H1 - H) / math.sqrt(scale)))
    lab.check("99 % of the vertices: relative change of K and H under a map of determinant 1", quantile(errors, 0.99),
              "<=", 1e-10)
    on_curve = lab.evaluate(read_curve_points(lab.folder / "curves.obj"), "--function", BLOBBY,
                            "--attributes", "gaussian_curvature")["gaussian_curvature"]
    lab.check("greatest |Kₑ| on the degenerate curve, over its median on the surface",
              greatest(map(abs, on_curve)) / median_size(surface["gaussian_curvature"]), "<=", 1e-11)


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


def sample_distance(lab, name, points, triangles, nodes):
    """Samples the distance to a mesh, `name`.nrrd."""
    write_off(lab.folder / (name + ".off"), points, triangles)
    lab.program.run("sample", "--distance-to", name + ".off", "--resolution", *cubic_voxels(points, nodes),
                    "-o", name + ".nrrd")


PAPER = ["--spline-scheme", "paper", "--estimator", "transformation", "--attributes", f"normal,{invariance.CURVATURES}"]
ERRORS = "affine_gaussian_curvature_error,affine_mean_curvature_error"


def trusted(samples):
    """Where the estimated errors are less than half of K and of H."""
    columns = (samples[name] for column in ("affine_gaussian_curvature", "affine_mean_curvature")
               for name in (column, f"{column}_error"))
    return [s == 0 and e < 0.5 * abs(K) and f < 0.5 * abs(H) for K, e, H, f, s in zip(*columns, samples["status"])]


def field_samples(lab, name, words, method=()):
    """The surface of a distance field or a fit, its curvatures, and where they can be trusted."""
    surface = lab.mesh(name, *words, *method, "--attributes", f"normal,gaussian_curvature,{invariance.CURVATURES}")
    samples = invariance.sampled(lab, name + "-samples", surface, *words, "--attributes",
                                 f"{invariance.CURVATURES},{ERRORS}")
    return surface, samples, trusted(samples)


def compare_field_with_image(lab, name, smoothing, radius):
    """The surface of `name`.nrrd and its image, where the error estimates can be trusted; and by the paper's method at
    the same points. Marching Cubes would give the image the images of the vertices, since the grid of the volume goes
    along; a Delaunay mesh has its own."""
    volume, map_words = ["--volume", name + ".nrrd"], ["--transform", *words_of(SHEAR)]
    words = [*volume, "--smoothing", smoothing]
    surface, before, is_used = field_samples(lab, name + "-before", words)
    image_surface, after, is_used_after = field_samples(lab, name + "-after", [*words, *map_words],
                                                        ["--method", "delaunay", "--radius", radius])
    masks = is_used, is_used_after
    found = invariance.compared(before, after, masks)
    by_paper = [invariance.sampled(lab, f"{name}-paper-{when}", mesh, *volume, *PAPER, *moved) for when, mesh, moved in
                (("before", surface, []), ("after", image_surface, map_words))]
    title = f"{name}, distance field"
    invariance.require_invariance(lab, title, found, 1 / 3, invariance.compared(*by_paper, masks))
    invariance.plot_distributions(lab, title, found)
    invariance.tabulate(lab, title, found)
    shares = [invariance.used_share(*each) for each in zip((before, after), masks)]
    lab.say(f"Samples smoothed over {smoothing} voxels. {100 * shares[0]:.0f} % of the area, {100 * shares[1]:.0f} % "
            "of that of the image, have error estimates below half of K and of H, and are compared. The image is that "
            "of the field, meshed afresh: what is measured is the estimator, whatever noise the field has. The paper's "
            "method is measured at the same points, without smoothing, which it does not have.")
    return surface, before, is_used


def draw(lab, name, captions, up):
    """K, H and H_e of the surface `name`-before and of `name`-after, in the colors of the first."""
    for column, symbol in (("affine_gaussian_curvature", "K"), ("affine_mean_curvature", "H"),
                           ("mean_curvature", "Hₑ")):
        for when, caption in captions.items():
            lab.picture(f"{name}-{when}-{column}", f"{symbol}, {caption}", "--color", column, "--up", up,
                        "--range-of", f"{name}-before.ply", of=f"{name}-{when}")


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
        raise RuntimeError("the mesh of the bunny is not given: --bunny FILE, or scripts/reproduce, which fetches it")
    nodes, scale = lab.choose((129, 0.18), (40, 0.5))
    sample_distance(lab, "bunny", points, triangles, nodes)  # writes bunny.off, too
    write_off(lab.folder / "moved.off", [image(SHEAR, p) for p in points], triangles)
    surface, before, is_used = field_samples(lab, "bunny-before", ["--fit", "bunny.off", "--scale", scale])
    image_surface, after, is_used_after = field_samples(lab, "bunny-after", ["--fit", "moved.off", "--scale", scale])
    masks = is_used, is_used_after
    found = invariance.compared(before, after, masks)
    volume, map_words = ["--volume", "bunny.nrrd", *PAPER], ["--transform", *words_of(SHEAR)]
    by_paper = [invariance.sampled(lab, "bunny-paper-" + when, mesh, *volume, *moved)
                for when, mesh, moved in (("before", surface, []), ("after", image_surface, map_words))]
    invariance.require_invariance(lab, "bunny", found, 1 / 3, invariance.compared(*by_paper, masks))
    invariance.plot_distributions(lab, "bunny", found)
    invariance.tabulate(lab, "bunny", found)
    for when, mesh in (("before", "bunny.off"), ("after", "moved.off")):
        lab.program.run("annotate", mesh, "--scale", scale, "-o", f"scan-{when}.ply")
    draw(lab, "scan", {"before": "the bunny", "after": "its image"}, "y")
    for when, words in (("before", []), ("after", map_words)):
        lab.mesh("paper-" + when, *volume, "--vertices", "linear", *words, "--up", "y", "--png", f"paper-{when}.png",
                 "--color", "affine_gaussian_curvature", "--range-of", "scan-before.ply", *lab.size)
        lab.pictured("paper-" + when, f"K by the paper's method on the distance, {when} the map: it sees the facets of "
                                      "the mesh")
    shares = [invariance.used_share(*each) for each in zip((before, after), masks)]
    lab.say(f"Polynomials of degree 4 are fitted to the vertices within {scale}, afresh for the image: its vertices are "
            "those of the bunny after the map, and nothing else is known of it. A scan has detail at every scale, and "
            f"curvatures are those at this one. {100 * shares[0]:.0f} % of the area, {100 * shares[1]:.0f} % of that of "
            "the image, have errors of less than half of K and of H at that scale, and are compared. The paper's method "
            "is measured at the same points, on a grid of the distance that goes along with the map.")


@item("fig12", "The banana and its images",
      "On a distance field to a banana on a 256³ grid Euclidean curvatures do not match through affine maps, but "
      "affine ones do.")
def fig12(lab):
    n, m, voxels, smoothing, radius = lab.choose(((150, 300, 90), (460, 170, 160), 256, 8, 0.015),
                                                 ((30, 60, 18), (92, 34, 32), 40, 6, 0.08))
    formula = ["--attributes", invariance.CURVATURES, "--function"]
    image_of_formula = transformed(BANANA, SHEAR)
    before = lab.mesh("formula-before", *formula, BANANA, "--box", *BANANA_BOX, "--resolution", *n)
    after = lab.mesh("formula-after", *formula, image_of_formula, "--box", *image_of_box(SHEAR, BANANA_BOX),
                     "--resolution", *m)
    samples = (invariance.sampled(lab, "samples-before", before, *formula, BANANA),
               invariance.sampled(lab, "samples-after", after, *formula, image_of_formula))
    found = invariance.compared(*samples)
    invariance.require_invariance(lab, "banana, formula", found, lab.choose(0.01, 0.1))
    lab.check("banana, formula: share of the area where all curvatures exist", min(map(invariance.used_share, samples)),
              ">=", 0.99)
    invariance.plot_distributions(lab, "banana, formula", found)
    invariance.tabulate(lab, "banana, formula", found)
    draw(lab, "formula", {"before": "the banana", "after": "its image"}, "z")

    mesh = lab.mesh("mesh", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", lab.choose(100, 32),
                    "--attributes", "none")
    sample_distance(lab, "banana", mesh.points, mesh.triangles, voxels)
    compare_field_with_image(lab, "banana", smoothing, radius)
