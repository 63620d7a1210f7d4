# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the module."""
import json
import os
import pathlib
import tempfile
import webbrowser

import numpy

from . import _core
from ._arguments import (data_of, fit_options, given, mesh_of, path_of, places_of, registered, source_of,
                         volume_view_of, whole_mesh_of)
from ._results import Fit, Registration, Surface, Symmetries, Values, Volume

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
        The value of f on the surface, 0 by default.
    box : float or sequence of 6 floats
        xmin, xmax, ymin, ymax, zmin, zmax, or a number for a cube around the origin. A formula and a function need it;
        for a fit it is that of the data by default.
    resolution : int or sequence of 3 ints
        Nodes along each axis, 2 or more: by default 64 for a formula or a function, 129 for a fit. Samples are their
        own grid.
    method : {"marching-cubes", "delaunay"}
        How the surface is sampled.
    spacing, origin, direction : sequences of floats
        Where samples are, see `Volume`: steps of 1 from the origin along the axes by default.
    attributes : str or sequence of str
        "basic" is normal, k1, k2, gaussian_curvature, mean_curvature, conormal, affine_normal, affine_gaussian_curvature,
        affine_mean_curvature, pick_invariant, affine_normal_angle, affine_area_density, status. "all" adds affine_k1,
        affine_k2, direction1, direction2, metric. Or some of these names, also quadric_defect, shape_index, curvedness,
        vertex_area, affine_area, affine_frame1, affine_frame2, affine_frame3, affine_frame_scale, affine_frame_quality,
        affine_signature, signature; or "none".
    smoothing : float or "auto"
        The scale in voxels by which samples are smoothed, up to 100; 0, the default, is none. Integers and other
        samples with noise need it: curvatures of unsmoothed noise are noise. "auto" chooses by the noise, and
        `Surface.report` has the scale.
    constants : dict
        Numbers of names in a formula.
    orientation : {"gradient", "against"}
        Whether normals point to larger values of f or to smaller ones.
    angle : float
        Of a Delaunay mesh: the least angle of triangles in degrees, at most 30, the default.
    radius : float
        Of a Delaunay mesh: the greatest radius of surface Delaunay balls, a length; 1/50 of the box's diagonal by default.
    distance : float
        Of a Delaunay mesh: the greatest distance of a triangle's circumcenter from the center of that ball, a length;
        radius / 10 by default.
    threads : int
        The greatest number of threads, all by default. The result does not depend on it.
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
    options, source = source_of(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                                direction=direction, smoothing=smoothing)
    options.update(given(angle=angle, radius=radius, distance=distance, threads=threads), level=level, method=method,
                   attributes=attributes, orientation=orientation)
    return _surface(_core.mesh(options, source, progress))


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
        A length that tells shape from detail. By default curvatures are the surface's own where the data resolve them,
        else those at the smallest scale at which half of the vertices are known to 20 %; 0 insists on the surface's own.
    noise : float or "auto"
        The standard deviation of the points from the surface, a length; by default it is estimated.
    normals : array_like
        Normals of points without triangles, (n, 3).
    degree : int or "auto"
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
    options = fit_options(scale, noise, degree, feature_angle, threads)
    options.update(attributes=attributes, orientation=orientation)
    surface = _surface(_core.annotate(options, mesh_of(V, F, normals), progress))
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
    core = _core.fit(fit_options(scale, noise, degree, feature_angle, threads), mesh_of(V, F, normals), progress)
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
    options, source = source_of(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                                direction=direction, smoothing=smoothing)
    options.update(given(threads=threads), attributes=attributes, orientation=orientation)
    result = _core.evaluate(options, source, places_of(points), progress)
    return Values(result["columns"], result["status"])


def register(a, b, *, kind="affine", reflections=True, tolerance=None, min_overlap=None, number_of_maps=None,
             scale=None, threads=None, progress=None):
    """Find the map that moves a surface, or a part of it, onto another one.

    Parameters
    ----------
    a, b : Surface, tuple, array_like or path
        The source and the target: a Surface, (V, F), (V, F, normals), points, or the path of a mesh or of points.
    kind : {"affine", "equiaffine", "similarity", "rigid"}
        The maps among which one is sought.
    reflections : bool
        Whether it may change left and right.
    tolerance : float
        The largest rms distance of moved points from the target, a part of its size below 0.1; by default what noise
        and facets explain.
    min_overlap : float
        The part of one of the surfaces, at least, that must lie on the other; 0.05 by default.
    number_of_maps : int
        The greatest number of maps with evidence, as `report["maps"]` has them. By default the best one alone is sought.
    scale : float, "auto" or "none", optional
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
    (options, source), (options_of_target, target) = registered(a, "a", scale), registered(b, "b", scale)
    options.update(given(tolerance=tolerance, min_overlap=min_overlap, number_of_maps=number_of_maps, threads=threads),
                   kind=kind, reflections=reflections)
    report, summary = _core.register(options, source, options_of_target, target, progress)
    return Registration(json.loads(report), summary.strip())


def symmetries(a, *, kind="affine", reflections=True, tolerance=None, scale=None, threads=None, progress=None):
    """Find the maps of a surface onto itself.

    Parameters
    ----------
    a : Surface, tuple, array_like or path
        As of `register`.
    kind, reflections, tolerance, scale, threads, progress
        As of `register`. The tolerance is a part of the size of the surface: by default 1e-3 for points, and 0.01 for a
        mesh, of which the first group of symmetries counts.

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
    options, surface = registered(a, "a", scale)
    options.update(given(tolerance=tolerance, threads=threads), kind=kind, reflections=reflections)
    report, summary = _core.symmetries(options, surface, progress)
    return Symmetries(json.loads(report), summary.strip())


def read(path):
    """Read a file: a Surface from .ply, .off, .obj, .stl, .csv or .xyz, and a Volume from .nrrd, .mhd, .mha, .nii,
    .nii.gz, .inr, .inr.gz, .vti or .dcm."""
    path, text = path_of(path)
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
        The axis that is up; by default the shape decides.
    range : pair of floats
        The numbers that have the end colors, by default quantiles.
    colors : {"linear", "logarithmic", "equalized", "auto"}
        How numbers become colors; by default the numbers decide.
    size : pair of ints
        Width and height of a picture in pixels, 1000 and 800 by default.
    """
    options = given(color=color, up=up, range=range, colors=colors, size=size)
    mesh_to_show = whole_mesh_of(surface)
    if path is not None:
        return _show(options, mesh_to_show, path)
    handle, target = tempfile.mkstemp(prefix="equiaffine-", suffix=".html")
    os.close(handle)
    try:
        _show(options, mesh_to_show, target)
    except BaseException:
        os.unlink(target)
        raise
    webbrowser.open(pathlib.Path(target).as_uri())


def _show(options, mesh_to_show, path):
    path, text = path_of(path)
    output = "png" if text.lower().endswith(".png") else "output"
    _core.show({"MESH.ply": "surface.ply", output: path, **options}, mesh_to_show)


def page_of(surface):
    """Return the page of a surface as a text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "page.html"
        view(surface, path)
        return path.read_text(encoding="utf-8")
