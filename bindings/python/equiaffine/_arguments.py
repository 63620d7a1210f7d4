# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts arguments of the functions to options and arrays of the core."""
import numbers
import operator
import os
import re

import numpy

from . import _core
from ._results import Fit, Surface, Volume


def given(**options):
    """The options that are not None. The core validates them."""
    return {name: value for name, value in options.items() if value is not None}


def finite_numbers(value):
    """The value as an array of floats; empty if it contains anything but finite numbers."""
    try:
        found = numpy.asarray(value)
        if found.dtype.kind == "O" and not any(isinstance(item, (bool, str)) for item in found.ravel()):
            found = found.astype(float)
    except (TypeError, ValueError):
        return numpy.empty(0)
    return found.astype(float) if found.dtype.kind in "fiu" and numpy.isfinite(found).all() else numpy.empty(0)


def numbers_in(name, value, count):
    """The value as an array of `count` finite numbers."""
    found = finite_numbers(value)
    if found.shape != (count,):
        raise ValueError(f"{name}: give {count} finite numbers, not {value!r}")
    return found


def spacing_of(spacing):
    if spacing is None:
        return numpy.ones(3)
    return numbers_in("spacing", [spacing] * 3 if numpy.ndim(spacing) == 0 else spacing, 3)


def direction_of(direction):
    """The value as a matrix whose columns are unit vectors."""
    if direction is None:
        return numpy.eye(3)
    found = finite_numbers(direction)
    if found.shape != (3, 3) or not (abs(numpy.linalg.norm(found, axis=0) - 1) < 1e-6).all():
        raise ValueError("direction: give a (3, 3) matrix of unit vectors in its columns; pass lengths as spacing")
    return found


def box_of(box):
    if box is None:
        return None
    box = finite_numbers(box)
    if box.ndim == 0:
        box = numpy.array([-1, 1, -1, 1, -1, 1]) * abs(float(box))
    if box.shape not in ((6,), (3, 2)) or not (box.ravel()[::2] < box.ravel()[1::2]).all():
        raise ValueError("box: give xmin, xmax, ymin, ymax, zmin, zmax, increasing along each axis, or one number for a "
                         "cube around the origin")
    return box.ravel()


def array_of(values, name, kinds):
    """The values as an array of numbers of these kinds of dtype."""
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name}: masked elements are not supported; remove them")
    try:
        values = numpy.asarray(values)
    except ValueError:
        values = numpy.empty(0, object)
    if values.dtype.kind == "U" and values.ndim == 0:
        raise ValueError(f"{name}: give an array, not a string; to use a file, call read(path)")
    if values.dtype.kind not in kinds:
        wanted = "real numbers" if "f" in kinds else "integers"
        raise ValueError(f"{name}: give an array of {wanted}, not of {values.dtype}")
    return values


def points_of(points, name):
    points = array_of(points, name, "fiu")
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name}: give an array of shape (n, 3), not {points.shape}")
    return points.astype(float, copy=False)


def faces_of(F):
    if F is None or numpy.size(F) == 0:
        return numpy.empty((0, 3), numpy.int64)
    F = array_of(F, "F", "iu")
    if F.ndim != 2 or F.shape[1] != 3:
        raise ValueError(f"F: give an array of integers of shape (m, 3), not {F.shape}")
    return F.astype(numpy.int64, copy=False)


def finite_points_of(points, name):
    points = points_of(points, name)
    wrong = ~numpy.isfinite(points).all(axis=1)
    if wrong.any():
        points_are = "1 point is" if wrong.sum() == 1 else f"{wrong.sum()} points are"
        raise ValueError(f"{name}: {points_are} not finite, the first at index {wrong.argmax()}; remove them")
    return points


def mesh_of(V, F=None, normals=None, name="V"):
    """A mesh of the core, with normals if given."""
    if isinstance(V, (tuple, Surface, Volume, Fit)):
        raise ValueError(f"{name}: give an array of shape (n, 3), not {type(V).__name__}")
    V, columns = finite_points_of(V, name), {}
    if normals is not None:
        normals = points_of(normals, "normals")
        if len(normals) != len(V):
            raise ValueError(f"normals: give one for each of the {len(V)} points, not {len(normals)}")
        columns = dict(zip(("nx", "ny", "nz"), numpy.ascontiguousarray(normals.T)))
    return _core.Mesh(V, faces_of(F), columns, None, [])


def places_of(points):
    """Points at which a function is evaluated. They need not be finite."""
    return _core.Mesh(points_of(points, "points"), faces_of(None), {}, None, [])


def whole_mesh_of(surface):
    """A Surface or (V, F) as a mesh of the core, with attributes, status and comments."""
    if isinstance(surface, tuple) and 2 <= len(surface) <= 3:
        surface = Surface(*surface)
    if not isinstance(surface, Surface):
        raise ValueError(f"give a Surface or (V, F), not {type(surface).__name__}")
    columns = {}
    for name, values in surface.attributes.items():
        if name in ("x", "y", "z", "status"):
            raise ValueError(f"attributes: the name {name!r} is reserved in files; choose another one")
        if not isinstance(name, str) or not re.fullmatch(r"[^\s,;\"\x00-\x1f]+", name):
            raise ValueError(f"attributes: the name {name!r} cannot be written; use letters, digits and underscores")
        columns[name] = array_of(values, name, "biuf").astype(float)
    status = surface.status
    if status is not None:
        status = array_of(status, "status", "iu")
        if status.size and not 0 <= status.min() <= status.max() <= 255:
            raise ValueError("status: give values of Status only, from 0 to 4")
        status = status.astype(numpy.uint8)
    return _core.Mesh(points_of(surface.V, "V"), faces_of(surface.F), columns, status, list(surface.comments))


