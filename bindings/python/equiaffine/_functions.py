# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the module."""
import json
import os
import pathlib
import tempfile
import webbrowser

import numpy

from . import _core
from ._arguments import (choice_of, common_words, data_of, fit_words, integer_of, mesh_of, number_word, numbers_in,
                         numbers_of, path_of, places_of, progress_of, registered, source_of, thread_words, volume_view_of,
                         whole_mesh_of)
from ._results import Fit, Registration, Surface, Symmetries, Values, Volume
from ._sentences import here, sentences

_VOLUMES = (".nrrd", ".nhdr", ".mhd", ".mha", ".nii", ".nii.gz", ".inr", ".inr.gz", ".vti", ".dcm")


def _surface(arrays):
    return Surface(arrays["V"], arrays["F"], arrays["columns"], arrays["status"], arrays["scale"], arrays["comments"],
                   arrays.get("report"))


def mesh(f, *, level=0, box=None, resolution=None, method="marching-cubes", spacing=None, origin=None, direction=None,
         attributes="basic", smoothing=None, constants=None, orientation="gradient", angle=None, radius=None, distance=None,
         threads=None, progress=None):
    """Return the level set f = level with its curvatures.

    Parameters
    ----------
    f : str, numpy.ndarray, Volume, callable or Fit
        A formula in x, y, z; samples in an array of three dimensions, which must not change during the call; a function,
        which is called for each x of the grid with arrays x, y, z of the other two axes, and returns a number for each
        point; or a fit. Derivatives of samples are those of a spline. NaN means no sample: nothing is known within 7 voxels
        of it, and of what smoothing reaches, so that vertices there are OUTSIDE.
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
        "basic" is normal, k1, k2, gaussian_curvature, mean_curvature, conormal, affine_normal, affine_gaussian_curvature,
        affine_mean_curvature, pick_invariant, affine_normal_angle, affine_area_density, status. "all" adds affine_k1,
        affine_k2, direction1, direction2, metric. Or some of these names, also quadric_defect, shape_index, curvedness,
        affine_frame1, affine_frame2, affine_frame3, affine_frame_scale, affine_frame_quality, affine_signature, signature;
        or "none".
    smoothing : float or "auto"
        The scale in voxels by which samples are smoothed; 0, the default, is none. Integers and other samples with noise
        need it: curvatures of unsmoothed noise are noise. "auto" chooses by the noise; `Surface.report` says what.
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
        Is called some twenty times a second with the number of a stage, the steps that are done, and all of them, which
        are 0 where their number is not known. An exception that it raises ends the work.

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
    words, given = source_of(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                           direction=direction, smoothing=smoothing)
    words += ["--isovalue", number_word("level", level)]
    words += ["--method", choice_of("method", method, "marching-cubes", "delaunay")]
    words += numbers_of(angle=angle, radius=radius, distance=distance)
    words += common_words(attributes, threads, orientation)
    with sentences():
        return _surface(_core.mesh(["mesh", *words, "-o", "result.ply"], given, progress_of(progress)))


def curvatures(V, F=None, *, scale=None, noise=None, normals=None, degree=None, feature_angle=None, attributes="all",
               orientation="gradient", threads=None, progress=None):
    """Return the curvatures of a mesh at its vertices, or of points, by polynomials that are fitted around each.

    Parameters
    ----------
    V : array_like
        Vertices, (n, 3). Or a Surface, with its faces.
    F : array_like
        Triangles, (m, 3) of integers. Without them V are points.
    scale : float, "auto" or "none", optional
        The length that tells shape from detail. By default curvatures are the surface's own where the data resolve them,
        else those at the smallest scale at which half of the vertices are known to 20 %; 0 insists on the surface's own.
    noise : float or "auto"
        The standard deviation of the points from the surface, a length; by default it is estimated.
    normals : array_like
        Normals of points without triangles, (n, 3).
    degree : int
        Of the polynomials: 4, 5, 6, 8 or 10; by default the data choose.
    feature_angle : float
        Edges that bend by more than this angle in degrees, 60 by default, are creases if they follow each other; 180 for
        none.
    orientation : {"gradient", "against"}
        Whether normals are those of the data or the opposite ones. Triangles stay as they are.
    attributes, threads, progress
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
    V, F, normals = data_of(V, F, normals)
    words = ["annotate", "V", *fit_words(scale, noise, degree, feature_angle),
             *common_words(attributes, threads, orientation), "-o", "result.ply"]
    with sentences():
        surface = _surface(_core.annotate(words, mesh_of(V, F, normals), progress_of(progress)))
    names = surface.attributes.keys()
    for error in [name for name in names if name.endswith("_error")]:
        if error[:-6] not in surface and error[:-6] not in names:
            del surface.attributes[error]
    return surface


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
    V, F, normals = data_of(V, F, normals)
    words = ["annotate", "V", *fit_words(scale, noise, degree, feature_angle), *common_words("none", threads),
             "-o", "result.ply"]
    with sentences():
        core = _core.fit(words, mesh_of(V, F, normals), progress_of(progress))
    copy = lambda array: None if array is None else numpy.array(array)
    return Fit(core, dict(V=copy(V), F=copy(F), scale=scale, noise=noise, normals=copy(normals), degree=degree,
                          feature_angle=feature_angle))


