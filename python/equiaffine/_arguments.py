# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of the functions become words of the program's command line, and arrays of the types that the core takes."""
import contextlib
import numbers
import os
import pathlib
import re

import numpy

from . import _core
from ._results import Fit, Surface, Volume

ARGUMENTS = {"isovalue": "level", "function": "f", "volume": "f", "set": "constants"}


@contextlib.contextmanager
def sentences():
    """Names options of the command line in errors as arguments here."""
    try:
        yield
    except ValueError as error:
        if not error.args or not isinstance(error.args[0], str):
            raise
        text = re.sub(r"--([a-z][a-z-]*)", lambda match: ARGUMENTS.get(match[1], match[1].replace("-", "_")),
                      error.args[0])
        raise ValueError(text) from None


def word_of(value):
    return repr(float(value)) if isinstance(value, numbers.Real) and not isinstance(value, bool) else str(value)


def words_of(**options):
    """The words of options: None is left out, True is an option without a value, and sequences are several values."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is True:
            continue
        if isinstance(value, (str, numbers.Real)):
            words.append(word_of(value))
        else:
            words.extend(word_of(each) for each in numpy.asarray(value).tolist())
    return words


def integers_of(value):
    """Whole numbers, of which one may stand for three."""
    if value is None:
        return None
    return [str(int(each)) for each in numpy.atleast_1d(value)]


def common_words(attributes, threads):
    if not isinstance(attributes, str):
        attributes = ",".join(attributes)
    return ["--attributes", attributes] + ([] if threads is None else ["--threads", str(int(threads))])


def box_of(box):
    if box is None:
        return None
    box = numpy.asarray(box, float)
    if box.ndim == 0:
        box = numpy.array([-1, 1, -1, 1, -1, 1]) * abs(float(box))
    if box.size != 6:
        raise ValueError("box: give xmin, xmax, ymin, ymax, zmin, zmax, or one number for a cube around the origin")
    return box.ravel()


def points_of(points, name):
    points = numpy.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3 or points.dtype.kind not in "fiu":
        raise ValueError(f"{name}: give an array of numbers of the shape (n, 3), and not {points.dtype} {points.shape}")
    return points.astype(float, copy=False)


def faces_of(F):
    if F is None:
        return numpy.empty((0, 3), numpy.int64)
    F = numpy.asarray(F)
    if F.size == 0:
        return numpy.empty((0, 3), numpy.int64)
    if F.ndim != 2 or F.shape[1] != 3 or F.dtype.kind not in "iu":
        raise ValueError(f"F: give an array of integers of the shape (m, 3), and not {F.dtype} {F.shape}")
    return F.astype(numpy.int64, copy=False)


def view_of(V, F=None, normals=None):
    columns = {}
    if normals is not None:
        columns = dict(zip(("nx", "ny", "nz"), numpy.ascontiguousarray(points_of(normals, "normals").T)))
    return _core.Points_view(points_of(V, "V"), faces_of(F), columns, None)


def steps_of(spacing, direction):
    spacing = numpy.broadcast_to(numpy.asarray(1 if spacing is None else spacing, float), 3)
    direction = numpy.eye(3) if direction is None else numpy.asarray(direction, float)
    if direction.shape != (3, 3):
        raise ValueError("direction: give a matrix of the shape (3, 3), with a unit vector in each column")
    return (direction * spacing).T


def volume_view_of(values, spacing, origin, direction):
    values = numpy.asarray(values)
    if values.ndim != 3 or values.dtype.kind not in "biuf":
        raise ValueError(f"f: give an array of real numbers of three dimensions, and not {values.dtype} {values.shape}")
    if not values.dtype.isnative or values.dtype.char in "eg":
        values = values.astype(float)
    origin = numpy.zeros(3) if origin is None else numpy.asarray(origin, float)
    if origin.shape != (3,):
        raise ValueError("origin: give three numbers")
    return _core.Volume_view(values, origin, steps_of(spacing, direction))


def sampled(function, box, resolution):
    """The values of a function of arrays x, y, z on a grid."""
    box = box_of(box)
    if box is None:
        raise ValueError("box: say where the function is to be sampled, such as box=2")
    shape = numpy.broadcast_to(64 if resolution is None else resolution, 3).astype(int)
    if min(shape) < 2:
        raise ValueError("resolution: two nodes or more are needed along each axis")
    axes = [numpy.linspace(box[2 * k], box[2 * k + 1], shape[k]) for k in range(3)]
    values = numpy.empty(shape)
    for i, x in enumerate(axes[0]):
        y, z = numpy.meshgrid(axes[1], axes[2], indexing="ij")
        values[i] = function(numpy.full_like(y, x), y, z)
    return values, (box[1::2] - box[::2]) / (shape - 1), box[::2]


def source_of(f, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None, smoothing=None):
    """The words of a source, and what is given in memory."""
    def refuse(kind, **others):
        for name, value in others.items():
            if value is not None:
                raise TypeError(f"{name} is not for {kind}")
    samples = {"spacing": spacing, "origin": origin, "direction": direction}
    if isinstance(f, str):
        refuse("a formula", smoothing=smoothing, **samples)
        words = ["--function=" + f, *words_of(box=box_of(box))]
        for name, value in (constants or {}).items():
            words += ["--set", f"{name}={word_of(value)}"]
        return words + ([] if resolution is None else ["--resolution", *integers_of(resolution)]), None
    refuse("what is no formula", constants=constants)
    if isinstance(f, Fit):
        refuse("a fit", smoothing=smoothing, **samples)
        words = ["--fit=the data", *words_of(box=box_of(box))]
        return words + ([] if resolution is None else ["--resolution", *integers_of(resolution)]), f._core
    if callable(f):
        refuse("a function", **samples)
        f, spacing, origin = sampled(f, box, resolution)
    elif isinstance(f, Volume):
        refuse("a Volume", box=box, resolution=resolution, **samples)
        f, spacing, origin, direction = f.values, f.spacing, f.origin, f.direction
    else:
        refuse("an array", box=box, resolution=resolution)
    return (["--volume=the array", *words_of(smoothing=smoothing)], volume_view_of(f, spacing, origin, direction))


def fit_words(scale, noise, degree, feature_angle):
    if scale is not None and not isinstance(scale, str) and scale == 0:
        scale = "none"
    degree = None if degree is None else str(degree)
    return words_of(scale=scale, noise=noise, degree=degree, feature_angle=feature_angle)


def data_of(V, F, normals=None):
    """Vertices, triangles and normals, of a Surface, too."""
    if not isinstance(V, Surface):
        return V, F, normals
    if F is not None:
        raise TypeError("F is not for a Surface, which has its own")
    if normals is None and not len(V.F) and "normal" in V:
        normals = V["normal"]
    return V.V, V.F, normals


def registered(a, name):
    """The words of a surface, and its data if they are in memory."""
    if isinstance(a, (str, pathlib.PurePath)):
        path = os.fspath(a)
        if isinstance(a, str) and not os.path.exists(path):
            raise ValueError(f"{name}: there is no file '{path}'")
        return [path], None
    if isinstance(a, tuple):
        return [name + ".ply"], view_of(*a)
    if isinstance(a, Surface):
        return [name + ".ply"], view_of(*data_of(a, None))
    return [name + ".ply"], view_of(a)


def whole_view_of(surface):
    status = None if surface.status is None else numpy.asarray(surface.status, numpy.uint8)
    columns = {name: numpy.ascontiguousarray(values, float) for name, values in surface.attributes.items()}
    return _core.Points_view(points_of(surface.V, "V"), faces_of(surface.F), columns, status)