def steps_of(spacing, direction):
    return (direction_of(direction) * spacing_of(spacing)).T


def volume_view_of(values, spacing, origin, direction, name="f"):
    if numpy.ma.isMaskedArray(values):
        values = values.astype(float).filled(numpy.nan)
    values = array_of(values, name, "biuf")
    if values.ndim != 3:
        raise ValueError(f"{name}: give a three-dimensional array, not one of shape {values.shape}")
    if not values.dtype.isnative or values.dtype.char in "eg":
        values = values.astype(float)
    origin = numpy.zeros(3) if origin is None else numbers_in("origin", origin, 3)
    return _core.Volume_array(values, origin, steps_of(spacing, direction))


def sampled(function, box, resolution):
    """The values of a function of arrays x, y, z on a grid, the spacing, and the origin."""
    box = box_of(box)
    if box is None:
        raise ValueError("box: give the box in which to sample the function, such as box=2")
    try:
        nodes = numpy.asarray(64 if resolution is None else resolution, object)
        shape = [operator.index(n) for n in numpy.broadcast_to(nodes, 3)]
    except (TypeError, ValueError):
        raise ValueError(f"resolution: give a whole number, or three, not {resolution!r}") from None
    if min(shape) < 2:
        raise ValueError(f"resolution: give at least 2 nodes along each axis, not {min(shape)}")
    x, y, z = [numpy.linspace(box[2 * k], box[2 * k + 1], shape[k]) for k in range(3)]
    values = numpy.empty(shape)
    y, z = numpy.meshgrid(y, z, indexing="ij")
    for i in range(shape[0]):
        found = array_of(function(numpy.full_like(y, x[i]), y, z), "f(x, y, z)", "biuf")
        if found.shape not in ((), y.shape):
            raise ValueError(f"f: it returned an array of shape {found.shape} for arguments of shape {y.shape}; "
                             "return one number per point")
        values[i] = found
    return values, (box[1::2] - box[::2]) / (numpy.array(shape) - 1), box[::2]


def source_of(f, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None, smoothing=None):
    """The options of a source, and its data."""
    def refuse(kind, **others):
        for name, value in others.items():
            if value is not None:
                raise TypeError(f"{name}: does not apply to {kind}; leave it out")
    samples = {"spacing": spacing, "origin": origin, "direction": direction}
    if isinstance(f, str):
        refuse("a formula", smoothing=smoothing, **samples)
        return given(function="f", constants=constants, box=box_of(box), resolution=resolution), f
    refuse(f"{type(f).__name__}, only to a formula", constants=constants)
    if isinstance(f, Surface):
        raise ValueError("f: a Surface is not a function; use fit(surface)")
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
    """The scale, with 0 replaced by "none"."""
    return "none" if isinstance(scale, numbers.Real) and not isinstance(scale, bool) and scale == 0 else scale


def fit_options(scale, noise, degree, feature_angle, threads):
    return given(MESH="V", scale=scale_of(scale), noise=noise, degree=degree, feature_angle=feature_angle,
                 threads=threads)


def data_of(V, F, normals=None):
    """Vertices, triangles and normals. V can be a Surface."""
    if isinstance(V, tuple) and F is None:
        raise ValueError("V: give V and F as two arguments, or a Surface")
    if not isinstance(V, Surface):
        return V, F, normals
    if F is not None:
        raise TypeError("F: does not apply to a Surface, which has its own faces; leave it out")
    if normals is None and not len(V.F) and "normal" in V:
        normals = V["normal"]
    return V.V, V.F, normals


def registered(a, name, scale):
    """The options of a surface to register, and its data, or None if they are in a file."""
    options = given(FILE=name + ".ply", scale=scale_of(scale))
    if isinstance(a, (str, os.PathLike)):
        path = os.fspath(a)
        if not os.path.exists(path):
            raise ValueError(f"{name}: no file '{path}'; check the path")
        return {**options, "FILE": os.fsencode(path)}, None
    if isinstance(a, Surface):
        a = data_of(a, None)
    if isinstance(a, (Fit, Volume)):
        raise ValueError(f"{name}: give a Surface, (V, F), points or the path of a file, not {type(a).__name__}")
    if isinstance(a, tuple) and not 2 <= len(a) <= 3:
        raise ValueError(f"{name}: give (V, F) or (V, F, normals), not a tuple of length {len(a)}")
    return options, mesh_of(*a, name=name) if isinstance(a, tuple) else mesh_of(a, name=name)


def path_of(path):
    """A path as bytes, which can represent every file name, and as text."""
    text = os.fsdecode(path)
    if text in ("", "-"):
        raise ValueError(f"path: give the name of a file, not {text!r}")
    return os.fsencode(path), text
