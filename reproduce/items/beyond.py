# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper leaves open: the Pick invariant, the affine signature, parabolic curves."""

import math

from ..lab import item
from ..plot import Series, plot
from ..program import determinant, image, words_of
from ..statistics import quantile

SHEAR = [[1.0, 2.0, 0.3], [0.0, 0.8, -0.5], [0.2, 0.4, 1.36]]


def unimodular(matrix):
    """The matrix divided by the cube root of its determinant."""
    root = math.copysign(abs(determinant(matrix)) ** (1 / 3), determinant(matrix))
    return [[x / root for x in row] for row in matrix]


BLOBBY = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6"
BOX = [-0.93, 0.95, -0.95, 0.93, -0.94, 0.95]


def gaussian_curvature_of_metric(metric, h):
    """Brioschi's formula at the middle of a 7 x 7 table of (E, F, G) with steps h, by differences of order 6."""
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


@item("pick", "The Pick invariant",
      "“We plan to extend this work by completing the affine estimators with the Pick invariant.”")
def pick(lab):
    matrix = unimodular(SHEAR)
    surface = lab.mesh("blobby", "--function", BLOBBY, "--box", *BOX, "--resolution", lab.choose(72, 20),
                       "--parabolic-curves", "blobby.obj", "--png", "blobby.png", "--color", "pick_invariant",
                       "--size", *lab.picture_size)
    after = lab.evaluate([image(matrix, p) for p in surface.points], "--function", BLOBBY,
                         "--transform", *words_of(matrix))
    scales = [abs(K) + H * H + abs(k) ** 1.5 for K, H, k in zip(
        surface["affine_gaussian_curvature"], surface["affine_mean_curvature"], surface["gaussian_curvature"])]
    changes = [abs(a - b) / max(math.sqrt(scale), abs(b)) for a, b, scale, status in zip(
        after["pick_invariant"], surface["pick_invariant"], scales, surface["status"])
        if status == 0 and math.isfinite(a + b)]
    lab.check("99 % of the vertices: relative change of J under a map of determinant 1", quantile(changes, 0.99),
              "<=", 1e-10)

    formula = "z - (0.3*x^2 + {}*y^2 + 0.2*x*y + 0.1*sin(2*x + y) + 0.15*x^2*y - 0.1*y^3 + 0.05*x^4)"
    g = lambda c, x, y: (0.3 * x * x + c * y * y + 0.2 * x * y + 0.1 * math.sin(2 * x + y) + 0.15 * x * x * y
                         - 0.1 * y**3 + 0.05 * x**4)
    slopes = lambda c, x, y: (0.6 * x + 0.2 * y + 0.2 * math.cos(2 * x + y) + 0.3 * x * y + 0.2 * x**3,
                              2 * c * y + 0.2 * x + 0.1 * math.cos(2 * x + y) + 0.15 * x * x - 0.3 * y * y)
    rows, h = [], 0.01
    for kind, c in (("elliptic", 0.4), ("hyperbolic", -0.5)):
        for x0, y0 in ((0.1, 0.2), (-0.2, 0.1), (0.3, -0.1)):
            places = [(x0 + i * h, y0 + j * h) for i in range(-3, 4) for j in range(-3, 4)]
            at = lab.evaluate([(x, y, g(c, x, y)) for x, y in places], "--function", formula.format(c), "--attributes",
                              "metric,affine_mean_curvature,pick_invariant")
            forms = []
            for k, (x, y) in enumerate(places):
                m = [at["metric_" + n][k] for n in ("xx", "xy", "xz", "yy", "yz", "zz")]
                p, q = slopes(c, x, y)
                form = lambda u, v: (m[0] * u[0] * v[0] + m[3] * u[1] * v[1] + m[5] * u[2] * v[2]
                                     + m[1] * (u[0] * v[1] + u[1] * v[0]) + m[2] * (u[0] * v[2] + u[2] * v[0])
                                     + m[4] * (u[1] * v[2] + u[2] * v[1]))
                e, f = (1, 0, p), (0, 1, q)
                forms.append((form(e, e), form(e, f), form(f, f)))
            metric = [forms[7 * i : 7 * i + 7] for i in range(7)]
            kappa = gaussian_curvature_of_metric(metric, h)
            H, J = at["affine_mean_curvature"][24], at["pick_invariant"][24]
            rows.append([f"{kind}, ({x0}, {y0})", H, J, H + J, kappa, abs(kappa - H - J) / (abs(H) + abs(J))])
    lab.check("Gauss equation κ = H + J: greatest relative error, κ by differences of the metric",
              max(row[-1] for row in rows), "<=", 1e-6)
    lab.table(["point", "H", "J", "H + J", "κ, Gaussian curvature of the affine metric", "relative difference"], rows)
    lab.pictured("blobby", "J on the surface of figure 3")
    lab.say("κ knows nothing of H and J: it is made from the metric at 49 neighbouring points by Brioschi's formula.")


@item("signature", "The affine signature",
      "“We plan to extend this work by completing the affine estimators with [...] eventually the affine signature.”")
