# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's ways from derivatives to the affine structure against ours: figures 5, 9, 11 and table 1."""

import math

from ..lab import item, number
from ..plot import histograms
from ..program import image_of_box, transformed, write_ply
from ..statistics import kolmogorov_smirnov, quantile, scaled_wasserstein

WAYS = {
    "direct_z": "direct, always z",
    "direct": "direct, best axis",
    "transformation": "transformation",
    "compact": "compact (ours)",
}


@item("fig5", "Affine normals by four methods",
      "With z always in the role of the graph's direction (left) and with the axis closest to the gradient (middle) "
      "the affine normal is unstable; the geometric reduction (right) corrects it.")
def fig5(lab):
    surface = lab.mesh("ellipsoid", "--function", "x^2/9 + y^2 + z^2/0.09 = 1", "--box", -3.3, 3.4, -1.2, 1.3, -0.4,
                       0.41,
                       "--resolution", lab.choose(72, 16), "--attributes", "normal,gaussian_curvature")
    estimates = lab.estimates("ellipsoid", points=surface.points)
    vectors = lambda way: list(zip(*(estimates[f"{way}_xi_{axis}"] for axis in "xyz")))
    exact = vectors("reference")
    errors = {}
    for way in [*WAYS, "printed"]:
        errors[way] = [min(1.0, math.dist(a, b) / math.hypot(*b)) if all(map(math.isfinite, a)) else 1.0
                       for a, b in zip(vectors(way), exact)]
    for way, label in WAYS.items():
        logs = [math.log10(max(e, 1e-17)) for e in errors[way]]
        write_ply(lab.folder / (way + ".ply"), surface, {"nx": surface["nx"], "ny": surface["ny"], "nz": surface["nz"],
                                                          "log10_of_relative_error": logs})
        lab.picture(way, f"{label}: greatest error {number(max(errors[way]))}", "--color", "log10_of_relative_error",
                    "--range", -17, -9)
    best = max(errors["transformation"])
    paper = ", ".join(f"{number(max(errors[way]))} {WAYS[way]}" for way in ("direct_z", "direct", "transformation"))
    lab.check("greatest relative error of ξ, no more than by the paper's best way", max(errors["compact"]), "<=",
              best, paper)
    lab.table(["way", "greatest error", "99 % of the vertices", "median"],
              [[WAYS.get(way, "direct, best axis, ξ₁ as printed"), max(e), quantile(e, 0.99), quantile(e, 0.5)]
               for way, e in errors.items()])
    lab.say("An ellipsoid of axes 3, 1, 0.3, with exact derivatives of order 4, against numbers of 64 bits. In "
            "double precision and with its misprint corrected the direct method is accurate where the axis is "
            "chosen. With ξ₁ as printed it is wrong nearly everywhere, and its error jumps where the axis changes, "
            "which would explain the middle of the figure.")


@item("table1", "Operation counts",
      "9,867 floating-point operations for the transformation method (749 for the matrices, 7,335 for mapping the "
      "derivatives, 1,783 for the formulas), 23,690 for the direct one.")
def table1(lab):
    count = lab.estimates("operations")
    formulas = count["transformation"] - count["matrices"] - count["mapping"]
    lab.check("operations from derivatives to ν, ξ, K, H, with J", count["compact"], "<=", 321, count["transformation"])
    lab.check("times fewer than the paper's count of its best method", 9867 / count["compact"], ">=", 30)
    lab.check("operations that map the derivatives, counted as in the paper", abs(count["mapping"] - 7335), "<=", 0)
    lab.table(["", "matrices", "mapping", "formulas", "total", "direct"], [
        ["printed", "749", "7,335", "1,783", "9,867", "23,690"],
        ["the same methods here", *(f"{n:,}" for n in (count["matrices"], count["mapping"], formulas,
                                                       count["transformation"], count["direct"]))],
        ["pivot and shear, with J (ours)", "–", "–", "–", str(count["compact"]), "–"],
    ])
    lab.say("Counted by running each method on a number that counts: additions, multiplications, divisions and "
            "functions, one each.")


@item("fig9", "The sine surface: false discontinuities of H",
      "Direct and transformation method both show a discontinuity where Kₑ = 0, but the direct method artificially "
      "includes more.")
