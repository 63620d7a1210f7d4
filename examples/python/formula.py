# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# A formula with parameters: how the affine Gaussian curvature of a surface changes with a constant.
# Run it as a program, or cell by cell as a notebook. It writes pictures to results/.

# %%
import pathlib

import numpy as np

import equiaffine as ea

results = pathlib.Path("results")
results.mkdir(exist_ok=True)
FORMULA = "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*(x^2 + y^2 + z^2) + 6*c"

# %%
for c in (0.5, 1, 2.5):
    surface = ea.mesh(FORMULA, constants={"c": c}, box=1.2, resolution=96)
    K, H = surface["affine_gaussian_curvature"], surface["affine_mean_curvature"]
    parabolic = np.mean(surface.status == ea.Status.PARABOLIC)
    print(f"c = {c}: {len(surface.V)} vertices, K > 0 at {100 * np.nanmean(K > 0):.0f} % of them, "
          f"median H {np.nanmedian(H):.3g}, parabolic {100 * parabolic:.1f} %")

# %%
# Affine maps of determinant 1 do not change K: the sheared surface has the same K at the images of the vertices.
shear = np.array([[1, 0.7, 0], [0, 1, 0.3], [0, 0, 1]])
surface = ea.mesh(FORMULA, constants={"c": 1}, box=1.2, resolution=48)
names = {name: f"({' + '.join(f'({m})*{v}' for m, v in zip(row, 'xyz'))})"
         for name, row in zip("xyz", np.linalg.inv(shear))}
sheared = "".join(names.get(character, character) for character in FORMULA)
there = ea.evaluate(sheared, surface.V @ shear.T, constants={"c": 1})
K = surface["affine_gaussian_curvature"]
known = np.abs(K) < 1e3
print(f"sheared: K differs by at most {np.nanmax(np.abs(there['affine_gaussian_curvature'] - K)[known]):.1e} "
      f"where |K| < 1000")

# %%
ea.view(surface, results / "formula.png", color="affine_gaussian_curvature", size=(800, 640))
ea.view(surface, results / "formula.html")
