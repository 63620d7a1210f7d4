# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of the functions become words of the program's command line, and arrays of the types that the core takes."""
import math
import numbers
import operator
import os
import re

import numpy

from . import _core
from ._results import Fit, Surface, Volume


def number_word(name, value):
    """A number, or a word such as "auto", for the command line."""
    if isinstance(value, str) and re.fullmatch(r"[a-z]+", value):
        return value
    try:
        if isinstance(value, (bool, str, bytes)) or numpy.ndim(value) != 0 or isinstance(value, complex):
            raise TypeError
        number = float(value)
    except TypeError:
        raise ValueError(f"{name}: give a number, and not {value!r}") from None
    if not math.isfinite(number):
        raise ValueError(f"{name}: give a finite number, and not {value!r}")
    return repr(number)


def numbers_of(**values):
    """The words of options with a number each; None is left out."""
    words = []
    for name, value in values.items():
        if value is not None:
            words += ["--" + name.replace("_", "-"), number_word(name, value)]
    return words


def integer_of(name, value):
    try:
        return str(operator.index(value))
    except TypeError:
        raise ValueError(f"{name}: give a whole number, and not {value!r}") from None


def choice_of(name, value, *choices):
    if value not in choices:
        raise ValueError(f"{name}: give one of {', '.join(choices)}, and not {value!r}")
    return value


def resolution_of(resolution):
    """Three numbers of nodes, of which one may stand for all."""
    values = list(numpy.atleast_1d(numpy.asarray(resolution, object)))
    if len(values) not in (1, 3):
        raise ValueError(f"resolution: give a whole number, or three, and not {resolution!r}")
    return [integer_of("resolution", value) for value in (values * 3 if len(values) == 1 else values)]


def common_words(attributes, threads, orientation=None):
    if not isinstance(attributes, str):
        try:
            attributes = ",".join(attributes)
        except TypeError:
            raise ValueError(f"attributes: give names, and not {attributes!r}") from None
    words = ["--attributes", attributes]
    if orientation is not None:
        words += ["--orientation", choice_of("orientation", orientation, "gradient", "against")]
    return words + thread_words(threads)


def thread_words(threads):
    return [] if threads is None else ["--threads", integer_of("threads", threads)]


def box_of(box):
    if box is None:
        return None
    try:
        box = numpy.asarray(box, float)
    except (TypeError, ValueError):
        box = numpy.empty(0)
    if box.ndim == 0:
        box = numpy.array([-1, 1, -1, 1, -1, 1]) * abs(float(box))
    if box.shape not in ((6,), (3, 2)) or not numpy.isfinite(box).all() or not (box.ravel()[::2] < box.ravel()[1::2]).all():
        raise ValueError("box: give xmin, xmax, ymin, ymax, zmin, zmax, or one number for a cube around the origin")
    return box.ravel()


def box_words(box):
    box = box_of(box)
    return [] if box is None else ["--box", *map(repr, box.tolist())]


def array_of(values, name, kinds):
    """An array of numbers of those kinds, without a mask."""
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name}: an array with masked elements has no meaning here; leave the elements out")
    try:
        values = numpy.asarray(values)
    except ValueError:
        values = numpy.empty(0, object)
    if values.dtype.kind not in kinds:
        raise ValueError(f"{name}: give an array of {'integers' if 'f' not in kinds else 'real numbers'}, and not of {values.dtype}")
    return values


def points_of(points, name):
    points = array_of(points, name, "fiu")
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name}: give an array of the shape (n, 3), and not {points.shape}")
    return points.astype(float, copy=False)


def faces_of(F):
    if F is None or numpy.size(F) == 0:
        return numpy.empty((0, 3), numpy.int64)
    F = array_of(F, "F", "iu")
    if F.ndim != 2 or F.shape[1] != 3:
        raise ValueError(f"F: give an array of integers of the shape (m, 3), and not {F.shape}")
    return F.astype(numpy.int64, copy=False)


def mesh_of(V, F=None, normals=None, name="V"):
    columns = {}
    if normals is not None:
        columns = dict(zip(("nx", "ny", "nz"), numpy.ascontiguousarray(points_of(normals, "normals").T)))
    return _core.Mesh(points_of(V, name), faces_of(F), columns, None, [])


def whole_mesh_of(surface):
    """A surface, or (V, F), with all that is known of it."""
    if isinstance(surface, tuple):
        surface = Surface(*surface)
    if not isinstance(surface, Surface):
        raise ValueError(f"give a Surface or (V, F), and not {type(surface).__name__}")
    columns = {}
    for name, values in surface.attributes.items():
        if not isinstance(name, str) or not re.fullmatch(r"[^\s,;\"\x00-\x1f]+", name) or name in ("x", "y", "z", "status"):
            raise ValueError(f"the name {name!r} of an attribute cannot be written: use letters, digits and underscores")
        columns[name] = array_of(values, name, "biuf").astype(float)
    status = surface.status
    if status is not None:
        status = array_of(status, "status", "iu")
        if status.size and not 0 <= status.min() <= status.max() <= 255:
            raise ValueError("status: there is a number that is no Status")
        status = status.astype(numpy.uint8)
    return _core.Mesh(points_of(surface.V, "V"), faces_of(surface.F), columns, status, list(surface.comments))


