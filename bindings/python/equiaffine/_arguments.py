# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of the functions become options of the core, and arrays of the types that it takes."""
import numbers
import operator
import os
import re

import numpy

from . import _core
from ._results import Fit, Surface, Volume


def given(**options):
    """The options that are not None. The core checks them."""
    return {name: value for name, value in options.items() if value is not None}


def finite_numbers(value):
    """An array of finite numbers, with none if something else is among them."""
    try:
        found = numpy.asarray(value)
        if found.dtype.kind == "O" and not any(isinstance(item, (bool, str)) for item in found.ravel()):
            found = found.astype(float)
    except (TypeError, ValueError):
        return numpy.empty(0)
    return found.astype(float) if found.dtype.kind in "fiu" and numpy.isfinite(found).all() else numpy.empty(0)


def numbers_in(name, value, count):
    """An array of that many finite numbers."""
    found = finite_numbers(value)
    if found.shape != (count,):
        raise ValueError(f"{name}: give {count} finite numbers, and not {value!r}")
    return found


def spacing_of(spacing):
    if spacing is None:
        return numpy.ones(3)
    return numbers_in("spacing", [spacing] * 3 if numpy.ndim(spacing) == 0 else spacing, 3)


def direction_of(direction):
    """A matrix with unit vectors in its columns."""
    if direction is None:
        return numpy.eye(3)
    found = finite_numbers(direction)
    if found.shape != (3, 3) or not (abs(numpy.linalg.norm(found, axis=0) - 1) < 1e-6).all():
        raise ValueError("direction: give a matrix of the shape (3, 3), with a unit vector in each column; lengths are spacing")
    return found


def box_of(box):
    if box is None:
        return None
    box = finite_numbers(box)
    if box.ndim == 0:
        box = numpy.array([-1, 1, -1, 1, -1, 1]) * abs(float(box))
    if box.shape not in ((6,), (3, 2)) or not (box.ravel()[::2] < box.ravel()[1::2]).all():
        raise ValueError("box: give xmin, xmax, ymin, ymax, zmin, zmax, or one number for a cube around the origin")
    return box.ravel()


def array_of(values, name, kinds):
    """An array of numbers of those kinds, without a mask."""
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name}: an array with masked elements has no meaning here; leave the elements out")
    try:
        values = numpy.asarray(values)
    except ValueError:
        values = numpy.empty(0, object)
    if values.dtype.kind == "U" and values.ndim == 0:
        raise ValueError(f"{name}: give an array, and not a text; read(path) reads a file")
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


def finite_points_of(points, name):
    points = points_of(points, name)
    wrong = ~numpy.isfinite(points).all(axis=1)
    if wrong.any():
        raise ValueError(f"{name}: {wrong.sum()} points are not finite, the first at {wrong.argmax()}; leave them out")
    return points


def mesh_of(V, F=None, normals=None, name="V"):
    """Vertices and triangles, with normals."""
    if isinstance(V, (tuple, Surface, Volume, Fit)):
        raise ValueError(f"{name}: give an array of the shape (n, 3), and not {type(V).__name__}")
    V, columns = finite_points_of(V, name), {}
    if normals is not None:
        normals = points_of(normals, "normals")
        if len(normals) != len(V):
            raise ValueError(f"normals: give one for each of the {len(V)} points, and not {len(normals)}")
        columns = dict(zip(("nx", "ny", "nz"), numpy.ascontiguousarray(normals.T)))
    return _core.Mesh(V, faces_of(F), columns, None, [])


def places_of(points):
    """Points where a function is evaluated, which need not be finite."""
    return _core.Mesh(points_of(points, "points"), faces_of(None), {}, None, [])


def whole_mesh_of(surface):
    """A surface, or (V, F), with all that is known of it."""
    if isinstance(surface, tuple) and 2 <= len(surface) <= 3:
        surface = Surface(*surface)
    if not isinstance(surface, Surface):
        raise ValueError(f"give a Surface or (V, F), and not {type(surface).__name__}")
    columns = {}
    for name, values in surface.attributes.items():
        if name in ("x", "y", "z", "status"):
            raise ValueError(f"attributes: {name!r} is the name of what a file has besides; choose another one")
        if not isinstance(name, str) or not re.fullmatch(r"[^\s,;\"\x00-\x1f]+", name):
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
    return (direction_of(direction) * spacing_of(spacing)).T


def volume_view_of(values, spacing, origin, direction, name="f"):
    if numpy.ma.isMaskedArray(values):
        values = values.astype(float).filled(numpy.nan)
    values = array_of(values, name, "biuf")
    if values.ndim != 3:
        raise ValueError(f"{name}: give an array of three dimensions, and not of the shape {values.shape}")
    if not values.dtype.isnative or values.dtype.char in "eg":
        values = values.astype(float)
    origin = numpy.zeros(3) if origin is None else numbers_in("origin", origin, 3)
    return _core.Volume_array(values, origin, steps_of(spacing, direction))


