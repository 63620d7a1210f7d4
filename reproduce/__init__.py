# SPDX-License-Identifier: GPL-3.0-or-later
"""Every figure and table of the paper from our code, see ../scripts/reproduce."""
