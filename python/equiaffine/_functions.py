# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the module: arguments become words of the program's command line, and arrays."""
import contextlib
import json
import numbers
import os
import pathlib
import re
import tempfile
import webbrowser

import numpy

from . import _core
from ._results import Fit, Registration, Surface, Symmetries, Values, Volume

_VOLUMES = (".nrrd", ".nhdr", ".mhd", ".mha", ".nii", ".nii.gz", ".inr", ".inr.gz", ".vti")
_ARGUMENTS = {"isovalue": "level", "function": "f", "volume": "f", "set": "constants"}


@contextlib.contextmanager
def _sentences():
    """Names options of the command line in errors as arguments here."""
    try:
        yield
    except ValueError as error:
        if not error.args or not isinstance(error.args[0], str):
            raise
        text = re.sub(r"--([a-z][a-z-]*)", lambda match: _ARGUMENTS.get(match[1], match[1].replace("-", "_")),
                      error.args[0])
        raise ValueError(text) from None


def _word(value):
    return repr(float(value)) if isinstance(value, numbers.Real) and not isinstance(value, bool) else str(value)


def _words(**options):
    """The words of options: None is left out, True is an option without a value, and sequences are several values."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is True:
            continue
        if isinstance(value, (str, numbers.Real)):
            words.append(_word(value))
        else:
            words.extend(_word(each) for each in numpy.asarray(value).tolist())
    return words


def _integers(value):
    """Whole numbers, of which one may stand for three."""
    if value is None:
        return None
    return [str(int(each)) for each in numpy.atleast_1d(value)]


def _common(attributes, threads):
    if not isinstance(attributes, str):
        attributes = ",".join(attributes)
    words = [] if attributes is None else ["--attributes", attributes]
    return words + ([] if threads is None else ["--threads", str(int(threads))])


def _box(box):
    if box is None:
        return None
    box = numpy.asarray(box, float)
    if box.ndim == 0:
        box = numpy.array([-1, 1, -1, 1, -1, 1]) * abs(float(box))
    if box.size != 6:
        raise ValueError("box: give xmin, xmax, ymin, ymax, zmin, zmax, or one number for a cube around the origin")
    return box.ravel()


def _points(points, name):
    points = numpy.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3 or points.dtype.kind not in "fiu":
        raise ValueError(f"{name}: give an array of numbers of the shape (n, 3), and not {points.dtype} {points.shape}")
    return points.astype(float, copy=False)


def _faces(F):
    if F is None:
        return numpy.empty((0, 3), numpy.int64)
    F = numpy.asarray(F)
    if F.size == 0:
        return numpy.empty((0, 3), numpy.int64)
    if F.ndim != 2 or F.shape[1] != 3 or F.dtype.kind not in "iu":
        raise ValueError(f"F: give an array of integers of the shape (m, 3), and not {F.dtype} {F.shape}")
    return F.astype(numpy.int64, copy=False)


def _view(V, F=None, normals=None):
    columns = {}
    if normals is not None:
        columns = dict(zip(("nx", "ny", "nz"), numpy.ascontiguousarray(_points(normals, "normals").T)))
    return _core.Points_view(_points(V, "V"), _faces(F), columns, None)


def _steps(spacing, direction):
    spacing = numpy.broadcast_to(numpy.asarray(1 if spacing is None else spacing, float), 3)
    direction = numpy.eye(3) if direction is None else numpy.asarray(direction, float)
    if direction.shape != (3, 3):
        raise ValueError("direction: give a matrix of the shape (3, 3), with a unit vector in each column")
    return (direction * spacing).T


def _volume_view(values, spacing, origin, direction):
    values = numpy.asarray(values)
    if values.ndim != 3 or values.dtype.kind not in "biuf":
        raise ValueError(f"f: give an array of real numbers of three dimensions, and not {values.dtype} {values.shape}")
    if not values.dtype.isnative or values.dtype.char in "eg":
        values = values.astype(float)
    origin = numpy.zeros(3) if origin is None else numpy.asarray(origin, float)
    if origin.shape != (3,):
        raise ValueError("origin: give three numbers")
    return _core.Volume_view(values, origin, _steps(spacing, direction))


def _sampled(function, box, resolution):
    """The values of a function of arrays x, y, z on a grid."""
    box = _box(box)
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


def _source(f, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None, smoothing=None):
    """The words of a source, and what is given in memory."""
    def refuse(kind, **others):
        for name, value in others.items():
            if value is not None:
                raise TypeError(f"{name} is not for {kind}")
    samples = {"spacing": spacing, "origin": origin, "direction": direction}
    if isinstance(f, str):
        refuse("a formula", smoothing=smoothing, **samples)
        words = ["--function=" + f, *_words(box=_box(box))]
        for name, value in (constants or {}).items():
            words += ["--set", f"{name}={_word(value)}"]
        return words + ([] if resolution is None else ["--resolution", *_integers(resolution)]), None
    refuse("what is no formula", constants=constants)
    if isinstance(f, Fit):
        refuse("a fit", smoothing=smoothing, **samples)
        words = ["--fit=the data", *_words(box=_box(box))]
        return words + ([] if resolution is None else ["--resolution", *_integers(resolution)]), f._core
    if callable(f):
        refuse("a function", **samples)
        f, spacing, origin = _sampled(f, box, resolution)
    elif isinstance(f, Volume):
        refuse("a Volume", box=box, resolution=resolution, **samples)
        f, spacing, origin, direction = f.values, f.spacing, f.origin, f.direction
    else:
        refuse("an array", box=box, resolution=resolution)
    return (["--volume=the array", *_words(smoothing=smoothing)], _volume_view(f, spacing, origin, direction))


def mesh(f, *, level=0, box=None, resolution=None, method="marching-cubes", spacing=None, origin=None, direction=None,
         attributes="basic", smoothing=None, constants=None, orientation="gradient", angle=None, radius=None, distance=None,
         threads=None, progress=None):
    """Return the level set f = level with its curvatures.

    Parameters
    ----------
    f : str, numpy.ndarray, Volume, callable or Fit
        A formula in x, y, z; samples in an array of three dimensions, NaN where there is none; a function of arrays
        x, y, z, which is sampled on the grid; or a fit. Derivatives of samples are those of a spline.
    level : float
        The value of f on the surface.
    box : float or sequence of 6 floats
        xmin, xmax, ymin, ymax, zmin, zmax, or a number for a cube around the origin. A formula and a function need it.
    resolution : int or sequence of 3 ints
        Nodes along each axis: 64 for a formula or a function, 129 for a fit. Samples are their own grid.
    method : {"marching-cubes", "delaunay"}
        How the surface is sampled.
    spacing, origin, direction : sequences of floats
        Where samples are: see `Volume`.
    attributes : str or sequence of str
        "basic", "all", "none", or names: see `equiaffine mesh --help`.
    smoothing : float or "auto"
        The scale in voxels by which samples are smoothed; 0, the default, is none.
    constants : dict
        Numbers of names in a formula.
    orientation : {"gradient", "against"}
        Whether normals point to larger values of f or to smaller ones.
    angle, radius, distance : float
        Bounds for triangles of a Delaunay mesh: the least angle in degrees, the greatest radius of circumscribed circles,
        and the greatest distance from the surface.
    threads : int
        The greatest number of threads. The result does not depend on it.
    progress : callable
        Is called with the number of a stage, the steps that are done, and all of them.

    Returns
    -------
    Surface

    Examples
    --------
    >>> import numpy, equiaffine
    >>> x, y, z = numpy.mgrid[-1:1:24j, -1:1:24j, -1:1:24j]
    >>> ball = equiaffine.mesh(x**2 + y**2 + z**2, level=0.5, spacing=2 / 23, origin=(-1, -1, -1))
    >>> float(numpy.abs(numpy.linalg.norm(ball.V, axis=1) - 0.5**0.5).max()) < 1e-8
    True
    """
    words, given = _source(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                           direction=direction, smoothing=smoothing)
    words += _words(isovalue=level, method=method, angle=angle, radius=radius, distance=distance)
    words += ["--orientation", orientation, *_common(attributes, threads)]
    with _sentences():
        return _surface(_core.mesh(["mesh", *words, "-o", "result.ply"], given, progress))


def _surface(arrays):
    return Surface(arrays["V"], arrays["F"], arrays["columns"], arrays["status"], arrays.get("scale"))


def _fit_words(scale, noise, degree, feature_angle):
    if scale is not None and not isinstance(scale, str) and scale == 0:
        scale = "none"
    degree = None if degree is None else str(degree)
    return _words(scale=scale, noise=noise, degree=degree, feature_angle=feature_angle)


def curvatures(V, F=None, *, scale=None, noise=None, normals=None, degree=None, feature_angle=None, attributes="all",
               orientation="gradient", threads=None, progress=None):
    """Return the curvatures of a mesh at its vertices, or of points, by polynomials that are fitted around each.

    Parameters
    ----------
    V : array_like
        Vertices, (n, 3). Or a Surface, with its faces.
    F : array_like
        Triangles, (m, 3) of integers. Without them V are points.
    scale : float, optional
        The length that tells shape from detail. By default curvatures are the surface's own where the data resolve them,
        else those at the smallest scale at which half of the vertices are known to 20 %; 0 insists on the surface's own.
    noise : float
        The standard deviation of the points from the surface, a length; by default it is estimated.
    normals : array_like
        Normals of points without triangles, (n, 3).
    degree : int
        Of the polynomials: 4, 5, 6, 8 or 10; by default the data choose.
    feature_angle : float
        Edges that bend by more than this angle in degrees, 60 by default, are creases if they follow each other; 180 for
        none.
    attributes, orientation, threads, progress
        As of `mesh`. Each number NAME comes with an estimate of its error, NAME_error.

    Returns
    -------
    Surface
        With the same vertices in the same order, and `scale`.

    Examples
    --------
    >>> import equiaffine
    >>> ball = equiaffine.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=24)
    >>> found = equiaffine.curvatures(ball.V, ball.F)
    >>> error = abs(found["gaussian_curvature"] - 1)
    >>> bool((error <= found["gaussian_curvature_error"] + 1e-9).mean() > 0.9)
    True
    """
    V, F, normals = _data(V, F, normals)
    words = ["annotate", "the data.ply", *_fit_words(scale, noise, degree, feature_angle), "--orientation", orientation,
             *_common(attributes, threads), "-o", "result.ply"]
    with _sentences():
        return _surface(_core.annotate(words, _view(V, F, normals), progress))


def _data(V, F, normals=None):
    """Vertices, triangles and normals, of a Surface, too."""
    if not isinstance(V, Surface):
        return V, F, normals
    if F is not None:
        raise TypeError("F is not for a Surface, which has its own")
    if normals is None and not len(V.F) and "normal" in V:
        normals = V["normal"]
    return V.V, V.F, normals


def fit(V, F=None, *, scale=None, noise=None, normals=None, degree=None, feature_angle=None, threads=None, progress=None):
    """Return a function that is zero on the surface through the vertices of a mesh, or through points.

    Parameters are those of `curvatures`.

    Returns
    -------
    Fit

    Examples
    --------
    >>> import equiaffine
    >>> ball = equiaffine.mesh("x^2 + y^2 + z^2 = 1", box=1.2, resolution=24)
    >>> f = equiaffine.fit(ball.V, ball.F)
    >>> abs(round(float(f([[0, 0, 1.01]])[0]), 3))
    0.01
    """
    V, F, normals = _data(V, F, normals)
    words = ["annotate", "the data.ply", *_fit_words(scale, noise, degree, feature_angle), *_common("none", threads),
             "-o", "result.ply"]
    with _sentences():
        return Fit(_core.fit(words, _view(V, F, normals), progress))


def evaluate(f, points, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None,
             attributes="basic", smoothing=None, orientation="gradient", threads=None, progress=None):
    """Return the value of f at points, and the numbers of the level set through each of them.

    Parameters
    ----------
    f
        As of `mesh`; other parameters, too. A formula needs no box here.
    points : array_like
        (n, 3).

    Returns
    -------
    Values
        With the name "value" among them.

    Examples
    --------
    >>> import equiaffine
    >>> at = equiaffine.evaluate("x*y*z", [[1, 1, 1], [1, 2, 4]])
    >>> at["value"].tolist()
    [1.0, 8.0]
    """
    if isinstance(f, str) and box is None and resolution is not None:
        raise TypeError("resolution is not for a formula at points")
    words, given = _source(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                           direction=direction, smoothing=smoothing)
    words += ["--orientation", orientation, *_common(attributes, threads)]
    with _sentences():
        result = _core.evaluate(["evaluate", *words, "--points", "the points.csv", "-o", "result.csv"], given,
                                _view(points), progress)
    return Values(result["columns"], result["status"])


def _surface_to_register(a, name):
    """The words of a surface, and its data if they are in memory."""
    if isinstance(a, (str, pathlib.PurePath)):
        path = os.fspath(a)
        if isinstance(a, str) and not os.path.exists(path):
            raise ValueError(f"{name}: there is no file '{path}'")
        return [path], None
    if isinstance(a, tuple):
        return [name + ".ply"], _view(*a)
    if isinstance(a, Surface):
        return [name + ".ply"], _view(*_data(a, None))
    return [name + ".ply"], _view(a)


def register(a, b, *, kind="affine", reflection=True, tolerance=None, overlap=None, threads=None, progress=None):
    """Find the map that moves a surface, or a part of it, onto another one.

    Parameters
    ----------
    a, b : Surface, tuple, array_like or path
        The source and the target: a Surface, (V, F), points, or the path of a file.
    kind : {"affine", "equiaffine", "similarity", "rigid"}
        The maps among which one is sought.
    reflection : bool
        Whether it may change left and right.
    tolerance : float
        How far the surfaces may be apart, as a part of the size of the target; by default the data decide.
    overlap : float
        The part of one of the surfaces, at least, that is to lie on the other; 0.05 by default.
    threads, progress
        As of `mesh`.

    Returns
    -------
    Registration
        Without a map if there is no evidence for any: never a wrong one to be polite.

    Examples
    --------
    >>> import equiaffine, numpy
    >>> a = equiaffine.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=32)
    >>> shear = numpy.array([[1, 0.5, 0], [0, 1, 0], [0, 0, 1]])
    >>> found = equiaffine.register((a.V, a.F), (a.V @ shear.T, a.F))
    >>> bool(numpy.abs(found.matrix[:3, :3] - shear).max() < 1e-3)
    True
    """
    (source, source_view), (target, target_view) = _surface_to_register(a, "a"), _surface_to_register(b, "b")
    words = ["register", *source, "to", *target, "--kind", kind, *_words(tolerance=tolerance, min_overlap=overlap,
                                                                       no_reflection=not reflection)]
    words += [] if threads is None else ["--threads", str(int(threads))]
    with _sentences():
        report, summary = _core.register([*words, "-o", "result.json"], source_view, target_view, progress)
    return Registration(json.loads(report), summary.strip())


def symmetries(a, *, kind="affine", reflection=True, tolerance=None, threads=None, progress=None):
    """Find the maps of a surface onto itself.

    Parameters
    ----------
    a : Surface, tuple, array_like or path
        As of `register`.
    kind, reflection, tolerance, threads, progress
        As of `register`; the tolerance is a part of the size of the surface.

    Returns
    -------
    Symmetries

    Examples
    --------
    >>> import equiaffine, numpy
    >>> V = numpy.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    >>> F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    >>> equiaffine.symmetries((V, F), kind="rigid").order
    48
    """
    surface, view = _surface_to_register(a, "a")
    words = ["symmetries", *surface, "--kind", kind, *_words(tolerance=tolerance, no_reflection=not reflection)]
    words += [] if threads is None else ["--threads", str(int(threads))]
    with _sentences():
        report, summary = _core.symmetries([*words, "-o", "result.json"], view, progress)
    return Symmetries(json.loads(report), summary.strip())


def read(path):
    """Read a file: a Surface from .ply, .off, .obj, .stl, .csv or .xyz, and a Volume from .nrrd, .mhd, .mha, .nii,
    .nii.gz, .inr, .inr.gz or .vti."""
    path = os.fspath(path)
    with _sentences():
        if not path.lower().endswith(_VOLUMES):
            return _surface(_core.read_surface(path))
        arrays = _core.read_volume(path)
    spacing = numpy.linalg.norm(arrays["steps"], axis=1)
    return Volume(arrays["values"], spacing, arrays["origin"], (arrays["steps"] / spacing[:, None]).T)


def _whole_view(surface):
    status = None if surface.status is None else numpy.asarray(surface.status, numpy.uint8)
    columns = {name: numpy.ascontiguousarray(values, float) for name, values in surface.attributes.items()}
    return _core.Points_view(_points(surface.V, "V"), _faces(surface.F), columns, status)


def write(path, data):
    """Write a Surface or a Volume to a file in the format of its extension, whole or not at all.

    A Surface goes into .ply, .off, .obj, .stl, .csv or .vtp, of which .ply, .csv and .vtp keep its attributes; a Volume
    into .nrrd, .mhd, .mha, .nii, .nii.gz or .vti.
    """
    path = os.fspath(path)
    with _sentences():
        if isinstance(data, Volume):
            return _core.write_volume(path, _volume_view(data.values, data.spacing, data.origin, data.direction))
        return _core.write_surface(path, _whole_view(data))


def view(surface, path=None, *, color=None, up=None, range=None, colors=None, size=None):
    """Show a surface: as a page in the browser, or in a file.

    Parameters
    ----------
    surface : Surface
        What is shown.
    path : path, optional
        Of a page, .html, or a picture, .png. Without it a page is opened.
    color : str
        The attribute that is shown.
    up, range, colors, size
        The direction that is up; the numbers that have the end colors; "linear", "logarithmic" or "equalized"; and the size of a
        picture in pixels: see `equiaffine view --help`.
    """
    words = ["view", "the surface.ply", *_words(color=color, up=up, range=range, colors=colors)]
    words += [] if size is None else ["--size", *_integers(size)]
    target = path
    if path is None:
        handle, target = tempfile.mkstemp(prefix="equiaffine-", suffix=".html")
        os.close(handle)
    option = "--png" if os.fspath(target).lower().endswith(".png") else "-o"
    with _sentences():
        _core.show([*words, option, os.fspath(target)], "Surface", _whole_view(surface))
    if path is None:
        webbrowser.open(pathlib.Path(target).as_uri())


def page_of(surface):
    """Return the page of a surface as a text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "page.html"
        view(surface, path)
        return path.read_text()
