# SPDX-License-Identifier: GPL-3.0-or-later
"""Reproduces the figures and tables of the paper; see ../scripts/reproduce."""
