# SPDX-License-Identifier: GPL-3.0-or-later
"""The program `equiaffine` and the surfaces it writes."""

import array
import csv
import io
import math
import re
import shlex
import struct
import subprocess

from .statistics import Distribution, median

PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
             "double": "d"}


class Surface:
    """A triangle mesh with numbers at its vertices: `surface["affine_mean_curvature"]` is a list of floats."""

    def __init__(self, columns, triangles):
        self.columns, self.triangles = columns, triangles

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.columns["x"])

    def vectors(self, name):
        """The vectors `name`_x, _y, _z, the normals for "n", the points for ""."""
        stem = name + "_" if len(name) > 1 else name
        return list(zip(*(self.columns[stem + axis] for axis in "xyz")))

    @property
    def points(self):
        return self.vectors("")

    def is_regular(self):
        return [status == 0 for status in self["status"]]

    def triangle_areas(self):
        points, areas = self.points, []
        for a, b, c in self.triangles:
            u = [q - p for p, q in zip(points[a], points[b])]
            v = [q - p for p, q in zip(points[a], points[c])]
            areas.append(math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                    u[0] * v[1] - u[1] * v[0]) / 2)
        return areas

    def distribution(self, column, factor=1.0, is_used=None):
        """Of the numbers of a column times a factor, weighted by the affine area |K_e|^(1/4) dA. Triangles with a
        vertex that is not regular, or not used, do not count.

        Numbers x are interpolated, as x / (m + |x|) which is bounded, at points in the triangles: at the vertices alone
        they heap up, for the layers of a grid that is parallel to a symmetry of the surface have equal ones. Triangles
        that a parabolic curve crosses have infinite numbers inside and count with their corners.
        """
        is_used = is_used or self.is_regular()
        gaussian = self["gaussian_curvature"]
        numbers = [factor * x for x in self[column]]
        unit = median([abs(x) for x in numbers]) or 1.0
        bounded = [x / (unit + abs(x)) for x in numbers]
        densities = [abs(k) ** 0.25 for k in gaussian]
        inside = centers_of_parts(3 if len(self.triangles) < 60_000 else 2)
        values, weights = [], []
        for (a, b, c), area in zip(self.triangles, self.triangle_areas()):
            if not (is_used[a] and is_used[b] and is_used[c]):
                continue
            is_one_sided = (gaussian[a] < 0) == (gaussian[b] < 0) == (gaussian[c] < 0)
            places = inside if is_one_sided else CORNERS
            x, y, z = bounded[a], bounded[b], bounded[c]
            p, q, r = (area / len(places) * densities[v] for v in (a, b, c))
            for u, v, w in places:
                place = u * x + v * y + w * z
                values.append(unit * place / max(1 - abs(place), 2**-53))
                weights.append(u * p + v * q + w * r)
        return Distribution(values, weights)


CORNERS = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]


def centers_of_parts(n):
    """Weights of the centers of the n² equal parts of a triangle."""
    third = 1 / 3
    upright = [(i + third, j + third) for i in range(n) for j in range(n - i)]
    inverted_ones = [(i + 2 * third, j + 2 * third) for i in range(n - 1) for j in range(n - 1 - i)]
    return [(u / n, v / n, 1 - (u + v) / n) for u, v in upright + inverted_ones]


def read_ply(path):
    """A mesh as `equiaffine` writes it: binary, little-endian, triangles."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    counts, names, types, face_type = {}, [], "<", None
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] == "list":
            face_type = "<" + PLY_TYPES[words[2]] + 3 * PLY_TYPES[words[3]]
        elif words[0] == "property":
            types += PLY_TYPES[words[1]]
            names.append(words[2])
    faces = end + counts["vertex"] * struct.calcsize(types)
    rows = struct.iter_unpack(types, data[end:faces])
    columns = dict(zip(names, map(list, zip(*rows))))
    return Surface(columns, [row[1:] for row in struct.iter_unpack(face_type, data[faces:])])


def write_ply(path, surface, columns):
    """The mesh with the given columns alone, for `equiaffine view`."""
    names = ["x", "y", "z", *columns]
    numbers = array.array("d", (x for row in zip(*(surface[n] for n in "xyz"), *columns.values()) for x in row))
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(surface)}"]
    lines += [f"property double {name}" for name in names]
    lines += [f"element face {len(surface.triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(lines).encode())
        file.write(numbers.tobytes())
        file.write(b"".join(struct.pack("<Biii", 3, *triangle) for triangle in surface.triangles))


def read_csv(text):
    """Columns of numbers by their names; the status stays text."""
    header, *rows = csv.reader(io.StringIO(text))
    columns = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    return {n: column if n == "status" else [float(x) for x in column] for n, column in columns.items()}


def points_csv(points):
    return "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points)


def transformed(expression, matrix):
    """The expression f(A^-1 p): the surface f = 0 after the linear map A. `x`, `y`, `z` are replaced as words."""
    inverse = inverted(matrix)
    rows = dict(zip("xyz", ("(" + " + ".join(f"({c!r})*{v}" for c, v in zip(row, "xyz")) + ")" for row in inverse)))
    return re.sub(r"\b[xyz]\b", lambda match: rows[match.group()], expression)


def determinant(m):
    return sum(
        m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3)
    )


def inverted(m):
    cofactor = lambda i, j: (
        m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
        - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3]
    )
    d = determinant(m)
    return [[cofactor(j, i) / d for j in range(3)] for i in range(3)]


def image(matrix, point):
    return tuple(sum(m * x for m, x in zip(row, point)) for row in matrix)


def image_of_box(matrix, box):
    """The box of the image of a box."""
    corners = [
        image(matrix, (x, y, z)) for x in box[0:2] for y in box[2:4] for z in box[4:6]
    ]
    return [bound(corner[axis] for corner in corners) for axis in range(3) for bound in (min, max)]


def words_of(matrix):
    return [x for row in matrix for x in row]


class Program:
    """Runs `equiaffine`, and remembers the commands, as somebody would type them in the folder of the item."""

    def __init__(self, path, folder):
        self.path, self.folder, self.commands = path, folder, []

    def run(self, *words, text=None):
        words = [str(word) for word in words]
        self.commands.append(" ".join(map(shlex.quote, ["equiaffine", *words])))
        result = subprocess.run([self.path, *words], cwd=self.folder, input=text, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"equiaffine {words[0]}: {result.stderr.strip()}")
        return result.stdout

    def mesh(self, name, *words):
        """Makes `name`.ply and reads it."""
        self.run("mesh", *words, "-o", name + ".ply")
        return read_ply(self.folder / (name + ".ply"))

    def evaluate(self, points, *words):
        """The columns of attributes at points."""
        return read_csv(self.run("evaluate", *words, "--points", "-", "-o", "-", text=points_csv(points)))
