# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of the functions."""
import contextlib
import enum
import re

import numpy

_MOST_VERTICES_OF_NOTEBOOK = 200000  # larger pages slow a notebook down


class Status(enum.IntEnum):
    """Which quantities are defined at a vertex. The others are NaN."""
    REGULAR = 0
    PARABOLIC = 1    # affine quantities do not exist
    SINGULAR = 2     # the gradient is zero
    OUTSIDE = 3      # outside the domain: nothing is known of the surface
    UNCONVERGED = 4  # the vertex could not be projected onto the surface


def _irregular(status):
    """Counts of the points that are not REGULAR, as text."""
    if status is None:
        return ""
    counts = numpy.bincount(status, minlength=len(Status))
    return "".join(f", {counts[kind]} {kind.name.lower()}" for kind in Status if kind and counts[kind])


class Values:
    """Quantities at points by name, such as `values["mean_curvature"]`. Vectors such as `values["normal"]` are copies
    of shape (n, 3).

    Attributes
    ----------
    attributes : dict
        Arrays of shape (n,) by name. `NAME_error`, if present, estimates the error of NAME; it is inf if unknown.
    status : numpy.ndarray or None
        Of uint8, see `Status`.
    """

    def __init__(self, attributes, status=None):
        self.attributes = attributes
        self.status = status

    def keys(self):
        return self.attributes.keys()

    def items(self):
        return self.attributes.items()

    def get(self, name, default=None):
        return self[name] if name in self else default

    def __iter__(self):
        return iter(self.attributes)

    def __getitem__(self, name):
        if not isinstance(name, str):
            raise KeyError(name)
        if name in self.attributes:
            return self.attributes[name]
        columns = ["nx", "ny", "nz"] if name == "normal" else [f"{name}_{axis}" for axis in "xyz"]
        if all(column in self.attributes for column in columns):
            return numpy.stack([self.attributes[column] for column in columns], axis=1)
        raise KeyError(f"no attribute {name}; use one of {', '.join(self.attributes)}")

    def __contains__(self, name):
        try:
            self[name]
        except KeyError:
            return False
        return True

    def __repr__(self):
        return f"<{type(self).__name__}: {self._size()}, {len(self.attributes)} attributes>"

    def _size(self):
        return f"{len(next(iter(self.attributes.values()), ()))} points{_irregular(self.status)}"


class Surface(Values):
    """A mesh or points, with attributes of the vertices.

    Attributes
    ----------
    V : numpy.ndarray
        Vertices, (n, 3) of float64.
    F : numpy.ndarray
        Triangles, (m, 3) of int64. Those of `mesh` are counterclockwise seen from the side to which the normals point.
    attributes : dict
        Arrays of shape (n,) by name.
    status : numpy.ndarray or None
        Of uint8, see `Status`.
    scale : float or None
        The scale of the curvatures of a fit; None if they are the surface's own, or if there is no fit.
    comments : list of str
        Information about a fit, as comments of a PLY file.
    report : dict
        Diagnostics of `mesh`: "max_distance", the maximum distance of a vertex from the surface, estimated by a Newton
        step; for samples also "noise", their standard deviation, and "smoothing", the scale in voxels.
    """

    def __init__(self, V, F=None, attributes=None, status=None, scale=None, comments=(), report=None):
        super().__init__({} if attributes is None else attributes, status)
        self.V = V
        self.F = numpy.empty((0, 3), numpy.int64) if F is None else F
        self.scale = scale
        self.comments = list(comments)
        self.report = {} if report is None else report
        for comment in self.comments:
            found = re.fullmatch(r"fit scale: (\S+).*", comment, re.IGNORECASE)
            if found and scale is None:
                with contextlib.suppress(ValueError):
                    self.scale = float(found[1])

    def _size(self):
        return f"{len(self.V)} vertices, {len(self.F)} triangles{_irregular(self.status)}"

    def save(self, path):
        """Write a .ply, .off, .obj, .stl, .csv or .vtp file with all that the format can hold; see `write`.

        `read` does not read .stl and .vtp files, nor the status in a .csv file.
        """
        from ._functions import write
        write(path, self)

    def to_pyvista(self):
        """Return a `pyvista.PolyData` with all attributes as point data."""
        import pyvista
        faces = numpy.column_stack([numpy.full(len(self.F), 3), self.F]).ravel()
        result = pyvista.PolyData(self.V, faces) if len(self.F) else pyvista.PolyData(self.V)
        for name, values in self.attributes.items():
            result.point_data[name] = values
        if self.status is not None:
            result.point_data["status"] = self.status
        return result

    def to_trimesh(self):
        """Return a `trimesh.Trimesh` with all attributes as vertex attributes."""
        import trimesh
        return trimesh.Trimesh(self.V, self.F, process=False, vertex_attributes=dict(self.attributes))

    def _repr_html_(self):
        if not len(self.F) or len(self.V) > _MOST_VERTICES_OF_NOTEBOOK:
            return None
        import html

        from ._functions import page_of
        return (f'<iframe style="width:100%;height:600px;border:0" title="surface" '
                f'srcdoc="{html.escape(page_of(self))}"></iframe>')


