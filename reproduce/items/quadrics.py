# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces of section 2(f), whose affine structure is known: figures 2 and 4, the table, and a criterion for
quadrics."""

import math
import random

from ..lab import item
from ..statistics import greatest, median

def length(v):
    return math.hypot(*v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


@item("fig2", "Co-normals and affine normals of an ellipsoid",
      "The co-normal is co-linear with the Euclidean normal, while the affine normal points towards the center.")
def fig2(lab):
    center = (0.3, -0.2, 0.1)
    words = ["--function", "(x-0.3)^2/2.25 + (y+0.2)^2 + (z-0.1)^2/0.25 = 1", "--box", -1.6, 2.2, -1.5, 1.1, -0.6, 0.8,
             "--resolution", lab.choose(64, 16)]

    def worst(surface):
        misses = [length(cross(xi, minus(p, center))) / length(xi)
                  for xi, p in zip(surface.vectors("affine_normal"), surface.points)]
        angles = [length(cross(nu, n)) / length(nu) for nu, n in zip(surface.vectors("conormal"), surface.vectors("n"))]
        return greatest(misses), greatest(angles)

    ours = worst(lab.mesh("ellipsoid", *words))
    paper = worst(lab.mesh("transformation", *words, "--estimator", "transformation"))
    lab.check("maximum distance between the center and the line of an affine normal", ours[0], "<=", 1e-12, paper[0])
    lab.check("maximum sine of the angle between co-normal and Euclidean normal", ours[1], "<=", 1e-12, paper[1])
    lab.picture("conormals", "Co-normals", "--color", "plain", "--arrows", "conormal", of="ellipsoid")
    lab.picture("normals", "Affine normals: the arrows lie on lines through the center", "--color", "plain",
                "--arrows", "affine_normal", of="ellipsoid")


@item("fig4", "The paraboloids",
      "Elliptic and hyperbolic paraboloids have a constant affine normal; they play the role of the plane.")
def fig4(lab):
    for name, expression in [("elliptic", "z - (x^2 + y^2)/2"), ("hyperbolic", "z - (x^2 - y^2)/2")]:
        words = ["--function", expression, "--box", -1, 1, -1, 1, -1, 1, "--resolution", lab.choose(48, 12)]

        def worst(surface):
            deviation = greatest(length(minus(xi, (0, 0, 1))) for xi in surface.vectors("affine_normal"))
            columns = [surface["affine_gaussian_curvature"], surface["affine_mean_curvature"]]
            return deviation, greatest(abs(x) for column in columns for x in column)

        paper = worst(lab.mesh(name + "-transformation", *words, "--estimator", "transformation"))
        ours = worst(lab.mesh(name, *words))
        lab.check(f"{name}: maximum deviation of ξ from (0, 0, 1)", ours[0], "<=", 1e-14, paper[0])
        lab.check(f"{name}: maximum |K| and |H|", ours[1], "<=", 1e-14, paper[1])
        lab.picture(name, f"The {name} paraboloid with its affine normals", "--color", "plain",
                    "--arrows", "affine_normal")


def unit_sphere_points(count, seed):
    source = random.Random(seed)
    points = [tuple(source.gauss(0, 1) for _ in range(3)) for _ in range(count)]
    return [tuple(x / length(p) for x in p) for p in points]


@item("table2f", "The fundamental examples of section 2(f)",
      "A table of the co-normal, the affine normal and the affine curvatures of the paraboloids and of the sphere, "
      "with H = -2 r^(-3/2) for the sphere.")
def table2f(lab):
    r, source = 1.7, random.Random(1)
    plane = [(source.uniform(-1, 1), source.uniform(-1, 1)) for _ in range(200)]
    sphere = [tuple(r * x for x in p) for p in unit_sphere_points(200, 2) if abs(p[2]) > 0.1]

    def paraboloid(sign):
        points = [(x, y, (x * x + sign * y * y) / 2) for x, y in plane]
        return points, {
            "N_e": [tuple(c / math.sqrt(1 + x * x + y * y) for c in (-x, -sign * y, 1)) for x, y, _ in points],
            "K_e": [sign / (1 + x * x + y * y) ** 2 for x, y, _ in points],
            "d": [sign for _ in points],
            "nu": [(-x, -sign * y, 1) for x, y, _ in points],
            "xi": [(0, 0, 1) for _ in points],
            "K": [0 for _ in points],
            "H": [0 for _ in points],
        }

    surfaces = {
        "z - (x^2 + y^2)/2": paraboloid(1),
        "z - (x^2 - y^2)/2": paraboloid(-1),
        f"x^2 + y^2 + z^2 - {r}^2": (sphere, {
            "N_e": [tuple(c / r for c in p) for p in sphere],
            "K_e": [r**-2 for _ in sphere],
            "d": [r * r / p[2] ** 4 for p in sphere],
            "nu": [tuple(c / math.sqrt(r) for c in p) for p in sphere],
            "xi": [tuple(c / r**1.5 for c in p) for p in sphere],
            "K": [r**-3 for _ in sphere],
            "H": [-(r**-1.5) for _ in sphere],
        }),
    }
    rows, worst = [], 0.0
    for expression, (points, expected) in surfaces.items():
        at = lab.evaluate(points, "--function", expression)
        vectors = lambda stem: list(zip(*(at[stem + axis] for axis in "xyz")))
        computed = {
            "N_e": vectors("n"), "K_e": at["gaussian_curvature"],
            "d": [k / n**4 for k, n in zip(at["gaussian_curvature"], at["nz"])],
            "nu": vectors("conormal_"), "xi": vectors("affine_normal_"),
            "K": at["affine_gaussian_curvature"], "H": at["affine_mean_curvature"],
        }  # fmt: skip
        errors = []
        for name, values in expected.items():
            pairs = [(a, b) if isinstance(b, tuple) else ((a,), (b,)) for a, b in zip(computed[name], values)]
            errors.append(greatest(length(minus(a, b)) / max(1.0, length(b)) for a, b in pairs))
        worst = max(worst, *errors)
        rows.append([expression, *errors])
    lab.check("maximum error of all cells, with H of the sphere corrected", worst, "<=", 1e-12)
    printed = min(abs(h + 2 * r**-1.5) for h in at["affine_mean_curvature"]) / r**-1.5
    lab.check("error of the printed H of the sphere, -2 r^(-3/2), relative to r^(-3/2)", printed, ">=", 0.99)
    lab.table(["surface", "Nₑ", "Kₑ", "d", "ν", "ξ", "K", "H"], rows)
    lab.say("The table shows the errors of all cells at random points. With H = tr B / 2 as defined in section 2(e), "
            "the sphere has H = -r^(-3/2); the printed -2 r^(-3/2) is the trace.")


# Functions that are not polynomials, so that the third derivatives of f do not vanish on quadrics.
QUADRICS = {
    "ellipsoid": "exp(x^2/4 + y^2 + z^2/0.3) - e",
    "elliptic paraboloid": "sinh(z - x^2 - y^2/3)",
    "hyperbolic paraboloid": "atan(z - x*y)",
    "hyperboloid of one sheet": "sqrt(x^2 + y^2/2) - sqrt(1 + z^2)",
    "hyperboloid of two sheets": "z - sqrt(1 + x^2 + y^2/2)",
    "sheared hyperboloid": "log(2 + x^2 + x*y + 2*y^2 + y*z) - log(3 + z^2)",
}
OTHERS = {
    "Cayley's ruled cubic": "z - x*y + x^3/3",
    "helicoid": "y*cos(z) - x*sin(z)",
    "torus": "(sqrt(x^2+y^2) - 0.9)^2 + z^2 - 0.16",
    "affine sphere x y z = 1": "x*y*z - 1",
}


@item("quadric", "Quadrics, recognized by the apolar cubic form",
      "“We plan to extend this work by completing the affine estimators with the Pick invariant.” J = 0 holds on "
      "every quadric, but also on other surfaces.")
def quadric(lab):
    rows, defects = [], {}
    for name, expression in {**QUADRICS, **OTHERS}.items():
        surface = lab.mesh(name.replace(" ", "-").replace("'", ""), "--function", expression, "--box", -1.9, 2, -2,
                           1.9, -2, 2, "--resolution", lab.choose(40, 14),
                           "--attributes", "quadric_defect,pick_invariant")
        regular = [i for i, is_regular in enumerate(surface.is_regular()) if is_regular]
        defect = [surface["quadric_defect"][i] for i in regular]
        pick = greatest(abs(surface["pick_invariant"][i]) for i in regular)
        defects[name] = greatest(defect), median(defect)
        rows.append([name, "yes" if name in QUADRICS else "no", *defects[name], pick])
    lab.check("maximum defect of six quadrics", max(defects[n][0] for n in QUADRICS), "<=", 1e-12)
    lab.check("minimum of the median defects of four other surfaces", min(defects[n][1] for n in OTHERS), ">=", 1e-2)
    cayley = next(row[4] for row in rows if row[0] == "Cayley's ruled cubic")
    lab.check("maximum |J| of Cayley's surface: J = 0 does not imply a quadric", cayley, "<=", 1e-12)
    lab.table(["surface", "quadric?", "maximum defect", "median defect", "maximum |J|"], rows)
    lab.say("The values are those at regular vertices. The attribute quadric_defect is |T| / |II|², the dimensionless "
            "ratio of the apolar cubic form to the square of the second fundamental form. By the theorem of Maschke, "
            "Pick and Berwald, T vanishes exactly on quadrics.")
    lab.picture("Cayleys-ruled-cubic", "Cayley's surface z = x y - x³/3 has J = 0 everywhere, but is not a quadric",
                "--color", "quadric_defect")
    lab.picture("torus", "The torus: its defect is largest near the parabolic circles", "--color", "quadric_defect")
