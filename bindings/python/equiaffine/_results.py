# SPDX-License-Identifier: GPL-3.0-or-later
"""What functions return."""
import contextlib
import enum
import re

import numpy

_MOST_VERTICES_OF_NOTEBOOK = 200000  # a page of more would be too large for a cell


class Status(enum.IntEnum):
    """What is known at a vertex: numbers are NaN where they do not exist."""
    REGULAR = 0
    PARABOLIC = 1    # affine quantities do not exist
    SINGULAR = 2     # the gradient is zero
    OUTSIDE = 3      # nothing is known of the surface
    UNCONVERGED = 4  # the vertex could not be put onto the surface


def _irregular(status):
    """How many points have another status than REGULAR, in words."""
    if status is None:
        return ""
    counts = numpy.bincount(status, minlength=len(Status))
    return "".join(f", {counts[kind]} {kind.name.lower()}" for kind in Status if kind and counts[kind])


class Values:
    """Numbers at points by name, such as `values["mean_curvature"]`; vectors, as `values["normal"]`, are copies, (n, 3).

    Attributes
    ----------
    attributes : dict
        Arrays of shape (n,) by name. `NAME_error` is an estimate of the error of NAME, where there is one: inf where
        nothing is known of it.
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
        raise KeyError(f"{name}: there are {', '.join(self.attributes)}")

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
    """A mesh, or points, with numbers at its vertices.

    Attributes
    ----------
    V : numpy.ndarray
        Vertices, (n, 3) of float64.
    F : numpy.ndarray
        Triangles, (m, 3) of int64. Those that `mesh` makes are counterclockwise seen from the side to which normals point.
    attributes : dict
        Arrays of shape (n,) by name.
    status : numpy.ndarray or None
        Of uint8, see `Status`.
    scale : float or None
        The scale of curvatures of a fit; None if they are the surface's own, or not of a fit.
    comments : list of str
        What is known of a fit, as lines of a PLY file.
    report : dict
        What `mesh` found out: "max_distance", the greatest distance of a vertex from the surface as Newton's method sees it;
        of samples "noise", their standard deviation, and "smoothing", the scale in voxels.
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
        """Write a .ply, .off, .obj, .stl, .csv or .vtp file with all that the format can hold, whole or not at all.

        Of these, .stl and .vtp are not read back, and .csv without the status.
        """
        from ._functions import write
        write(path, self)

    def to_pyvista(self):
        """Return a `pyvista.PolyData` with all attributes as arrays of points."""
        import pyvista
        faces = numpy.column_stack([numpy.full(len(self.F), 3), self.F]).ravel()
        result = pyvista.PolyData(self.V, faces) if len(self.F) else pyvista.PolyData(self.V)
        for name, values in self.attributes.items():
            result.point_data[name] = values
        if self.status is not None:
            result.point_data["status"] = self.status
        return result

    def to_trimesh(self):
        """Return a `trimesh.Trimesh` with all attributes as attributes of vertices."""
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
    """Samples on a grid: that with the index i, j, k is at `origin + direction @ (spacing * (i, j, k))`.

    Attributes
    ----------
    values : numpy.ndarray
        Of three dimensions; NaN means no sample.
    spacing, origin : numpy.ndarray
        Of shape (3,).
    direction : numpy.ndarray
        Unit vectors along the axes of the array in the columns of a (3, 3) matrix.
    """

    def __init__(self, values, spacing=(1, 1, 1), origin=(0, 0, 0), direction=None):
        from ._arguments import direction_of, numbers_in, spacing_of
        self.values = numpy.asarray(values)
        if self.values.ndim != 3:
            raise ValueError(f"values: give an array of three dimensions, and not of the shape {self.values.shape}")
        self.spacing = spacing_of(spacing)
        self.origin = numbers_in("origin", origin, 3)
        self.direction = direction_of(direction)

    def __repr__(self):
        return f"<Volume: {' x '.join(map(str, self.values.shape))} of {self.values.dtype}>"

    def save(self, path):
        """Write a .nrrd, .mhd, .mha, .nii, .nii.gz or .vti file: float32 as it is, other types as float64."""
        from ._functions import write
        write(path, self)


class Fit:
    """A function that is fitted to the vertices of a mesh or to points: zero on the surface, positive outside.

    It is known near the data; elsewhere it is NaN. `fit` makes it. It can be pickled: what is loaded is fitted again.

    Attributes
    ----------
    scale : float or None
        The scale of its curvatures, None if they are the surface's own.
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
        """Return the numbers at points: see `evaluate`."""
        from ._functions import evaluate
        return evaluate(self, points, **options)

    def mesh(self, **options):
        """Return the surface of the fit: see `mesh`. With the resolution 129, the default, it takes some ten seconds."""
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
    """What the program reports, and what it says of it."""

    def __init__(self, report, summary):
        self.report = report
        self.summary = summary

    def __repr__(self):
        return f"<{type(self).__name__}: {self.summary}>"


class Registration(_Findings):
    """The map from a surface to another one, or why there is none. It is true if there is one.

    Attributes
    ----------
    found : bool
        Whether there is a map.
    matrix : numpy.ndarray or None
        (4, 4), which moves a point (x, y, z, 1) of the source onto the target.
    rms : float or None
        The root of the mean squared distance of the points that agree.
    inliers : tuple or None
        The parts of source and target that lie on the other surface.
    log10_false_alarms : float or None
        The logarithm of the number of maps as good as this one that chance would make.
    summary : str
        What the program says, and why there is no map.
    report : dict
        All that the program writes.
    """

    def __init__(self, report, summary):
        super().__init__(report, summary)
        self.found = report["found"]
        self.matrix = _matrix_of(report) if self.found else None
        self.rms = report.get("rms")
        self.inliers = tuple(report["inliers"]) if self.found else None
        self.log10_false_alarms = report.get("log10_false_alarms")

    def apply(self, points):
        """Return points of the source (n, 3) moved onto the target."""
        if not self.found:
            raise ValueError("there is no map: " + self.summary)
        from ._arguments import points_of
        return points_of(points, "points") @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def __bool__(self):
        return self.found


class Symmetries(_Findings):
    """The maps of a surface onto itself.

    Attributes
    ----------
    decided : bool
        Whether it is known how many there are.
    order : int or None
        Their number, None if there are infinitely many or if it is not decided.
    matrices : numpy.ndarray or None
        (k, 4, 4), the identity first; None if it is not decided.
    dimension : int
        In how many ways the surface slides over itself. If it is not 0 and the order is None, `matrices` has the identity alone.
    summary : str
        What the program says, and why it is not decided.
    report : dict
        All that the program writes.
    """

    def __init__(self, report, summary):
        super().__init__(report, summary)
        self.decided = not report["undecided"]
        self.order = report["order"] if self.decided else None
        self.matrices = numpy.stack([_matrix_of(mapping) for mapping in report["maps"]]) if self.decided else None
        self.dimension = report["continuous"]["dimension"]
