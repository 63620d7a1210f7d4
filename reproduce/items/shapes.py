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
    lab.pictured("normals", "The affine normal ξ; it tends to infinity at the black degenerate curves, where long arrows "
                            "are truncated")
    lab.pictured("K", "K; it changes its sign through infinity at the degenerate curve, and through zero")
    lab.pictured("H", "H")

    after = lab.evaluate_many("after", image_of_points(SHEAR, surface), "--function", BLOBBY, "--transform",
                              *words_of(SHEAR))
    errors = []
    for i, is_regular in enumerate(surface.is_regular()):
        if is_regular:
            (K, K1), (H, H1) = ((surface[column][i], after[column][i]) for column in curvatures)
            scale = abs(K) + H * H
            errors.append(max(abs(K1 - K) / scale, abs(H1 - H) / math.sqrt(scale)))
    lab.check("relative change of K and H under a map of determinant 1, for 99 % of the vertices",
              quantile(errors, 0.99), "<=", 1e-10)
    on_curve = lab.evaluate(read_curve_points(lab.folder / "curves.obj"), "--function", BLOBBY,
                            "--attributes", "gaussian_curvature")["gaussian_curvature"]
    lab.check("maximum |Kₑ| on the degenerate curve, relative to its median on the surface",
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
    """The resolution for cubic voxels in the box of `--distance-to`, with `nodes` nodes along its longest side."""
    lengths = [max(p[axis] for p in points) - min(p[axis] for p in points) for axis in range(3)]
    lengths = [length + 0.2 * max(lengths) for length in lengths]
    return [max(16, round(nodes * length / max(lengths))) for length in lengths]


def sample_distance(lab, name, points, triangles, nodes):
    """Samples the distance to a mesh in `name`.nrrd."""
    write_off(lab.folder / (name + ".off"), points, triangles)
    lab.program.run("sample", "--distance-to", name + ".off", "--resolution", *cubic_voxels(points, nodes),
                    "-o", name + ".nrrd")


PAPER = ["--spline-scheme", "paper", "--estimator", "transformation", "--attributes", f"normal,{invariance.CURVATURES}"]
ERRORS = "affine_gaussian_curvature_error,affine_mean_curvature_error"


def trusted(samples):
    """Whether the estimated errors are less than half of K and of H at each point."""
    columns = (samples[name] for column in ("affine_gaussian_curvature", "affine_mean_curvature")
               for name in (column, f"{column}_error"))
    return [s == 0 and e < 0.5 * abs(K) and f < 0.5 * abs(H) for K, e, H, f, s in zip(*columns, samples["status"])]


def field_samples(lab, name, words, method=()):
    """The surface of a distance field or a fit, its curvatures, and where they are trusted."""
    surface = lab.mesh(name, *words, *method, "--attributes", f"normal,gaussian_curvature,{invariance.CURVATURES}")
    samples = invariance.sampled(lab, name + "-samples", surface, *words, "--attributes",
                                 f"{invariance.CURVATURES},{ERRORS}")
    return surface, samples, trusted(samples)


def compare_field_with_image(lab, name, smoothing, radius):
    """Compares the surface of `name`.nrrd with its image, where the curvatures are trusted, and the paper's method at
    the same points. The image has a Delaunay mesh, since Marching Cubes on the mapped grid would return the images of
    the vertices."""
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
    lab.say(f"The samples are smoothed with a scale of {smoothing} voxels. The comparison uses {100 * shares[0]:.0f} % "
            f"of the area of the surface and {100 * shares[1]:.0f} % of that of the image, where the estimated errors "
            "are below half of K and of H. The image is that of the field, meshed independently, so the result "
            "measures the estimator and not the noise of the field. The paper's method, which does not smooth, is "
            "measured at the same points.")
    return surface, before, is_used


def draw(lab, name, captions, up):
    """Draws K, H and H_e of the surfaces `name`-before and `name`-after, with the color range of the first."""
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
    elif lab.is_small:  # a test only needs some mesh
        mesh = lab.mesh("mesh", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", 32, "--attributes", "none")
        points, triangles = mesh.points, mesh.triangles
    else:
        raise RuntimeError("the mesh of the bunny is missing; give --bunny FILE, or run scripts/reproduce")
    nodes, scale = lab.choose((129, 0.18), (40, 0.5))
    sample_distance(lab, "bunny", points, triangles, nodes)  # also writes bunny.off
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
        lab.pictured("paper-" + when, f"K by the paper's method on the distance field, {when} the map; it shows the "
                                      "facets of the mesh")
    shares = [invariance.used_share(*each) for each in zip((before, after), masks)]
    lab.say(f"Polynomials of degree 4 are fitted to the vertices within {scale}, independently for the image, whose "
            "vertices are the images of those of the bunny. A scan has detail at every scale; the curvatures are those "
            f"at this scale. The comparison uses {100 * shares[0]:.0f} % of the area of the bunny and "
            f"{100 * shares[1]:.0f} % of that of the image, where the errors are less than half of K and of H. The "
            "paper's method is measured at the same points, on a grid of the distance that is mapped with the bunny.")


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
    lab.check("banana, formula: fraction of the area where all curvatures exist",
              min(map(invariance.used_share, samples)), ">=", 0.99)
    invariance.plot_distributions(lab, "banana, formula", found)
    invariance.tabulate(lab, "banana, formula", found)
    draw(lab, "formula", {"before": "the banana", "after": "its image"}, "z")

    mesh = lab.mesh("mesh", "--function", BANANA, "--box", *BANANA_BOX, "--resolution", lab.choose(100, 32),
                    "--attributes", "none")
    sample_distance(lab, "banana", mesh.points, mesh.triangles, voxels)
    compare_field_with_image(lab, "banana", smoothing, radius)
