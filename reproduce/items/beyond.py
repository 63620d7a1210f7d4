# SPDX-License-Identifier: GPL-3.0-or-later
"""Open questions of the paper: the Pick invariant, the affine signature, parabolic curves."""

import math

from ..lab import item
from ..maps import SHEAR, image_of_points, words_of
from ..plot import Series, plot
from ..program import Surface, read_curve_points
from ..statistics import greatest, median, median_size, quantile
from ..surfaces import BLOBBY, BLOBBY_BOX, TORUS, TORUS_BOX


def gaussian_curvature_of_metric(metric, h):
    """Brioschi's formula at the center of a 7 x 7 grid of (E, F, G) with step h, by finite differences of order 6."""
    first = [-1 / 60, 3 / 20, -3 / 4, 0, 3 / 4, -3 / 20, 1 / 60]
    second = [1 / 90, -3 / 20, 3 / 2, -49 / 18, 3 / 2, -3 / 20, 1 / 90]
    unit = [0, 0, 0, 1, 0, 0, 0]

    def derivative(component, along_u, along_v, order):
        return sum(a * b * metric[i][j][component] for i, a in enumerate(along_u) for j, b in enumerate(along_v)
                   if a and b) / h**order

    E, F, G = metric[3][3]
    E_u, F_u, G_u = (derivative(c, first, unit, 1) for c in range(3))
    E_v, F_v, G_v = (derivative(c, unit, first, 1) for c in range(3))
    E_vv, F_uv, G_uu = derivative(0, unit, second, 2), derivative(1, first, first, 2), derivative(2, second, unit, 2)

    def det(a, b, c, d, e, f, g, h, i):
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)

    return (det(-E_vv / 2 + F_uv - G_uu / 2, E_u / 2, F_u - E_v / 2, F_v - G_u / 2, E, F, G_v / 2, F, G)
            - det(0, E_v / 2, G_u / 2, E_v / 2, E, F, G_u / 2, F, G)) / (E * G - F * F) ** 2


class Graph:
    """A graph z = g(x, y) that is not a quadric: elliptic for positive c, hyperbolic for negative c."""

    def __init__(self, c):
        self.c = c
        self.formula = f"z - (0.3*x^2 + {c}*y^2 + 0.2*x*y + 0.1*sin(2*x + y) + 0.15*x^2*y - 0.1*y^3 + 0.05*x^4)"

    def point(self, x, y):
        return x, y, (0.3 * x * x + self.c * y * y + 0.2 * x * y + 0.1 * math.sin(2 * x + y) + 0.15 * x * x * y
                      - 0.1 * y**3 + 0.05 * x**4)

    def first_form(self, x, y, metric):
        """E, F and G of a metric, given as xx, xy, xz, yy, yz, zz, for the tangent vectors (1, 0, g_x), (0, 1, g_y)."""
        p = 0.6 * x + 0.2 * y + 0.2 * math.cos(2 * x + y) + 0.3 * x * y + 0.2 * x**3
        q = 2 * self.c * y + 0.2 * x + 0.1 * math.cos(2 * x + y) + 0.15 * x * x - 0.3 * y * y
        xx, xy, xz, yy, yz, zz = metric
        return xx + 2 * p * xz + p * p * zz, xy + q * xz + p * yz + p * q * zz, yy + 2 * q * yz + q * q * zz

    def gauss_equation(self, lab, x0, y0):
        """H, J and the Gaussian curvature of the affine metric at a point."""
        h = 0.01
        places = [(x0 + i * h, y0 + j * h) for i in range(-3, 4) for j in range(-3, 4)]
        at = lab.evaluate([self.point(*place) for place in places], "--function", self.formula, "--attributes",
                          "metric,affine_mean_curvature,pick_invariant")
        metrics = zip(*(at["metric_" + component] for component in ("xx", "xy", "xz", "yy", "yz", "zz")))
        forms = [self.first_form(*place, metric) for place, metric in zip(places, metrics)]
        kappa = gaussian_curvature_of_metric([forms[7 * i : 7 * i + 7] for i in range(7)], h)
        return at["affine_mean_curvature"][24], at["pick_invariant"][24], kappa


