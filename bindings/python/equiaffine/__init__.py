# SPDX-License-Identifier: GPL-3.0-or-later
"""Equi-affine and Euclidean curvatures of implicit surfaces, meshes, points and volumes, on numpy arrays.

>>> import equiaffine as ea
>>> ball = ea.mesh("x^2 + y^2 + z^2 = r^2", constants={"r": 2}, box=2.5)
>>> ball.V.shape[1], ball.F.shape[1]
(3, 3)
>>> round(float(ball["affine_gaussian_curvature"].mean()), 9)  # r^-3
0.125

`mesh` makes the surface of a formula, a volume, a function or a fit; `curvatures` are those of a mesh or of points; `fit`
makes a function of them; `evaluate` has the numbers at points; `register` finds the affine map between two surfaces,
`symmetries` those of one. `read` and `write` know files, `view` shows a surface.

What is wrong with an argument is a `ValueError` with a sentence. Long functions let other threads run, and Ctrl-C ends
them. Their argument `progress` is a function of the number of a stage, the steps of it that are done, and all of them.
"""
import atexit as _atexit

from ._core import interpreter_ends as _interpreter_ends
from ._core import version as __version__
from ._functions import curvatures, evaluate, fit, mesh, read, register, symmetries, view, write
from ._results import Fit, Registration, Status, Surface, Symmetries, Values, Volume

__all__ = ["Fit", "Registration", "Status", "Surface", "Symmetries", "Values", "Volume", "curvatures", "evaluate", "fit",
           "mesh", "read", "register", "symmetries", "view", "write"]

_atexit.register(_interpreter_ends)
