# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas of surfaces that several items use, each with a box that is not bisected by a plane of symmetry."""

BLOBBY = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6"
BLOBBY_BOX = [-0.93, 0.95, -0.95, 0.93, -0.94, 0.95]

TORUS = "(sqrt(x^2+y^2) - 0.5)^2 + z^2 - 0.2^2"
TORUS_BOX = [-0.77, 0.75, -0.75, 0.77, -0.26, 0.25]

BANANA = "(sqrt(x^2+y^2) - 1)^2 + z^2 - 0.09*(1 - (atan2(y,x)/1.2)^2)"
BANANA_BOX = [0.2, 1.37, -1.19, 1.2, -0.35, 0.36]
