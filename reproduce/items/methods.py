# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's methods to compute the affine structure from derivatives, and ours: figures 5, 9, 11 and table 1."""

import math

from .. import invariance
from ..lab import item, number
from ..maps import image_of_box, transformed
from ..program import write_ply
from ..statistics import median, quantile
from ..surfaces import TORUS, TORUS_BOX

WAYS = {
    "direct_z": "direct, always z",
    "direct": "direct, best axis",
    "transformation": "transformation",
    "compact": "compact (ours)",
}
LABELS = {**WAYS, "printed": "direct, best axis, ξ₁ as printed"}


@item("fig5", "Affine normals by four methods",
      "With z always in the role of the graph's direction (left) and with the axis closest to the gradient (middle) "
      "the affine normal is unstable; the geometric reduction (right) corrects it.")
def fig5(lab):
    surface = lab.mesh("ellipsoid", "--function", "x^2/9 + y^2 + z^2/0.09 = 1", "--box", -3.3, 3.4, -1.2, 1.3, -0.4,
                       0.41, "--resolution", lab.choose(72, 16), "--attributes", "normal")
    estimates = lab.estimates("ellipsoid", points=surface.points)
    vectors = lambda way: list(zip(*(estimates[f"{way}_xi_{axis}"] for axis in "xyz")))
    exact = vectors("reference")
    errors = {}
    for way in [*WAYS, "printed"]:
        errors[way] = [math.dist(a, b) / math.hypot(*b) for a, b in zip(vectors(way), exact)]
        errors[way] = [min(1.0, e) if e == e else 1.0 for e in errors[way]]  # NaN if f_z = 0
        columns = {name: surface[name] for name in ("x", "y", "z", "nx", "ny", "nz")}
        columns["log10_of_relative_error"] = [math.log10(max(e, 1e-17)) for e in errors[way]]
        write_ply(lab.folder / (way + ".ply"), columns, surface.triangles)
    for way in ("direct_z", "direct", "printed", "transformation", "compact"):
        lab.picture(way, f"{LABELS[way]}: maximum error {number(max(errors[way]))}", "--color",
                    "log10_of_relative_error", "--range", -17, -9)
    lab.check("maximum relative error of ξ, compared with the paper's best method", max(errors["compact"]), "<=",
              max(errors["transformation"]), max(errors["transformation"]))
    lab.table(["method", "maximum error", "error for 99 % of the vertices", "median error"],
              [[LABELS[way], max(e), quantile(e, 0.99), median(e)] for way, e in errors.items()])
    lab.say("The surface is an ellipsoid with semi-axes 3, 1, 0.3, with exact derivatives of order 4. Errors are "
            "relative to results in long double; an error of 1 means that there is no normal. In double precision and "
            "with its misprint corrected, the direct method is accurate with the best axis. With ξ₁ as printed it is "
            "wrong nearly everywhere, and its error jumps where the axis changes, which could explain the middle of "
            "the figure.")


@item("table1", "Operation counts",
      "9,867 floating-point operations for the transformation method (749 for the matrices, 7,335 for mapping the "
      "derivatives, 1,783 for the formulas), 23,690 for the direct one.")
def table1(lab):
    count = lab.estimates("operations")
    formulas = count["transformation"] - count["matrices"] - count["mapping"]
    lab.check("operations to compute ν, ξ, K, H and J from derivatives", count["compact"], "<=", 340,
              count["transformation"])
    lab.check("ratio to the 9,867 operations of the paper", 9867 / count["compact"], ">=", 29)
    lab.check("operations that map the derivatives, counted as in the paper", count["mapping"], "==", 7335,
              count["mapping"])
    lab.table(["", "matrices", "mapping", "formulas", "total", "direct"], [
        ["printed", "749", "7,335", "1,783", "9,867", "23,690"],
        ["the same methods here", *(f"{n:,}" for n in (count["matrices"], count["mapping"], formulas,
                                                       count["transformation"], count["direct"]))],
        ["pivot and shear, with J (ours)", "–", "–", "–", str(count["compact"]), "–"],
    ])
    lab.say("Each method is run with a number type that counts additions, multiplications, divisions and functions, "
            "one each.")


@item("fig9", "The sine surface: false discontinuities of H",
      "Direct and transformation method both show a discontinuity where Kₑ = 0, but the direct method artificially "
      "includes more.")
