# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# Estimates the curvatures of a noisy mesh, with their scale and their errors.
# `scan.py [MESH]` reads your mesh; by default the scan is an ellipsoid with noise. Writes its results to results/.

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
scale = "of the surface itself" if found.scale is None else f"at the scale {found.scale:.3g}"
print(f"{len(scan.V)} vertices, curvatures {scale}")
for name in ("gaussian_curvature", "mean_curvature", "affine_gaussian_curvature", "affine_mean_curvature"):
    number, error = found[name], found[name + "_error"]
    known = np.mean(error < 0.2 * np.abs(number))
    print(f"{name}: median {np.nanmedian(number):.3g}, known to 20 % at {100 * known:.0f} % of the vertices")

# %%
# On the ellipsoid x^2/a^2 + y^2/b^2 + z^2/c^2 = 1, K is constant, 1 / (a b c).
if len(sys.argv) == 1:
    K = 6 ** 0.5
    error = np.abs(found["affine_gaussian_curvature"] - K)
    print(f"K is within the estimated error of its true value {K:.4g} at "
          f"{100 * np.mean(error <= found['affine_gaussian_curvature_error']):.0f} % of the vertices")

# %%
ea.view(found, results / "scan.png", color="gaussian_curvature", size=(800, 640))
found.save(results / "scan.ply")
