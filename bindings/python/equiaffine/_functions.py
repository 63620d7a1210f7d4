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
        One of:

        - a formula in x, y, z;
        - samples: a three-dimensional array, which must not change during the call. Derivatives are those of a spline.
          NaN marks missing samples. Vertices within 7 voxels of one, plus the reach of smoothing, are OUTSIDE;
        - a function. It is called once for each x of the grid, with arrays x, y, z that cover the other two axes, and
          returns one number per point;
        - a fit.
    level : float
        Value of f on the surface, 0 by default.
    box : float or sequence of 6 floats
        xmin, xmax, ymin, ymax, zmin, zmax, or a number for a cube around the origin. Required for a formula or a
        function; a fit defaults to the box of its data.
    resolution : int or sequence of 3 ints
        Nodes along each axis, at least 2; by default 64 for a formula or a function, 129 for a fit. Not for samples,
        which have their own grid.
    method : {"marching-cubes", "delaunay"}
        How the surface is meshed.
    spacing, origin, direction : sequences of floats
        Placement of samples, see `Volume`; by default steps of 1 along the axes, starting at the origin.
    attributes : str or sequence of str
        "basic": normal, k1, k2, gaussian_curvature, mean_curvature, conormal, affine_normal, affine_gaussian_curvature,
        affine_mean_curvature, pick_invariant, affine_normal_angle, affine_area_density, status. "all" adds affine_k1,
        affine_k2, direction1, direction2, metric. "none": no attributes. Or a list of these names, and of
        quadric_defect, shape_index, curvedness, vertex_area, affine_area, affine_frame1, affine_frame2, affine_frame3,
        affine_frame_scale, affine_frame_quality, affine_signature, signature.
    smoothing : float or "auto"
        Scale of the smoothing of samples in voxels, up to 100; 0, the default, means none. Use it for integers and
        noisy samples, whose curvatures are otherwise dominated by noise. "auto" estimates the scale from the noise;
        `Surface.report` contains it.
    constants : dict
        Values of the constants in a formula, by name.
    orientation : {"gradient", "against"}
        Whether normals point toward larger or smaller values of f.
    angle : float
        Delaunay meshes: lower bound on the angles of triangles in degrees, at most 30, which is the default.
    radius : float
        Delaunay meshes: upper bound on the radii of surface Delaunay balls, a length; by default 1/50 of the box's
        diagonal.
    distance : float
        Delaunay meshes: upper bound on the distance between a triangle's circumcenter and the center of its surface
        Delaunay ball, a length; by default radius / 10.
    threads : int
        Maximum number of threads, all by default. The result does not depend on it.
    progress : callable
        Called as `progress(stage, done, total)` about twenty times a second, with the number of the stage and its
        finished and total steps; `total` is 0 if unknown. An exception that it raises ends the computation.

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
    """Return the curvatures at the vertices of a mesh, or at points, from polynomials fitted around each of them.

    Parameters
    ----------
    V : array_like
        Vertices, (n, 3), or a Surface, whose faces are used.
    F : array_like
        Triangles, (m, 3) integers. Without them, V is a set of points.
    scale : float, "auto" or "none", optional
        Length below which features count as detail. By default curvatures are the surface's own if the data resolve
        them, otherwise those at the smallest scale at which half of the vertices are known to 20 %. "none" or 0 always
        returns the surface's own.
    noise : float or "auto"
        Standard deviation of the points from the surface, a length; estimated by default.
    normals : array_like
        Normals of points without triangles, (n, 3).
    degree : int or "auto"
        Degree of the polynomials: 4, 5, 6, 8 or 10; chosen from the data by default.
    feature_angle : float
        Chains of edges whose dihedral angle deviates from flat by more than this angle are creases; in degrees, 60 by
        default, 180 for no creases.
    orientation : {"gradient", "against"}
        Whether to keep or to flip the normals of the data. Triangles stay as they are.
    attributes, threads, progress
        See `mesh`. Each quantity NAME has an estimate of its error, NAME_error.

    Returns
    -------
    Surface
        The same vertices in the same order, with `scale`.

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
    """Return a function that vanishes on the surface through the vertices of a mesh or through points.

    The parameters are those of `curvatures`.

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
    """Return the values of f at points, and the attributes of the level set through each point.

    The other parameters are those of `mesh`; `box` and `resolution` apply only to a function.

    Parameters
    ----------
    f
        See `mesh`.
    points : array_like
        (n, 3).

    Returns
    -------
    Values
        The attributes, and "value".

    Examples
    --------
    >>> import equiaffine
    >>> at = equiaffine.evaluate("x*y*z", [[1, 1, 1], [1, 2, 4]])
    >>> at["value"].tolist()
    [1.0, 8.0]
    """
    if isinstance(f, (str, Fit)) and (box is not None or resolution is not None):
        raise TypeError("box, resolution: apply only to a function; leave them out for a formula or a Fit")
    options, source = source_of(f, constants=constants, box=box, resolution=resolution, spacing=spacing, origin=origin,
                                direction=direction, smoothing=smoothing)
    options.update(given(threads=threads), attributes=attributes, orientation=orientation)
    result = _core.evaluate(options, source, places_of(points), progress)
    return Values(result["columns"], result["status"])