def fig9(lab):
    words = ["--function", "2*z^2 - sin(5*x + 3*y^2 - 1)", "--box", -1.1, 1, -1.1, 1.2, -2, 2,
             "--resolution", lab.choose(128, 32), "--attributes", "normal,gaussian_curvature,affine_mean_curvature"]
    surface = lab.mesh("sine", *words)
    estimates = lab.estimates("sine", points=surface.points)
    exact = estimates["reference_H"]
    regular, gaussian = surface.is_regular(), surface["gaussian_curvature"]
    edges = [(a, b) for t in surface.triangles for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])) if a < b]
    edges = [(a, b) for a, b in edges if regular[a] and regular[b] and (gaussian[a] < 0) == (gaussian[b] < 0)]

    def false_jumps(values):
        """The number of edges that do not cross a parabolic curve, and along which the change of H is wrong by at least
        a tenth of its values."""
        return sum(not abs((values[a] - values[b]) - (exact[a] - exact[b])) <= 0.1 * (abs(exact[a]) + abs(exact[b]))
                   for a, b in edges)

    counts = {way: false_jumps(estimates[way + "_H"]) for way in LABELS}
    bound = quantile([abs(h) for h in exact], 0.8)
    scale = ["--color", "affine_mean_curvature", "--range", -bound, bound]
    columns = {name: surface[name] for name in ("x", "y", "z", "nx", "ny", "nz")}
    write_ply(lab.folder / "printed.ply", {**columns, "affine_mean_curvature": estimates["printed_H"]},
              surface.triangles)
    lab.picture("printed", f"H, {LABELS['printed']}: {counts['printed']:,} false jumps", *scale)
    for way in ("direct", "transformation", "compact"):
        lab.mesh(way, *words, "--estimator", way, "--parabolic-curves", way + ".obj", "--png", way + ".png", *scale,
                 *lab.size)
        lab.pictured(way, f"H, {LABELS[way]}: {counts[way]:,} false jumps. Parabolic curves are black")
    lab.check("edges with a false jump of H", counts["compact"], "==", 0, counts["printed"])
    lab.table(["method", "edges with a false jump", "edges"],
              [[LABELS[way], n, len(edges)] for way, n in counts.items()])
    lab.say("The paper's method here is the direct one with ξ₁ as printed, whose error jumps where the axis changes. "
            "With the misprint corrected and the same exact derivatives, the direct, transformation and compact "
            "methods differ only by rounding, and none of them has a false discontinuity in double precision.")


@item("fig11", "The torus before and after an affine map",
      "The distribution of K is better preserved under [[1.4, -0.2, 0], [0.1, 0.7, 0], [0, 0, 1]] with the "
      "transformation method than with the direct one.")
def fig11(lab):
    matrix = [[1.4, -0.2, 0.0], [0.1, 0.7, 0.0], [0.0, 0.0, 1.0]]
    resolution = ["--resolution", *lab.choose((160, 160, 60), (48, 48, 18))]
    sources = {"before": ["--function", TORUS, "--box", *TORUS_BOX, *resolution],
               "after": ["--function", transformed(TORUS, matrix), "--box", *image_of_box(matrix, TORUS_BOX),
                         *resolution]}
    attributes = ["--attributes", "normal,gaussian_curvature,affine_gaussian_curvature"]
    meshes = {when: lab.mesh(when, *words, *attributes) for when, words in sources.items()}
    on_grid = ["--derivatives", "spline", "--spline-scheme", "paper"]
    ways = {"compact (ours)": [], "transformation": ["--estimator", "transformation"],
            "direct": ["--estimator", "direct"],
            "the paper's grid derivatives, transformation": [*on_grid, "--estimator", "transformation"],
            "the paper's grid derivatives, direct": [*on_grid, "--estimator", "direct"]}
    found = {}
    for i, (way, options) in enumerate(ways.items()):
        samples = [invariance.sampled(lab, f"samples-{i}-{when}", meshes[when], *words, *options, *attributes)
                   for when, words in sources.items()]
        found[way] = invariance.compared(*samples, symbols=("K", "Kₑ") if i == 0 else ("K",))
    ours, paper = (found[way] for way in ("compact (ours)", "the paper's grid derivatives, transformation"))
    for i, kind in enumerate(invariance.KINDS):
        lab.check(f"{kind} distance of K before and after, relative to that of Kₑ", ours["K"][i] / ours["Kₑ"][i], "<=",
                  lab.choose(0.01, 0.1), paper["K"][i] / ours["Kₑ"][i])
    lab.table(["", invariance.KINDS[0], f"{invariance.KINDS[1]}, of x / (m + |x|), m the median of |x|"],
              [*([f"K, {way}", *each["K"][:2]] for way, each in found.items()), ["Euclidean Kₑ", *ours["Kₑ"][:2]]])
    for name, caption, symbol, pair in (
        ("ours", "K, ours", "K", ours["K"][2]), ("euclidean", "the Euclidean Kₑ", "Kₑ", ours["Kₑ"][2]),
        ("paper", "K, the paper's grid derivatives, transformation method", "K", paper["K"][2])):
        lab.plot(name, invariance.histogram_of_bounded(pair, symbol), f"Distribution of {caption}")
    bound = quantile([abs(K) for K in meshes["before"]["affine_gaussian_curvature"]], 0.7)
    for when, caption in (("before", "K on the torus"), ("after", "K on its image")):
        lab.mesh("pictured", *sources[when], *attributes, "--parabolic-curves", "curves.obj", "--png", when + ".png",
                 "--color", "affine_gaussian_curvature", "--range", -bound, bound, *lab.size)
        lab.pictured(when, caption + "; parabolic curves are black")
    lab.say("The image is meshed independently, from its own formula on a grid parallel to the axes. The formula of "
            "the figure, z² - (√(x²+y²) - 0.5)² = 0, describes two cones; this torus has the minor radius 0.2. With "
            "the misprint of ξ₁ corrected, the direct method preserves the distribution as well as the transformation "
            "method.")