def evaluate(f, points, *, constants=None, box=None, resolution=None, spacing=None, origin=None, direction=None,
             attributes="basic", smoothing=None, orientation="gradient", threads=None, progress=None):
    """Return the value of f at points, and the numbers of the level set through each of them.

    Parameters
    ----------
    f
        As of `mesh`; other parameters, too. Box and resolution are for a function alone.
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
    if isinstance(f, (str, Fit)) and (box is not None or resolution is not None):
        raise TypeError("box and resolution are for a function that is sampled")
    words, given = source_of(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                           direction=direction, smoothing=smoothing)
    words += common_words(attributes, threads, orientation)
    with sentences():
        result = _core.evaluate(["evaluate", *words, "--points", "points.csv", "-o", "result.csv"], given,
                                places_of(points), progress_of(progress))
    return Values(result["columns"], result["status"])


def _map_words(kind, reflection, tolerance):
    if not isinstance(reflection, (bool, numpy.bool_)):
        raise ValueError(f"reflection: give True or False, and not {reflection!r}")
    words = ["--kind", choice_of("kind", kind, "affine", "equiaffine", "similarity", "rigid")]
    return words + ([] if reflection else ["--no-reflection"]) + numbers_of(tolerance=tolerance)


def register(a, b, *, kind="affine", reflection=True, tolerance=None, overlap=None, scale=None, threads=None, progress=None):
    """Find the map that moves a surface, or a part of it, onto another one.

    Parameters
    ----------
    a, b : Surface, tuple, array_like or path
        The source and the target: a Surface, (V, F), (V, F, normals), points, or the path of a mesh or of points.
    kind : {"affine", "equiaffine", "similarity", "rigid"}
        The maps among which one is sought.
    reflection : bool
        Whether it may change left and right.
    tolerance : float
        How far the surfaces may be apart, as a part of the size of the target; by default the data decide.
    overlap : float
        The part of one of the surfaces, at least, that is to lie on the other; 0.05 by default.
    scale : float, optional
        The length that tells shape from detail on both sides, as of `curvatures`.
    threads, progress
        As of `mesh`.

    Returns
    -------
    Registration
        Without a map if there is no evidence for any.

    Examples
    --------
    >>> import equiaffine, numpy
    >>> a = equiaffine.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z = 1", box=1.5, resolution=32)
    >>> shear = numpy.array([[1, 0.5, 0], [0, 1, 0], [0, 0, 1]])
    >>> found = equiaffine.register((a.V, a.F), (a.V @ shear.T, a.F))
    >>> bool(numpy.abs(found.matrix[:3, :3] - shear).max() < 1e-3)
    True
    """
    (source, source_data), (target, target_data) = registered(a, "a"), registered(b, "b")
    at_scale = fit_words(scale)
    words = ["register", *source, *at_scale, "to", *target, *at_scale, *_map_words(kind, reflection, tolerance),
             *thread_words(threads)]
    words += [] if overlap is None else ["--min-overlap", number_word("overlap", overlap)]
    with sentences():
        report, summary = _core.register([*words, "-o", "result.json"], source_data, target_data, progress_of(progress))
    return Registration(json.loads(report), here(summary.strip()))


def symmetries(a, *, kind="affine", reflection=True, tolerance=None, scale=None, threads=None, progress=None):
    """Find the maps of a surface onto itself.

    Parameters
    ----------
    a : Surface, tuple, array_like or path
        As of `register`.
    kind, reflection, tolerance, scale, threads, progress
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
    surface, data = registered(a, "a")
    words = ["symmetries", *surface, *fit_words(scale), *_map_words(kind, reflection, tolerance), *thread_words(threads)]
    with sentences():
        report, summary = _core.symmetries([*words, "-o", "result.json"], data, progress_of(progress))
    return Symmetries(json.loads(report), here(summary.strip()))


