# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors found in the printed paper: tests show that each printed formula fails and that its correction holds."""

import math
import random

from ..lab import item
from ..maps import determinant, words_of
from ..statistics import greatest
from .sampling import MATRIX, printed_spline


def monomials(degrees, letters):
    """Words of these lengths with letters in alphabetic order: xx, xy, ..."""
    words = [""]
    result = []
    for degree in range(1, max(degrees) + 1):
        words = [w + c for w in words for c in letters if not w or w[-1] <= c]
        if degree in degrees:
            result += words
    return result


def polynomial(derivatives):
    """The polynomial in x, y, z with these derivatives at the origin, as a formula."""
    terms = []
    for word, value in derivatives.items():
        factorials = math.prod(math.factorial(word.count(c)) for c in "xyz")
        terms.append(f"({value / factorials!r})*" + "*".join(word))
    return " + ".join(terms)


def at_origin(lab, formula):
    at = {name: column[0] for name, column in lab.evaluate([(0.0, 0.0, 0.0)], "--function", formula).items()}
    return {"xi": [at["affine_normal_" + c] for c in "xyz"], "K": at["affine_gaussian_curvature"],
            "H": at["affine_mean_curvature"]}


def graph_normal(g, second_term):
    """ξ₁ of section 2(d), with the derivative `second_term` in its second term."""
    d = g["xx"] * g["yy"] - g["xy"] ** 2
    return abs(d) ** 0.25 / (4 * d * d) * (
        g["xx"] * g["xy"] * g["yyy"] - g["xx"] * g["yy"] * g[second_term] - g["yy"] ** 2 * g["xxx"]
        - 2 * g["xy"] ** 2 * g["xyy"] + 3 * g["yy"] * g["xy"] * g["xxy"])


def reduced_normal(f, is_printed):
    """ξ₂ of section 3(b)."""
    first = f["xyy"] * f["xxx"] * f["yy"] if is_printed else f["yy"] * f["xx"] * f["xxy"]
    return (first - 4 * f["xx"] ** 2 * f["yy"] * f["yz"] + f["xx"] ** 2 * f["yyy"]) / (
        4 * abs(f["xx"] * f["yy"]) ** 1.75)


def b11_printed(f):
    xx, yy = f["xx"], f["yy"]
    return (8 * xx**2 * yy**2 * f["xz"] ** 2 - 8 * xx**3 * yy**2 * f["zz"] + 8 * xx**3 * yy * f["yz"] ** 2
            - 4 * xx**2 * yy * f["xxyy"] - 4 * xx * yy**2 * f["xxxx"] + 7 * yy**2 * f["xxx"] ** 2
            + 3 * xx**2 * f["xyy"] ** 2 + 12 * xx * yy * f["xxy"] ** 2 + 2 * xx * yy * f["xxx"] * f["xyy"]
            + 4 * xx**2 * f["xxy"] * f["yyy"] + 24 * xx**2 * yy**2 * f["xxz"] - 24 * xx * yy**2 * f["xz"] * f["xxx"]
            - 24 * xx**2 * yy * f["yz"] * f["xxy"]) / (16 * xx**2.75 * yy**1.75)  # fmt: skip


def b11(f):
    xx, yy, d = f["xx"], f["yy"], f["xx"] * f["yy"]
    return xx * yy**2 / (16 * d**3.75) * (
        -16 * xx**3 * yy**2 * f["zz"] + 4 * xx**3 * yy * f["yyz"] + 16 * xx**3 * yy * f["yz"] ** 2
        - 4 * xx**3 * f["yyy"] * f["yz"] - 28 * xx**2 * f["xxy"] * yy * f["yz"] + 4 * xx**2 * f["xxy"] * f["yyy"]
        - 4 * xx**2 * f["xxyy"] * yy + 28 * xx**2 * f["xxz"] * yy**2 + 3 * xx**2 * f["xyy"] ** 2
        - 4 * xx**2 * f["xyy"] * f["xz"] * yy + 16 * xx**2 * f["xz"] ** 2 * yy**2
        + 2 * xx * f["xxx"] * f["xyy"] * yy - 28 * xx * f["xxx"] * f["xz"] * yy**2 - 4 * xx * f["xxxx"] * yy**2
        + 12 * xx * f["xxy"] ** 2 * yy + 7 * f["xxx"] ** 2 * yy**2)  # fmt: skip


def b21(f, fourth="xyy", fifth="xxxy"):
    """b₂₁ of section 3(b), with the derivatives `fourth` in its fourth term and `fifth` in its fifth term."""
    xx, yy = f["xx"], f["yy"]
    return (15 * xx * yy * f["xxy"] * f["xyy"] - xx * yy * f["xxx"] * f["yyy"] - 4 * xx**2 * yy * f["xyyy"]
            - 24 * xx**2 * yy * f["yz"] * f[fourth] - 4 * xx * yy**2 * f[fifth] + 24 * xx**2 * yy**2 * f["xyz"]
            - 24 * xx * yy**2 * f["xz"] * f["xxy"] + 7 * yy**2 * f["xxx"] * f["xxy"]
            + 7 * xx**2 * f["xyy"] * f["yyy"]) / (16 * xx**2.75 * yy**1.75)  # fmt: skip


