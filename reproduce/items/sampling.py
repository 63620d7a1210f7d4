# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives from samples on a grid, section 4: figures 7, 8 and 10."""

import math

from ..lab import item
from ..plot import Series, plot
from ..program import determinant, image_of_box, transformed
from ..statistics import median, slope

MATRIX = [[0.9, 0.0, 0.9], [0.0, 2.0, 0.0], [1.1, 0.0, 0.6]]  # of figure 8; its determinant is -0.9
PAPER = ["--derivatives", "spline", "--spline-scheme", "paper", "--vertices", "linear"]
OURS = ["--derivatives", "spline"]
CURVATURES = ["--attributes", "gaussian_curvature,affine_gaussian_curvature,affine_mean_curvature"]


def printed_spline(t):
    """σ₁ as printed in section 4(a)."""
    t = abs(t)
    terms = [(3 - t) ** 5, -6 * (2 - t) ** 5, 15 * (1 - t) ** 5]
    return sum(terms[: 3 - int(t)]) / 60 if t < 3 else 0.0


def bspline(degree, t):
    """The centred B-spline by the recursion of Cox and de Boor."""
    if degree == 0:
        return 1.0 if -0.5 <= t < 0.5 else 0.0
    half = (degree + 1) / 2
    return ((half + t) * bspline(degree - 1, t + 0.5) + (half - t) * bspline(degree - 1, t - 0.5)) / degree


@item("fig7", "The spline σ₁ of degree 5",
      "A piecewise polynomial of degree 5 on ]-3, 3[, with 1/60 in front; convolution with it smooths the samples.")
def fig7(lab):
    ts = [k / 100 for k in range(-330, 331)]
    doubled = max(abs(printed_spline(t) - 2 * bspline(5, t)) for t in ts)
    lab.check("greatest difference from twice the B-spline of degree 5", doubled, "<=", 1e-14, doubled)
    sum_of_shifts = sum(printed_spline(k) for k in range(-3, 4))
    lab.check("sum over the integers, to which the constant c has to be normalised",
              abs(sum(bspline(5, k) for k in range(-3, 4)) - 1), "<=", 1e-15, sum_of_shifts)
    box, n = [-1.13, 1.15, -1.15, 1.13, -1.14, 1.15], lab.choose(64, 24)
    formula = ["--function", "x^4 + y^4 + z^4 - 1", "--box", *box]
    points = [p for p in lab.mesh("quartic", *formula, "--resolution", 16, "--attributes", "none").points]
    exact = lab.evaluate(points, *formula, "--attributes", "mean_curvature")["mean_curvature"]
    worst = {}
    for who, variant in (("paper", PAPER), ("ours", OURS)):
        words = [*variant[:4], "--resolution", n, "--attributes", "mean_curvature"]
        sampled = lab.evaluate(points, *formula, *words)["mean_curvature"]
        worst[who] = max(abs(h - h0) for h, h0 in zip(sampled, exact))
    lab.check(f"greatest error of Hₑ on x⁴ + y⁴ + z⁴ = 1, N = {n}", worst["ours"], "<=", 1e-6, worst["paper"])
    lab.plot("spline", plot([Series("σ₁ as printed", [(t, printed_spline(t)) for t in ts]),
                             Series("B-spline of degree 5: σ₁ / 2", [(t, bspline(5, t)) for t in ts]),
                             Series("B-spline of degree 7, ours", [(t, bspline(7, t)) for t in ts], dashed=True)],
                            "t, in spacings of the grid", ""), "The spline of figure 7 and the one used here")
    lab.say("As printed, σ₁ is twice the B-spline of degree 5: its values at the integers sum to 2, which the "
            "constant c makes up for. Convolution with a B-spline adds half the second derivative times the square "
            "of the spacing: order 2. Here the samples pass a local filter first, which makes the order that of the "
            "degree.")


def constants_of_sphere(radius, matrix=None):
    scale = abs(determinant(matrix)) if matrix else 1.0
    return radius**-3 / scale, -(radius**-1.5) / math.sqrt(scale)


@item("fig8", "The pattern of the grid on the sphere",
      "Derivatives by convolution, interpolated along the edges of the grid, reveal a pattern of the grid in K and "
      "H, before and after [[0.9, 0, 0.9], [0, 2, 0], [1.1, 0, 0.6]].")
def fig8(lab):
    expression, box = "x^2 + y^2 + z^2 - 1", [-1.23, 1.25, -1.25, 1.23, -1.24, 1.25]
    n = lab.choose(64, 24)
    cases = {
        "before": (["--function", expression, "--box", *box], constants_of_sphere(1)),
        "after": (["--function", transformed(expression, MATRIX), "--box", *image_of_box(MATRIX, box)],
                  constants_of_sphere(1, MATRIX)),
    }
    for when, (words, (K, H)) in cases.items():
        worst = {}
        for who, variant in (("paper", PAPER), ("ours", OURS)):
            surface = lab.mesh(f"{who}-{when}", *words, "--resolution", n, *variant)
            worst[who] = {"K": max(abs(k / K - 1) for k in surface["affine_gaussian_curvature"]),
                          "H": max(abs(h / H - 1) for h in surface["affine_mean_curvature"])}
        for name, exact, column in (("K", K, "affine_gaussian_curvature"), ("H", H, "affine_mean_curvature")):
            half = 1.1 * worst["paper"][name] * abs(exact)
            for who, label in (("paper", "the paper's variant"), ("ours", "ours")):
                lab.picture(f"{who}-{when}-{name}", f"{name} {when} the map, {label}: deviates by up to "
                            f"{100 * worst[who][name]:.2g} %", "--color", column, "--range", exact - half, exact + half,
                            of=f"{who}-{when}")
        for name in ("K", "H"):
            lab.check(f"{when}: greatest relative deviation of {name}", worst["ours"][name], "<=", 1e-8,
                      worst["paper"][name])
    lab.say("The matrix has determinant -0.9: it is not equi-affine, and the exact values behind the colours take "
            "that into account, K = 1/0.9 and H = -1/√0.9 after it. A polynomial of degree 2 is in the space of the "
            "spline that we use; figure 10 has functions that are not.")