class Volume:
    """Samples on a grid: sample (i, j, k) is at `origin + direction @ (spacing * (i, j, k))`.

    Attributes
    ----------
    values : numpy.ndarray
        Three-dimensional; NaN marks missing samples.
    spacing, origin : numpy.ndarray
        Of shape (3,).
    direction : numpy.ndarray
        A (3, 3) matrix whose columns are unit vectors along the axes of the array.
    """

    def __init__(self, values, spacing=(1, 1, 1), origin=(0, 0, 0), direction=None):
        from ._arguments import direction_of, numbers_in, spacing_of
        self.values = numpy.asarray(values)
        if self.values.ndim != 3:
            raise ValueError(f"values: give a three-dimensional array, not one of shape {self.values.shape}")
        self.spacing = spacing_of(spacing)
        self.origin = numbers_in("origin", origin, 3)
        self.direction = direction_of(direction)

    def __repr__(self):
        return f"<Volume: {' x '.join(map(str, self.values.shape))} of {self.values.dtype}>"

    def save(self, path):
        """Write a .nrrd, .mhd, .mha, .nii, .nii.gz or .vti file. Values of types other than float32 become float64."""
        from ._functions import write
        write(path, self)


class Fit:
    """A function fitted to the vertices of a mesh or to points by `fit`: zero on the surface, positive outside.

    It is NaN far from the data. It can be pickled; loading it repeats the fit.

    Attributes
    ----------
    scale : float or None
        The scale of its curvatures; None if they are the surface's own.
    """

    def __init__(self, core, arguments):
        self._core, self._arguments = core, arguments

    def __reduce__(self):
        return _fitted_again, (self._arguments,)

    @property
    def scale(self):
        return self._core.scale

    def __call__(self, points):
        """Return the values at points (n, 3)."""
        return self.evaluate(points, attributes="status")["value"]

    def evaluate(self, points, **options):
        """Return the values and attributes at points; see `evaluate`."""
        from ._functions import evaluate
        return evaluate(self, points, **options)

    def mesh(self, **options):
        """Return the surface of the fit; see `mesh`. This takes about ten seconds at the default resolution of 129."""
        from ._functions import mesh
        return mesh(self, **options)

    def __repr__(self):
        return "<Fit: the surface's own curvatures>" if self.scale is None else f"<Fit at the scale {self.scale:.4g}>"


def _fitted_again(arguments):
    from ._functions import fit
    return fit(**arguments)


def _matrix_of(mapping):
    matrix = numpy.eye(4)
    matrix[:3, :3] = mapping["matrix"]
    matrix[:3, 3] = mapping["translation"]
    return matrix


class _Findings:
    """A report of the program and its summary."""

    def __init__(self, report, summary):
        self.report = report
        self.summary = summary

    def __repr__(self):
        return f"<{type(self).__name__}: {self.summary}>"


class Registration(_Findings):
    """The map from one surface to another, or the reason why there is none. It is true if a map was found.

    Attributes
    ----------
    found : bool
        Whether a map was found.
    matrix : numpy.ndarray or None
        (4, 4); maps a point (x, y, z, 1) of the source onto the target.
    rms : float or None
        Root mean square distance of the points that agree.
    inliers : tuple or None
        The fractions of source and target that lie on the other surface.
    log10_false_alarms : float or None
        Base-10 logarithm of the expected number of maps as good as this one by chance.
    summary : str
        The result in words, or the reason why there is no map.
    report : dict
        The complete report of the program.
    """

    def __init__(self, report, summary):
        super().__init__(report, summary)
        self.found = report["found"]
        self.matrix = _matrix_of(report) if self.found else None
        self.rms = report.get("rms")
        self.inliers = tuple(report["inliers"]) if self.found else None
        self.log10_false_alarms = report.get("log10_false_alarms")

    def apply(self, points):
        """Return points of the source, (n, 3), moved onto the target."""
        if not self.found:
            raise ValueError("no map was found, so points cannot be moved: " + self.summary)
        from ._arguments import points_of
        return points_of(points, "points") @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def __bool__(self):
        return self.found


class Symmetries(_Findings):
    """The maps of a surface onto itself.

    Attributes
    ----------
    decided : bool
        Whether the number of maps could be decided.
    order : int or None
        Number of maps; None if infinite or undecided.
    matrices : numpy.ndarray or None
        (k, 4, 4), the identity first; None if undecided.
    dimension : int
        Dimension of the continuous symmetries. If it is not 0 and the order is None, `matrices` contains only the
        identity.
    summary : str
        The result in words, or the reason why it is undecided.
    report : dict
        The complete report of the program.
    """

    def __init__(self, report, summary):
        super().__init__(report, summary)
        self.decided = not report["undecided"]
        self.order = report["order"] if self.decided else None
        self.matrices = numpy.stack([_matrix_of(mapping) for mapping in report["maps"]]) if self.decided else None
        self.dimension = report["continuous"]["dimension"]