def exchanged(f):
    """The derivatives with x and y exchanged."""
    exchange = str.maketrans("xy", "yx")
    return {word: f["".join(sorted(word.translate(exchange)))] for word in f}


def curvatures(f, b11_of, b21_of):
    """K and H from b11 and b21, and from b22 and b12, which follow by exchanging x and y."""
    g = exchanged(f)
    return b11_of(f) * b11_of(g) - b21_of(f) * b21_of(g), (b11_of(f) + b11_of(g)) / 2


@item("errata", "The errors of the printed paper",
      "The formulas of sections 2, 3 and 4, the table of section 2(f), figures 8 and 11, as printed.")
def errata(lab):
    errors = {}  # for each place: errors of the printed formula, and errors of the corrected one

    def compare(where, printed, corrected, right):
        """Adds errors relative to the correct value, or to 1 if this is larger."""
        for value, found in zip((printed, corrected), errors.setdefault(where, ([], []))):
            found.append(abs(value - right) / max(1.0, abs(right)))

    for seed in range(lab.choose(5, 2)):
        source = random.Random(seed)
        g = {word: source.uniform(-1, 1) for word in monomials((1, 2, 3, 4), "xy")}
        ours = at_origin(lab, f"z - ({polynomial(g)})")
        compare("2(d), ξ₁: second term with g_xxy instead of g_xyy", graph_normal(g, "xxy"), graph_normal(g, "xyy"),
                ours["xi"][0])

        f = {word: source.uniform(-1, 1) for word in monomials((2, 3, 4), "xyz")}
        f.update(xy=0.0, xx=source.uniform(0.5, 1), yy=source.uniform(0.5, 1))
        ours = at_origin(lab, f"z + {polynomial(f)}")
        compare("3(b), ξ₂: f_xyy f_xxx f_yy instead of f_yy f_xx f_xxy", reduced_normal(f, True),
                reduced_normal(f, False), ours["xi"][1])
        right = curvatures(f, b11, b21)
        for i, name in enumerate("KH"):
            compare(f"3(b), b₁₁: {name} from the printed formula", curvatures(f, b11_printed, b21)[i], right[i],
                    ours[name])
        for where, wrong in (("fourth term with f_xxy instead of f_xyy", lambda h: b21(h, fourth="xxy")),
                             ("fifth term with f_xxx instead of f_xxxy", lambda h: b21(h, fifth="xxx"))):
            compare(f"3(b), b₂₁: {where}", curvatures(f, b11, wrong)[0], right[0], ours["K"])

    r = 1.7
    sphere = {word: 0.0 for word in monomials((2, 3, 4), "xyz")}
    sphere.update(xx=1 / r, yy=1 / r, zz=1 / r)
    H = lab.evaluate([(r, 0.0, 0.0)], "--function", "x^2 + y^2 + z^2")["affine_mean_curvature"][0] * r**1.5
    compare("3(b), b₁₁ of a sphere", b11_printed(sphere) * r**1.5, b11(sphere) * r**1.5, H)
    compare("2(f), H of the sphere: -2 r^(-3/2) instead of -r^(-3/2)", -2.0, -1.0, H)
    image = lab.evaluate([(0.9, 0.0, 1.1)], "--function", "x^2 + y^2 + z^2", "--transform", *words_of(MATRIX))
    compare("figure 8: K invariant under a matrix of determinant -0.9", 1.0, 1 / abs(determinant(MATRIX)),
            image["affine_gaussian_curvature"][0])
    ts = [-0.5, -1.5, -2.5]
    for t, basis in zip(ts, lab.estimates("splines", numbers=ts)["degree_5"]):
        compare("4(a), σ₁: t instead of |t|, for t < 0", printed_spline(t, is_literal=True), printed_spline(t),
                2 * basis)

    circle = [2 * math.pi * (k + 0.5) / 49 for k in range(49)]  # none of them has Kₑ = 0 on a torus
    flat = {}
    for formula, points in (
        ("z^2 - (sqrt(x^2+y^2) - 0.5)^2", [(0.8 * math.cos(t), 0.8 * math.sin(t), 0.3) for t in circle]),
        ("z^2 + (sqrt(x^2+y^2) - 0.5)^2", [(0.5 + 0.2 * math.cos(t), 0.0, 0.2 * math.sin(t)) for t in circle])):
        at = lab.evaluate(points, "--function", formula, "--attributes", "gaussian_curvature")["gaussian_curvature"]
        flat[formula] = sum(not abs(k) > 1e-12 for k in at) / len(at)
    compare("figure 11: fraction of points with Kₑ = 0, as on two cones", *flat.values(), 0.0)

    rows = [[where, min(printed), greatest(corrected)] for where, (printed, corrected) in errors.items()]
    lab.check("minimum error of the printed formulas", min(row[1] for row in rows), ">=", 1e-4)
    lab.check("maximum error of the corrected formulas", greatest(row[2] for row in rows), "<=", 1e-12)
    lab.table(["place", "printed: minimum error", "corrected: maximum error"], rows)
    lab.say("The formulas are evaluated for functions with random derivatives, and compared with the program, which "
            "uses different formulas. doc/errata.md lists the corrections.")