@item("pick", "The Pick invariant",
      "“We plan to extend this work by completing the affine estimators with the Pick invariant.”")
def pick(lab):
    surface = lab.mesh("blobby", "--function", BLOBBY, "--box", *BLOBBY_BOX, "--resolution", lab.choose(72, 20))
    bound = quantile([abs(J) for J in surface["pick_invariant"]], 0.75)
    lab.mesh("pick", "--function", BLOBBY, "--box", *BLOBBY_BOX, "--resolution", lab.choose(72, 20),
             "--attributes", "normal,gaussian_curvature,pick_invariant", "--parabolic-curves", "curves.obj",
             "--png", "pick.png", "--color", "pick_invariant", "--range", -bound, bound, *lab.size)
    after = lab.evaluate_many("after", image_of_points(SHEAR, surface), "--function", BLOBBY, "--transform",
                              *words_of(SHEAR), "--attributes", "pick_invariant")
    scales = [math.sqrt(abs(K) + H * H + abs(k) ** 1.5) for K, H, k in zip(
        surface["affine_gaussian_curvature"], surface["affine_mean_curvature"], surface["gaussian_curvature"])]
    changes = [abs(a - b) / max(scale, abs(b)) for a, b, scale, is_regular in zip(
        after["pick_invariant"], surface["pick_invariant"], scales, surface.is_regular()) if is_regular]
    lab.check("relative change of J under a map of determinant 1, for 99 % of the vertices", quantile(changes, 0.99),
              "<=", 1e-10)

    rows = []
    for kind, c in (("elliptic", 0.4), ("hyperbolic", -0.5)):
        for x, y in ((0.1, 0.2), (-0.2, 0.1), (0.3, -0.1)):
            H, J, kappa = Graph(c).gauss_equation(lab, x, y)
            rows.append([f"{kind}, ({x}, {y})", H, J, H + J, kappa, abs(kappa - H - J) / (abs(H) + abs(J))])
    lab.check("maximum relative error of the Gauss equation κ = H + J, κ by finite differences of the metric",
              greatest(row[-1] for row in rows), "<=", 1e-6)
    lab.table(["point", "H", "J", "H + J", "κ, Gaussian curvature of the affine metric", "relative difference"], rows)
    lab.pictured("pick", "J on the surface of figure 3; parabolic curves are black")
    lab.say("κ does not use H and J: it is computed from the metric at 49 neighboring points by Brioschi's formula.")


@item("signature", "The affine signature",
      "“We plan to extend this work by completing the affine estimators with [...] eventually the affine signature.”")