def fig9(lab):
    words = ["--function", "2*z^2 - sin(5*x + 3*y^2 - 1)", "--box", -1.1, 1, -1.1, 1.2, -2, 2,
             "--resolution", *lab.choose((128, 128, 128), (32, 32, 32)),
             "--attributes", "normal,gaussian_curvature,affine_mean_curvature"]
    surface = lab.mesh("sine", *words)
    estimates = lab.estimates("sine", points=surface.points)
    exact = estimates["reference_H"]
    regular, gaussian = surface.is_regular(), surface["gaussian_curvature"]
    edges = [(a, b) for t in surface.triangles for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])) if a < b]
    edges = [(a, b) for a, b in edges if regular[a] and regular[b] and (gaussian[a] < 0) == (gaussian[b] < 0)]

    def false_jumps(values):
        """Edges that cross no parabolic curve, along which the change is wrong by a tenth of the numbers."""
        return sum(
            not abs((values[a] - values[b]) - (exact[a] - exact[b])) <= 0.1 * (abs(exact[a]) + abs(exact[b]))
            for a, b in edges
        )

    counts = {way: false_jumps(estimates[way + "_H"]) for way in [*WAYS, "printed"]}
    labels = {**WAYS, "printed": "direct, best axis, ξ₁ as printed"}
    bound = quantile([abs(h) for h in exact], 0.8)
    for way in ["direct", "transformation", "compact"]:
        lab.mesh(way, *words, "--estimator", way, "--parabolic-curves", way + ".obj", "--png", way + ".png",
                 "--color", "affine_mean_curvature", "--range", -bound, bound, "--size", *lab.picture_size)
        lab.pictured(way, f"H, {labels[way]}: {counts[way]} false jumps. Black: the parabolic curves")
    write_ply(lab.folder / "printed.ply", surface,
              {"nx": surface["nx"], "ny": surface["ny"], "nz": surface["nz"], "H": estimates["printed_H"]})
    lab.picture("printed", f"H, {labels['printed']}: {counts['printed']} false jumps", "--color", "H",
                "--range", -bound, bound)
    lab.check("edges with a false jump of H", counts["compact"], "<=", 0,
              f"direct: {counts['printed']} as printed, {counts['direct']} corrected; transformation: "
              f"{counts['transformation']}")
    lab.table(["way", "edges with a false jump", "of"], [[labels[way], n, len(edges)] for way, n in counts.items()])
    lab.say("With the same exact derivatives direct, transformation and compact method are the same function: they "
            "differ by rounding alone, and none of them has a false discontinuity in double precision. The formula "
            "for ξ₁ as printed has: its error changes where the axis does.")


@item("fig11", "The torus before and after an affine map",
      "The distribution of K is better preserved under [[1.4, -0.2, 0], [0.1, 0.7, 0], [0, 0, 1]] with the "
      "transformation method than with the direct one.")
def fig11(lab):
    expression, box = "z^2 + (sqrt(x^2+y^2) - 0.5)^2 - 0.2^2", [-0.76, 0.75, -0.75, 0.76, -0.26, 0.25]
    matrix = [[1.4, -0.2, 0.0], [0.1, 0.7, 0.0], [0.0, 0.0, 1.0]]
    resolution = ["--resolution", *lab.choose((128, 128, 64), (32, 32, 16))]
    image_words = ["--function", transformed(expression, matrix), "--box", *image_of_box(matrix, box), *resolution]

    def distances(name, *words):
        before = lab.mesh(name + "-before", "--function", expression, "--box", *box, *resolution, *words)
        after = lab.mesh(name + "-after", *image_words, *words)
        return before, after, [surface.distribution("affine_gaussian_curvature") for surface in (before, after)]

    results = {way: distances(way, "--estimator", way) for way in ("direct", "transformation", "compact")}
    paper_words = ["--derivatives", "spline", "--spline-scheme", "paper", "--vertices", "linear"]
    for way in ("direct", "transformation"):
        results["grid-" + way] = distances("grid-" + way, *paper_words, "--estimator", way)
    rows, affine = [], {}
    for way, (_, _, pair) in results.items():
        affine[way] = kolmogorov_smirnov(*pair)
        rows.append([way.replace("grid-", "the paper's grid derivatives, "), affine[way], scaled_wasserstein(*pair)])
    euclidean_pair = [surface.distribution("gaussian_curvature") for surface in results["compact"][:2]]
    euclidean = kolmogorov_smirnov(*euclidean_pair)
    rows.append(["Euclidean Kₑ, for comparison", euclidean, scaled_wasserstein(*euclidean_pair)])
    lab.check("Kolmogorov-Smirnov distance of K before and after, over that of Kₑ", affine["compact"] / euclidean, "<=",
              lab.choose(0.01, 0.1), affine["grid-transformation"] / euclidean)
    lab.table(["K by", "Kolmogorov-Smirnov distance", "Wasserstein distance of K / (m + |K|), m the median of |K|"],
              rows)
    exact = results["compact"][2][0]
    for title, way in (("ours", "compact"), ("the paper's grid derivatives, transformation method",
                                             "grid-transformation")):
        lab.plot(way, histograms(list(zip(("before", "after"), results[way][2])), "K", min(0.0, exact.quantile(0.02)),
                                 exact.quantile(0.9)), f"Distribution of K, {title}, weighted by affine area")
    lab.plot("euclidean", histograms(list(zip(("before", "after"), euclidean_pair)), "Kₑ",
                                     euclidean_pair[0].quantile(0.02),
                                     euclidean_pair[0].quantile(0.98)), "Distribution of the Euclidean Kₑ")
    for name, caption in (("compact-before", "K on the torus"), ("compact-after", "K on its image")):
        lab.picture(name, caption, "--color", "affine_gaussian_curvature")
    lab.say("The image is sampled afresh, as its own formula on a grid parallel to the axes. The torus of the figure, "
            "printed as z² - (√(x²+y²) - 0.5)² = 0, is a pair of cones; this one has the radius 0.2.")