def sizes(lab):
    return lab.choose([40, 64, 96, 144, 256], [32, 64])


def relative_errors(surface, exact):
    """At regular vertices away from parabolic curves, relative to |K| + H² and its root."""
    K_errors, H_errors = [], []
    columns = (surface[c] for c in ("affine_gaussian_curvature", "affine_mean_curvature", "gaussian_curvature",
                                    "status"))
    for K, H, gaussian, status, (K0, H0) in zip(*columns, exact):
        if status != 0 or not abs(gaussian) > 0.2 or not math.isfinite(K0 + H0):
            continue
        scale = abs(K0) + H0 * H0
        K_errors.append(abs(K - K0) / scale)
        H_errors.append(abs(H - H0) / math.sqrt(scale))
    return median(K_errors), median(H_errors), max(K_errors)


@item("fig10", "Convergence on the sphere and beyond",
      "On the sphere the error of the direct method does not decrease with the grid; that of the transformation "
      "method goes from 0.6 % (N = 40) to 0.04 % (N = 256) for K and from 0.1 % to 0.0007 % for H, before and after "
      "the map.")
def fig10(lab):
    sphere, box = "x^2 + y^2 + z^2 - 1", [-1.23, 1.25, -1.25, 1.23, -1.24, 1.25]
    surfaces = {
        "sphere": (sphere, box, None),
        "sphere, after the map": (transformed(sphere, MATRIX), image_of_box(MATRIX, box), MATRIX),
        "exp ellipsoid": ("exp(x^2 + y^2/0.64 + z^2/1.44) - e", [-1.23, 1.25, -1.05, 1.03, -1.4, 1.43], None),
        "torus with a root": ("sqrt((sqrt(x^2+y^2) - 0.9)^2 + z^2) - 0.35", [-1.43, 1.4, -1.4, 1.43, -0.53, 0.5], None),
    }
    variants = {
        "paper, transformation": [*PAPER, "--estimator", "transformation"],
        "paper, direct": [*PAPER, "--estimator", "direct"],
        "ours": OURS,
    }
    errors = {}
    for name, (expression, where, _) in surfaces.items():
        for who, variant in variants.items():
            for n in sizes(lab):
                words = ["--function", expression, "--box", *where]
                surface = lab.mesh("surface", *words, "--resolution", n, *variant, *CURVATURES)
                if "sphere" in name:
                    exact = [constants_of_sphere(1, surfaces[name][2])] * len(surface)
                else:
                    at = lab.evaluate(surface.points, *words[:2], *CURVATURES)
                    exact = zip(at["affine_gaussian_curvature"], at["affine_mean_curvature"])
                errors[name, who, n] = relative_errors(surface, exact)
    ns = sizes(lab)

    def order(name, who):
        """Over the sizes whose error is not that of rounding, which fourth derivatives multiply by 1 / h⁴."""
        box = surfaces[name][1]
        shortest = min(high - low for low, high in zip(box[::2], box[1::2]))
        values = [(n, errors[name, who, n][0]) for n in ns]
        kept = [(n, e) for n, e in values if e > 10 * 2**-52 * ((n - 1) / shortest) ** 4]
        return -slope(*zip(*kept)) if len(kept) > 1 else math.nan

    rows = []
    for name in surfaces:
        for who in variants:
            values = [errors[name, who, n][0] for n in ns]
            rows.append([name, who, *values, f"{order(name, who):.2f}".replace("nan", "rounding alone")])
    lab.table(["median error of K", "", *(f"N = {n}" for n in ns), "order"], rows)
    for name in surfaces:
        lab.plot(name.replace(",", "").replace(" ", "-"),
                 plot([Series(f"K, {who}", [(n, errors[name, who, n][0]) for n in ns], kind="marked",
                              dashed=who == "paper, direct") for who in variants],
                      "nodes per axis", "median relative error", log_x=True, log_y=True), name)
    finest = ns[-1]
    for name in ("exp ellipsoid", "torus with a root"):
        lab.check(f"{name}: order of convergence of K", order(name, "ours"), ">=", 3.8, order(name,
                                                                                              "paper, transformation"))
    for name in ("sphere", "sphere, after the map"):
        lab.check(f"{name}, N = {finest}: median relative error of K", errors[name, "ours", finest][0], "<=", 4e-4,
                  errors[name, "paper, transformation", finest][0])
    difference = abs(errors["sphere", "paper, direct", finest][0] / errors["sphere", "paper, transformation",
                                                                           finest][0] - 1)
    lab.check("sphere: relative difference of direct and transformation method in double precision", difference, "<=",
              1e-3,
              difference)
    printed = lab.estimates("sphere", points=[(0.6, 0.0, 0.8)])
    lab.say("With the same derivatives direct and transformation method give the same numbers: what limits both is the "
            "estimate of the derivatives. With ξ₁ as printed the direct method does not converge, as the paper says: "
            "with "
            f"exact derivatives it gives K = {printed['printed_K'][0]:.3g} at (0.6, 0, 0.8), where K = 1. The "
            f"orders are slopes over "
            "the sizes whose error is above that of rounding, 10 ε / h⁴.")