def register(a, b, *, kind="affine", reflections=True, tolerance=None, min_overlap=None, number_of_maps=None,
             scale=None, threads=None, progress=None):
    """Find the map that moves a surface, or a part of it, onto another surface.

    Parameters
    ----------
    a, b : Surface, tuple, array_like or path
        Source and target: a Surface, (V, F), (V, F, normals), points, or the path of a file of a mesh or points.
    kind : {"affine", "equiaffine", "similarity", "rigid"}
        The group of maps to search.
    reflections : bool
        Whether the map may be orientation-reversing.
    tolerance : float
        Maximum rms distance of moved points from the target as a fraction of its size, below 0.1; by default what
        noise and facets explain.
    min_overlap : float
        Minimum fraction of one of the surfaces that must lie on the other; 0.05 by default.
    number_of_maps : int
        Maximum number of maps with evidence in `report["maps"]`. By default only the best one is sought.
    scale : float, "auto" or "none", optional
        Length below which features count as detail on both surfaces, see `curvatures`.
    threads, progress
        See `mesh`.

    Returns
    -------
    Registration
        Has no map if there is no evidence for one.

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
        See `register`.
    kind, reflections, tolerance, scale, threads, progress
        See `register`. The tolerance is a fraction of the size of the surface, by default 1e-3 for points; a mesh has
        by default the first group of symmetries found within 0.01.

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
    """Read a Surface from .ply, .off, .obj, .stl, .csv or .xyz, or a Volume from .nrrd, .mhd, .mha, .nii, .nii.gz,
    .inr, .inr.gz, .vti or .dcm."""
    path, text = path_of(path)
    if not text.lower().endswith(_VOLUMES):
        return _surface(_core.read_surface(path))
    arrays = _core.read_volume(path)
    spacing = numpy.linalg.norm(arrays["steps"], axis=1)
    return Volume(arrays["values"], spacing, arrays["origin"], (arrays["steps"] / spacing[:, None]).T)


def write(path, data):
    """Write a Surface, (V, F) or a Volume in the format of the file's extension. An error leaves no partial file.

    A Surface is written as .ply, .off, .obj, .stl, .csv or .vtp; .ply, .csv and .vtp keep its attributes. A Volume is
    written as .nrrd, .mhd, .mha, .nii, .nii.gz or .vti.
    """
    path, _ = path_of(path)
    if isinstance(data, Volume):
        return _core.write_volume(path, volume_view_of(data.values, data.spacing, data.origin, data.direction, "values"))
    return _core.write_surface(path, whole_mesh_of(data))


def view(surface, path=None, *, color=None, up=None, range=None, colors=None, size=None):
    """Show a surface in the browser, or write a page or a picture of it.

    Parameters
    ----------
    surface : Surface or tuple
        A Surface or (V, F), with triangles.
    path : path, optional
        File of a page, .html, or of a picture, .png. By default a temporary page is opened in the browser; its file is
        not removed.
    color : str
        The attribute to show, a component of a vector such as "nx", "status", or "plain" for none.
    up : {"x", "y", "z", "auto"}
        The axis that points up; chosen from the shape by default.
    range : pair of floats
        The values at the ends of the color bar; quantiles by default.
    colors : {"linear", "logarithmic", "equalized", "auto"}
        The map from values to colors; chosen from the values by default.
    size : pair of ints
        Width and height of a picture in pixels; 1000 and 800 by default.
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
    """Return the page of a surface as a string."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "page.html"
        view(surface, path)
        return path.read_text(encoding="utf-8")
