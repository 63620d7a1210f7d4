# SPDX-License-Identifier: GPL-3.0-or-later
# Only the other modules of the package use this one, which has no types.
from typing import Any

def __getattr__(name: str) -> Any: ...
