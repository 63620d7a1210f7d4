# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# A scan with errors: which curvatures a mesh with noise has, at which scale, and how far to trust them.
# `scan.py [MESH]` takes a mesh of yours; without one the scan is an ellipsoid with noise. Pictures are left in results/.

# %%
import pathlib
import sys

import numpy as np

import equiaffine as ea

results = pathlib.Path("results")
results.mkdir(exist_ok=True)

# %%
if len(sys.argv) > 1:
    scan = ea.read(sys.argv[1])
else:
    scan = ea.mesh("x^2 + 2*y^2 + 3*z^2 = 1", box=1.1, resolution=40, attributes="none")
    scan.V += np.random.default_rng(1).normal(scale=2e-4, size=scan.V.shape)

# %%
found = ea.curvatures(scan)
scale = "the surface's own" if found.scale is None else f"at the scale {found.scale:.3g}"
print(f"{len(scan.V)} vertices, curvatures are {scale}")
for name in ("gaussian_curvature", "mean_curvature", "affine_gaussian_curvature", "affine_mean_curvature"):
    number, error = found[name], found[name + "_error"]
    known = np.mean(error < 0.2 * np.abs(number))
    print(f"{name}: median {np.nanmedian(number):.3g}, known to 20 % at {100 * known:.0f} % of the vertices")

# %%
# An ellipsoid x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 has the same K everywhere, 1 / (a b c).
if len(sys.argv) == 1:
    K = 6 ** 0.5
    error = np.abs(found["affine_gaussian_curvature"] - K)
    print(f"K is {K:.4g}: the estimate of the error covers it at "
          f"{100 * np.mean(error <= found['affine_gaussian_curvature_error']):.0f} % of the vertices")

# %%
ea.view(found, results / "scan.png", color="gaussian_curvature", size=(800, 640))
found.save(results / "scan.ply")