def steps_of(spacing, direction):
    spacing = numpy.broadcast_to(numpy.asarray(1 if spacing is None else spacing, float), 3)
    direction = numpy.eye(3) if direction is None else numpy.asarray(direction, float)
    if direction.shape != (3, 3):
        raise ValueError("direction: give a matrix of the shape (3, 3), with a unit vector in each column")
    return (direction * spacing).T


def volume_view_of(values, spacing, origin, direction, name="f"):
    if numpy.ma.isMaskedArray(values):
        values = values.astype(float).filled(numpy.nan)
    values = array_of(values, name, "biuf")
    if values.ndim != 3:
        raise ValueError(f"{name}: give an array of three dimensions, and not of the shape {values.shape}")
    if not values.dtype.isnative or values.dtype.char in "eg":
        values = values.astype(float)
    origin = numpy.zeros(3) if origin is None else numpy.asarray(origin, float)
    if origin.shape != (3,):
        raise ValueError("origin: give three numbers")
    return _core.Volume_view(values, origin, steps_of(spacing, direction))


def sampled(function, box, resolution):
    """The values of a function of arrays x, y, z on a grid, the steps, and the first node."""
    box = box_of(box)
    if box is None:
        raise ValueError("box: say where the function is to be sampled, such as box=2")
    shape = [int(word) for word in resolution_of(64 if resolution is None else resolution)]
    if min(shape) < 2:
        raise ValueError("resolution: two nodes or more are needed along each axis")
    x, y, z = [numpy.linspace(box[2 * k], box[2 * k + 1], shape[k]) for k in range(3)]
    values = numpy.empty(shape)
    y, z = numpy.meshgrid(y, z, indexing="ij")
    for i in range(shape[0]):
        values[i] = function(numpy.full_like(y, x[i]), y, z)
    return values, (box[1::2] - box[::2]) / (numpy.array(shape) - 1), box[::2]


def source_of(f, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None, smoothing=None):
    """The words of a source, and what it is made of."""
    def refuse(kind, **others):
        for name, value in others.items():
            if value is not None:
                raise TypeError(f"{name} is not for {kind}")
    samples = {"spacing": spacing, "origin": origin, "direction": direction}
    resolution_words = [] if resolution is None else ["--resolution", *resolution_of(resolution)]
    if isinstance(f, str):
        refuse("a formula", smoothing=smoothing, **samples)
        if not hasattr(constants or {}, "items"):
            raise ValueError("constants: give a dictionary of names and numbers")
        values = {str(name): float(number_word(f"constants[{name!r}]", value)) for name, value in (constants or {}).items()}
        return ["--function=f", *box_words(box), *resolution_words], (f, values)
    refuse("what is no formula", constants=constants)
    if isinstance(f, Fit):
        refuse("a fit", smoothing=smoothing, **samples)
        return ["--fit=V", *box_words(box), *resolution_words], f._core
    if callable(f):
        refuse("a function", **samples)
        f, spacing, origin = sampled(f, box, resolution)
    elif isinstance(f, Volume):
        refuse("a Volume", box=box, resolution=resolution, **samples)
        f, spacing, origin, direction = f.values, f.spacing, f.origin, f.direction
    else:
        refuse("an array", box=box, resolution=resolution)
    return ["--volume=f", *numbers_of(smoothing=smoothing)], volume_view_of(f, spacing, origin, direction)


def fit_words(scale, noise, degree, feature_angle):
    if isinstance(scale, numbers.Real) and scale == 0:
        scale = "none"
    words = numbers_of(scale=scale, noise=noise, feature_angle=feature_angle)
    return words if degree is None else [*words, "--degree", integer_of("degree", degree)]


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
    if isinstance(a, (str, os.PathLike)):
        path = os.fspath(a)
        if not os.path.exists(path):
            raise ValueError(f"{name}: there is no file '{path}'")
        return [path], None
    if isinstance(a, Surface):
        a = data_of(a, None)
    return [name + ".ply"], mesh_of(*a, name=name) if isinstance(a, tuple) else mesh_of(a, name=name)


def path_of(path):
    """The bytes of a path, for any name that a file may have, and its text."""
    text = os.fsdecode(path)
    if text in ("", "-"):
        raise ValueError(f"path: give the name of a file, and not {text!r}")
    return os.fsencode(path), text
