# SPDX-License-Identifier: GPL-3.0-or-later
"""Equi-affine and Euclidean curvatures of implicit surfaces, meshes, points and volumes, on numpy arrays.

>>> import equiaffine as ea
>>> ball = ea.mesh("x^2 + y^2 + z^2 = r^2", constants={"r": 2}, box=2.5)
>>> ball.V.shape[1], ball.F.shape[1]
(3, 3)
>>> round(float(ball["affine_gaussian_curvature"].mean()), 9)  # r^-3
0.125

- `mesh` extracts a level set of a formula, a volume, a function or a fit.
- `curvatures` estimates the curvatures of a mesh or of points; `fit` returns a function fitted to them.
- `evaluate` computes values and curvatures at given points.
- `register` finds the affine map between two surfaces, `symmetries` the maps of a surface onto itself.
- `read` and `write` handle files; `view` shows a surface.

An invalid argument raises a `ValueError` that explains the mistake. Long computations release the GIL, can be
interrupted with Ctrl-C, and call their argument `progress` as `progress(stage, done, total)`.
"""
import atexit as _atexit

from ._core import interpreter_ends as _interpreter_ends
from ._core import version as __version__
from ._functions import curvatures, evaluate, fit, mesh, read, register, symmetries, view, write
from ._results import Fit, Registration, Status, Surface, Symmetries, Values, Volume

__all__ = ["Fit", "Registration", "Status", "Surface", "Symmetries", "Values", "Volume", "curvatures", "evaluate", "fit",
           "mesh", "read", "register", "symmetries", "view", "write"]

_atexit.register(_interpreter_ends)