def signature(lab):
    matrix = unimodular(SHEAR)
    formula = "x^4 + 1.3*y^4 + 0.8*z^4 + x^2 + 0.7*y^2 + z^2 + 0.3*x*y*z - 1"  # convex: no parabolic curve
    words = ["--function", formula, "--attributes", "signature,gaussian_curvature"]
    surface = lab.mesh("convex", *words, "--box", -1.03, 1.05, -1.05, 1.03, -1.04, 1.05,
                       "--resolution", lab.choose(56, 14))
    after = lab.evaluate([image(matrix, p) for p in surface.points], *words, "--transform", *words_of(matrix))
    names = ["affine_gaussian_curvature", "affine_mean_curvature", "pick_invariant"]
    rows = []
    for name in [*names, *(n + "_gradient" for n in names)]:
        unit = quantile([abs(x) for x in surface[name]], 0.5)
        errors = [abs(a - b) / max(abs(b), unit) for a, b in zip(after[name], surface[name])]
        is_gradient = name.endswith("_gradient")
        lab.check(f"greatest change of {name}, relative", max(errors), "<=", 1e-6 if is_gradient else 1e-10)
        rows.append([name, unit, max(errors), quantile(errors, 0.5)])
    lab.table(["invariant", "median", "greatest change under a map of determinant 1", "median change"], rows)
    step = max(1, len(surface) // 2500)
    for x, y, label in (("affine_mean_curvature", "affine_mean_curvature_gradient", "|grad H|"),
                        ("affine_mean_curvature", "pick_invariant", "J")):
        lab.plot(f"signature-{y}", plot(
            [Series("the surface", list(zip(surface[x], surface[y]))[::step], kind="dots"),
             Series("its image", list(zip(after[x], after[y]))[step // 2 :: step], kind="dots")], "H", label),
            f"Two coordinates of the signature, H and {label}, at other points of the surface and of its image")
    lab.picture("convex", "|grad H| in the affine metric", "--color", "affine_mean_curvature_gradient")
    lab.say("K, H, J and the norms of their gradients in the Berwald-Blaschke metric, the attributes `signature`. The "
            "gradients are derivatives of order 5: extrapolated differences of invariants of neighbouring level sets.")


@item("parabolic", "Parabolic curves",
      "Where Kₑ = 0 the affine metric degenerates; a separate handling “could be extended to surfaces in future work”.")
def parabolic(lab):
    def curve_points(name):
        with open(lab.folder / (name + ".obj"), encoding="ascii") as file:
            return [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]

    size = ["--size", *lab.picture_size]
    lab.mesh("torus", "--function", "(sqrt(x^2+y^2) - 0.5)^2 + z^2 - 0.2^2", "--box", -0.77, 0.75, -0.75, 0.77, -0.26,
             0.25,
             "--resolution", lab.choose(64, 24), "--parabolic-curves", "torus.obj", "--png", "torus.png",
             "--color", "gaussian_curvature", *size)
    circles = curve_points("torus")
    misses = [max(abs(math.hypot(x, y) - 0.5), abs(abs(z) - 0.2)) for x, y, z in circles]
    lab.check("torus: greatest distance of a point from the circles √(x²+y²) = R, z = ±r", max(misses), "<=", 1e-12)

    matrix = unimodular(SHEAR)
    surfaces = {"blobby": (BLOBBY, BOX),
                "metaballs": ("exp(-3*((x-0.6)^2+y^2+z^2)) + exp(-3*((x+0.6)^2+(y-0.2)^2+z^2)) - 0.5",
                              [-1.4, 1.45, -1.1, 1.2, -1.0, 1.05])}  # fmt: skip
    for name, (formula, box) in surfaces.items():
        surface = lab.mesh(name, "--function", formula, "--box", *box, "--resolution", lab.choose(72, 24),
                           "--parabolic-curves", name + ".obj", "--png", name + ".png",
                           "--color", "affine_mean_curvature", *size)
        points = curve_points(name)
        typical = quantile([abs(k) for k in surface["gaussian_curvature"]], 0.5)
        on_curve = lab.evaluate(points, "--function", formula, "--attributes", "gaussian_curvature")
        residual = max(abs(k) for k in on_curve["gaussian_curvature"]) / typical
        lab.check(f"{name}: greatest |Kₑ| on the curves, over its median on the surface", residual, "<=", 1e-11)
        moved = lab.evaluate([image(matrix, p) for p in points], "--function", formula, "--transform",
                             *words_of(matrix),
                             "--attributes", "gaussian_curvature")
        after = max(abs(k) for k in moved["gaussian_curvature"]) / typical
        lab.check(f"{name}: the same for their images on the image of the surface", after, "<=", 1e-10)
    lab.pictured("torus", "Kₑ on the torus and its parabolic circles")
    lab.pictured("blobby", "H on the surface of figure 3: it grows without bound towards the black curves")
    lab.pictured("metaballs", "H on two balls that melt: the saddle between them is bounded by two curves")
    lab.say("The curves are polylines whose points lie on f = 0 and Kₑ = 0 up to rounding, the option "
            "--parabolic-curves.")
