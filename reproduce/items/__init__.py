# SPDX-License-Identifier: GPL-3.0-or-later
"""The items, in the order of the report."""

from ..lab import ITEMS as _registered
from . import beyond, errata, methods, quadrics, sampling, shapes

ORDER = [
    "fig1", "fig2", "fig3", "fig4", "table2f", "fig5", "table1", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12",
    "errata", "pick", "signature", "parabolic", "quadric",
]  # fmt: skip
ITEMS = {name: _registered[name] for name in ORDER}