def sampled(function, box, resolution):
    """The values of a function of arrays x, y, z on a grid, the steps, and the first node."""
    box = box_of(box)
    if box is None:
        raise ValueError("box: say where the function is to be sampled, such as box=2")
    try:
        nodes = numpy.asarray(64 if resolution is None else resolution, object)
        shape = [operator.index(n) for n in numpy.broadcast_to(nodes, 3)]
    except (TypeError, ValueError):
        raise ValueError(f"resolution: give a whole number, or three, and not {resolution!r}") from None
    if min(shape) < 2:
        raise ValueError("resolution: two nodes or more are needed along each axis")
    x, y, z = [numpy.linspace(box[2 * k], box[2 * k + 1], shape[k]) for k in range(3)]
    values = numpy.empty(shape)
    y, z = numpy.meshgrid(y, z, indexing="ij")
    for i in range(shape[0]):
        found = array_of(function(numpy.full_like(y, x[i]), y, z), "f(x, y, z)", "biuf")
        if found.shape not in ((), y.shape):
            raise ValueError(f"f: for arrays of the shape {y.shape} it returns one of {found.shape}; return a number for each point")
        values[i] = found
    return values, (box[1::2] - box[::2]) / (numpy.array(shape) - 1), box[::2]


def source_of(f, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None, smoothing=None):
    """The options of a source, and what it is made of."""
    def refuse(kind, **others):
        for name, value in others.items():
            if value is not None:
                raise TypeError(f"{name} is not for {kind}")
    samples = {"spacing": spacing, "origin": origin, "direction": direction}
    if isinstance(f, str):
        refuse("a formula", smoothing=smoothing, **samples)
        return given(function="f", constants=constants, box=box_of(box), resolution=resolution), f
    refuse("what is no formula", constants=constants)
    if isinstance(f, Surface):
        raise ValueError("f: a Surface is no function; fit(surface) makes one")
    if isinstance(f, Fit):
        refuse("a fit", smoothing=smoothing, **samples)
        return given(fit="V", box=box_of(box), resolution=resolution), f._core
    if callable(f):
        refuse("a function", **samples)
        f, spacing, origin = sampled(f, box, resolution)
    elif isinstance(f, Volume):
        refuse("a Volume", box=box, resolution=resolution, **samples)
        f, spacing, origin, direction = f.values, f.spacing, f.origin, f.direction
    else:
        refuse("an array", box=box, resolution=resolution)
    return given(volume="f", smoothing=smoothing), volume_view_of(f, spacing, origin, direction)


def scale_of(scale):
    """The scale, for which 0 is another word for "none"."""
    return "none" if isinstance(scale, numbers.Real) and not isinstance(scale, bool) and scale == 0 else scale


def fit_options(scale, noise, degree, feature_angle, threads):
    return given(MESH="V", scale=scale_of(scale), noise=noise, degree=degree, feature_angle=feature_angle,
                 threads=threads)


def data_of(V, F, normals=None):
    """Vertices, triangles and normals, of a Surface, too."""
    if isinstance(V, tuple) and F is None:
        raise ValueError("V: give V and F as two arguments, or a Surface")
    if not isinstance(V, Surface):
        return V, F, normals
    if F is not None:
        raise TypeError("F is not for a Surface, which has its own")
    if normals is None and not len(V.F) and "normal" in V:
        normals = V["normal"]
    return V.V, V.F, normals


def registered(a, name, scale):
    """The options of a surface to register, and its data if they are in memory."""
    options = given(FILE=name + ".ply", scale=scale_of(scale))
    if isinstance(a, (str, os.PathLike)):
        path = os.fspath(a)
        if not os.path.exists(path):
            raise ValueError(f"{name}: there is no file '{path}'")
        return {**options, "FILE": os.fsencode(path)}, None
    if isinstance(a, Surface):
        a = data_of(a, None)
    if isinstance(a, (Fit, Volume)):
        raise ValueError(f"{name}: give a Surface, (V, F), points or the path of a file, and not a {type(a).__name__}")
    if isinstance(a, tuple) and not 2 <= len(a) <= 3:
        raise ValueError(f"{name}: give (V, F) or (V, F, normals)")
    return options, mesh_of(*a, name=name) if isinstance(a, tuple) else mesh_of(a, name=name)


def path_of(path):
    """The bytes of a path, for any name that a file may have, and its text."""
    text = os.fsdecode(path)
    if text in ("", "-"):
        raise ValueError(f"path: give the name of a file, and not {text!r}")
    return os.fsencode(path), text
