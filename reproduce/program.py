# SPDX-License-Identifier: GPL-3.0-or-later
"""The program `equiaffine` and its surfaces."""

import array
import csv
import functools
import io
import math
import shlex
import struct
import subprocess

PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
             "double": "d"}


class Surface:
    """A triangle mesh or points with attributes: `surface["affine_mean_curvature"]` is a list of floats."""

    def __init__(self, columns, faces=b"", face_type="<Biii"):
        self.columns, self._faces, self._face_type = columns, faces, face_type

    @functools.cached_property
    def triangles(self):
        return [row[1:] for row in struct.iter_unpack(self._face_type, self._faces)]

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.columns["x"])

    def vectors(self, name):
        """The vectors `name`_x, _y, _z; the normals for "n", the points for ""."""
        stem = name + "_" if len(name) > 1 else name
        return list(zip(*(self.columns[stem + axis] for axis in "xyz")))

    @property
    def points(self):
        return self.vectors("")

    def is_regular(self):
        return [status == 0 for status in self["status"]]

    def samples(self):
        """A point in each triangle, and the column `area`. Points are those of Roberts' additive sequence, which fills
        the unit square evenly. Vertices and centroids would cluster on layers of the grid that are parallel to a plane
        of symmetry."""
        x, y, z = (self[axis] for axis in "xyz")
        rows = array.array("d")
        for i, (a, b, c) in enumerate(self.triangles):
            ux, uy, uz = x[b] - x[a], y[b] - y[a], z[b] - z[a]
            vx, vy, vz = x[c] - x[a], y[c] - y[a], z[c] - z[a]
            area = math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2
            s, t = (0.5 + 0.7548776662466927 * i) % 1, (0.5 + 0.5698402909980532 * i) % 1
            if s + t > 1:
                s, t = 1 - s, 1 - t
            rows.extend((x[a] + s * ux + t * vx, y[a] + s * uy + t * vy, z[a] + s * uz + t * vz, area))
        return Surface({name: rows[i::4] for i, name in enumerate(("x", "y", "z", "area"))})


def read_ply(path):
    """Reads a mesh or points written by `equiaffine`: binary, little-endian, triangles."""
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
    columns = zip(*struct.iter_unpack(types, data[end:faces]))
    return Surface(dict(zip(names, map(list, columns))), data[faces:], face_type)


def write_ply(path, columns, triangles=()):
    """Writes input for `equiaffine view` and `evaluate`. The first columns must be x, y, z."""
    numbers = array.array("d", (number for row in zip(*columns.values()) for number in row))
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(columns['x'])}"]
    lines += [f"property double {name}" for name in columns]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(lines).encode())
        file.write(numbers.tobytes())
        file.write(b"".join(struct.pack("<Biii", 3, *triangle) for triangle in triangles))


def read_csv(text):
    """A dictionary of columns of numbers; the status remains text."""
    header, *rows = csv.reader(io.StringIO(text))
    columns = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    return {n: column if n == "status" else [float(x) for x in column] for n, column in columns.items()}


def points_csv(points):
    return "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points)


def read_curve_points(path):
    """The points of the polylines of an OBJ file."""
    with open(path, encoding="ascii") as file:
        return [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]


class Program:
    """Runs `equiaffine` in the folder of the item, and records the commands as one would type them."""

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
        """Meshes to `name`.ply and reads it."""
        self.run("mesh", *words, "-o", name + ".ply")
        return read_ply(self.folder / (name + ".ply"))

    def evaluate(self, points, *words):
        """The columns of attributes at a small number of points; the status is a word."""
        return read_csv(self.run("evaluate", *words, "--points", "-", "-o", "-", text=points_csv(points)))

    def evaluate_many(self, name, points, *words):
        """The attributes at points as a Surface, using the files `name`-points.ply and `name`.ply."""
        write_ply(self.folder / (name + "-points.ply"), points.columns)
        self.run("evaluate", *words, "--points", name + "-points.ply", "-o", name + ".ply")
        return read_ply(self.folder / (name + ".ply"))