def read(path):
    """Read a file: a Surface from .ply, .off, .obj, .stl, .csv or .xyz, and a Volume from .nrrd, .mhd, .mha, .nii,
    .nii.gz, .inr, .inr.gz, .vti or .dcm."""
    path, text = path_of(path)
    with sentences():
        if not text.lower().endswith(_VOLUMES):
            return _surface(_core.read_surface(path))
        arrays = _core.read_volume(path)
    spacing = numpy.linalg.norm(arrays["steps"], axis=1)
    return Volume(arrays["values"], spacing, arrays["origin"], (arrays["steps"] / spacing[:, None]).T)


def write(path, data):
    """Write a Surface, (V, F) or a Volume to a file in the format of its extension, whole or not at all.

    A Surface goes into .ply, .off, .obj, .stl, .csv or .vtp, of which .ply, .csv and .vtp keep its attributes; a Volume
    into .nrrd, .mhd, .mha, .nii, .nii.gz or .vti.
    """
    path, _ = path_of(path)
    with sentences():
        if isinstance(data, Volume):
            return _core.write_volume(path, volume_view_of(data.values, data.spacing, data.origin, data.direction, "values"))
        return _core.write_surface(path, whole_mesh_of(data))


def view(surface, path=None, *, color=None, up=None, range=None, colors=None, size=None):
    """Show a surface: as a page in the browser, or in a file.

    Parameters
    ----------
    surface : Surface or tuple
        What is shown: a Surface or (V, F), with triangles.
    path : path, optional
        Of a page, .html, or a picture, .png. Without it a page is opened, whose file stays among the temporary ones.
    color : str
        The attribute that is shown, a component of a vector such as "nx", "status", or "plain" for none.
    up : {"x", "y", "z", "auto"}
        The axis that is up.
    range : pair of floats
        The numbers that have the end colors.
    colors : {"linear", "logarithmic", "equalized", "auto"}
        How numbers become colors.
    size : pair of ints
        Width and height of a picture in pixels.
    """
    words = [] if color is None else ["--color", str(color)]
    words += [] if up is None else ["--up", choice_of("up", up, "x", "y", "z", "auto")]
    words += [] if colors is None else ["--colors", choice_of("colors", colors, "linear", "logarithmic", "equalized", "auto")]
    if range is not None:
        words += ["--range", *map(repr, numbers_in("range", range, 2).tolist())]
    if size is not None:
        if numpy.shape(size) != (2,):
            raise ValueError(f"size: give two whole numbers, and not {size!r}")
        words += ["--size", *(integer_of("size", number) for number in size)]
    mesh_to_show = whole_mesh_of(surface)
    if path is not None:
        return _show(words, mesh_to_show, path)
    handle, target = tempfile.mkstemp(prefix="equiaffine-", suffix=".html")
    os.close(handle)
    try:
        _show(words, mesh_to_show, target)
    except BaseException:
        os.unlink(target)
        raise
    webbrowser.open(pathlib.Path(target).as_uri())


def _show(words, mesh_to_show, path):
    path, text = path_of(path)
    option = "--png" if text.lower().endswith(".png") else "-o"
    with sentences():
        _core.show(["view", "surface.ply", *words, option, path], mesh_to_show)


def page_of(surface):
    """Return the page of a surface as a text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "page.html"
        view(surface, path)
        return path.read_text(encoding="utf-8")
