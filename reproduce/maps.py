# SPDX-License-Identifier: GPL-3.0-or-later
"""Linear maps, as lists of rows, and images of objects."""

import re

from .program import Surface


def transformed(expression, matrix):
    """The expression f(A^-1 p), whose surface is the image of f = 0 under the linear map A."""
    inverse = inverted(matrix)
    rows = dict(zip("xyz", ("(" + " + ".join(f"({c!r})*{v}" for c, v in zip(row, "xyz")) + ")" for row in inverse)))
    return re.sub(r"\b[xyz]\b", lambda match: rows[match.group()], expression)


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
               for i in range(3))


def unimodular(matrix):
    """The matrix divided by the cube root of its determinant, which must be positive."""
    root = determinant(matrix) ** (1 / 3)
    return [[x / root for x in row] for row in matrix]


def inverted(m):
    cofactor = lambda i, j: (m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
                             - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3])
    d = determinant(m)
    return [[cofactor(j, i) / d for j in range(3)] for i in range(3)]


def image(matrix, point):
    return tuple(sum(m * x for m, x in zip(row, point)) for row in matrix)


def image_of_points(matrix, points):
    """A Surface of the images of the points of a Surface."""
    return Surface(dict(zip("xyz", zip(*(image(matrix, p) for p in points.points)))))


def image_of_box(matrix, box):
    """The bounding box of the image of a box."""
    corners = [image(matrix, (x, y, z)) for x in box[0:2] for y in box[2:4] for z in box[4:6]]
    return [bound(corner[axis] for corner in corners) for axis in range(3) for bound in (min, max)]


def words_of(matrix):
    return [x for row in matrix for x in row]


SHEAR = unimodular([[1.0, 2.0, 0.3], [0.0, 0.8, -0.5], [0.2, 0.4, 1.36]])
