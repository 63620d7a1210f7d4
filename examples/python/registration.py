# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# Registers a sheared piece of a surface with the whole surface, without an initial guess.
# Writes a picture of both to results/.

# %%
import pathlib

import numpy as np

import equiaffine as ea

results = pathlib.Path("results")
results.mkdir(exist_ok=True)

# %%
whole = ea.mesh("x^4 + 2*y^4 + z^4 + x*y^2 + 0.3*x*z + 0.4*y = 1", box=1.7, resolution=48, attributes="none")
shear = np.array([[1, 0.4, 0.1], [0, 0.8, 0.2], [0.2, 0, 1.1]])
center = whole.V.mean(axis=0)
is_in_piece = whole.V[:, 0] > center[0] - 0.2
numbers = np.cumsum(is_in_piece) - 1
F = numbers[whole.F[is_in_piece[whole.F].all(axis=1)]]
piece = ea.Surface(whole.V[is_in_piece] @ shear.T + [3, 0, 0], F)

# %%
found = ea.register(piece, whole)
print(found.summary)
error = np.abs(found.apply(piece.V) - whole.V[is_in_piece]).max()
print(f"the {len(piece.V)} vertices of the piece are mapped back with an error of at most {error:.1e}")

# %%
both = ea.Surface(np.concatenate([whole.V, piece.V]), np.concatenate([whole.F, piece.F + len(whole.V)]),
                  {"is_piece": np.repeat([0.0, 1.0], [len(whole.V), len(piece.V)])})
ea.view(both, results / "registration.png", color="is_piece", size=(800, 640))

# %%
ball = ea.mesh("x^4 + y^4 + 2*z^4 = 1", box=1.3, resolution=32, attributes="none")
print(ea.symmetries(ball).summary)