def signature(lab):
    formula = "x^4 + 1.3*y^4 + 0.8*z^4 + x^2 + 0.7*y^2 + z^2 + 0.3*x*y*z - 1"  # convex: no parabolic curve
    words = ["--function", formula, "--attributes", "signature"]
    surface = lab.mesh("convex", *words, "--box", -1.03, 1.05, -1.05, 1.03, -1.04, 1.05,
                       "--resolution", lab.choose(56, 14))
    after = lab.evaluate_many("after", image_of_points(SHEAR, surface), *words, "--transform", *words_of(SHEAR))
    invariants = {"affine_gaussian_curvature": "K", "affine_mean_curvature": "H", "pick_invariant": "J"}
    symbols = {**invariants, **{f"{name}_gradient": f"|grad {symbol}|" for name, symbol in invariants.items()}}
    rows = []
    for name, symbol in symbols.items():
        unit = median_size(surface[name])
        errors = [abs(a - b) / max(abs(b), unit) for a, b in zip(after[name], surface[name])]
        lab.check(f"maximum relative change of {symbol}", greatest(errors), "<=",
                  1e-6 if name.endswith("_gradient") else 1e-10)
        rows.append([symbol, unit, greatest(errors), median(errors)])
    lab.table(["invariant", "median", "maximum change under a map of determinant 1", "median change"], rows)
    step = max(1, len(surface) // 2500)
    for x, y in (("affine_mean_curvature", "affine_mean_curvature_gradient"),
                 ("affine_mean_curvature", "pick_invariant")):
        lab.plot(f"signature-{y}", plot(
            [Series("the surface", list(zip(surface[x], surface[y]))[::step], kind="dots"),
             Series("its image", list(zip(after[x], after[y]))[step // 2 :: step], kind="dots")],
            symbols[x], symbols[y]),
            f"Two coordinates of the signature, H and {symbols[y]}, at different points of the surface and of its "
            f"image")
    lab.picture("convex", "|grad H| in the affine metric", "--color", "affine_mean_curvature_gradient")
    lab.say("K, H, J and the norms of their gradients in the Berwald-Blaschke metric, the attributes `signature`. The "
            "gradients are derivatives of order 5, computed as extrapolated finite differences of invariants.")


@item("parabolic", "Parabolic curves",
      "Where Kₑ = 0 the affine metric degenerates; a separate handling “could be extended to surfaces in future work”.")
def parabolic(lab):
    def mesh_with_curves(name, formula, box, n, color):
        words = ["--function", formula, "--box", *box, "--resolution", n]
        surface = lab.mesh(name, *words)
        bound = quantile([abs(x) for x in surface[color]], 0.75)
        lab.mesh(name, *words, "--parabolic-curves", name + ".obj", "--png", name + ".png", "--color", color,
                 "--range", -bound, bound, *lab.size)
        return surface, read_curve_points(lab.folder / (name + ".obj"))

    _, circles = mesh_with_curves("torus", TORUS, TORUS_BOX, lab.choose(64, 24), "gaussian_curvature")
    misses = [max(abs(math.hypot(x, y) - 0.5), abs(abs(z) - 0.2)) for x, y, z in circles]
    lab.check("torus: maximum distance of a point from the circles √(x²+y²) = R, z = ±r", greatest(misses), "<=",
              1e-12)
    metaballs = "exp(-3*((x-0.6)^2+y^2+z^2)) + exp(-3*((x+0.6)^2+(y-0.2)^2+z^2)) - 0.5"
    for name, formula, box in (("blobby", BLOBBY, BLOBBY_BOX),
                               ("metaballs", metaballs, [-1.4, 1.45, -1.1, 1.2, -1.0, 1.05])):
        surface, points = mesh_with_curves(name, formula, box, lab.choose(72, 24), "affine_mean_curvature")
        on_curve = Surface(dict(zip("xyz", zip(*points))))
        typical = median_size(surface["gaussian_curvature"])
        words = ["--function", formula, "--attributes", "gaussian_curvature"]
        at = lab.evaluate_many(name + "-curve", on_curve, *words)["gaussian_curvature"]
        lab.check(f"{name}: maximum |Kₑ| on the curves, relative to its median on the surface",
                  greatest(map(abs, at)) / typical, "<=", 1e-11)
        moved = lab.evaluate_many(name + "-image", image_of_points(SHEAR, on_curve), *words, "--transform",
                                  *words_of(SHEAR))["gaussian_curvature"]
        lab.check(f"{name}: the same for the images of the curves",
                  greatest(map(abs, moved)) / typical, "<=", 1e-10)
    lab.pictured("torus", "Kₑ on the torus and its parabolic circles")
    lab.pictured("blobby", "H on the surface of figure 3; it tends to infinity at the black curves")
    lab.pictured("metaballs", "H on two merging balls; the saddle between them is bounded by two curves")
    lab.say("The curves are polylines with points on f = 0 and Kₑ = 0 up to rounding, computed with the option "
            "--parabolic-curves.")
