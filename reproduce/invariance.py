# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions of curvatures over a surface and over its image under a map of determinant 1."""

import re

from .lab import number
from .plot import histograms
from .statistics import Distribution, distances

COLUMNS = {"K": "affine_gaussian_curvature", "Kₑ": "gaussian_curvature",
           "H": "affine_mean_curvature", "Hₑ": "mean_curvature"}
PAIRS = (("K", "Kₑ"), ("H", "Hₑ"))
CURVATURES = ",".join(COLUMNS.values())
KINDS = ("Kolmogorov-Smirnov", "Wasserstein")


def sampled(lab, name, surface, *words):
    """The curvatures at a point in each triangle, evaluated by the source in `words`, and the areas of the triangles.
    Curvatures at vertices cannot be interpolated, especially near parabolic curves."""
    return lab.evaluate_many(name, surface.samples(), *words)


def distribution(samples, column, is_used=None):
    """The distribution of a column, weighted by the affine area |K_e|^(1/4) dA."""
    weights = [area * abs(k) ** 0.25 for area, k in zip(samples["area"], samples["gaussian_curvature"])]
    if is_used:
        weights = [weight if used else 0.0 for weight, used in zip(weights, is_used)]
    return Distribution(samples[column], weights)


def used_share(samples, is_used=None):
    """The fraction of the area that is used."""
    return sum(a for a, used in zip(samples["area"], is_used or samples.is_regular()) if used) / sum(samples["area"])


def compared(before, after, are_used=(None, None), symbols=tuple(COLUMNS)):
    """A dictionary from symbols of curvatures to the distances between before and after, and both distributions."""
    result = {}
    for symbol in symbols:
        pair = [distribution(samples, COLUMNS[symbol], is_used) for samples, is_used in zip((before, after), are_used)]
        result[symbol] = *distances(*pair), pair
    return result


def tabulate(lab, title, found):
    lab.table([title, KINDS[0], f"{KINDS[1]}, of x / (m + |x|), m the median of |x|"],
              [[symbol, ks, w] for symbol, (ks, w, _) in found.items()])


def require_invariance(lab, title, found, bound, paper=None):
    """Requires affine distances to be at most `bound` times the Euclidean ones. `paper`: the result of its method."""
    for symbol, euclidean in PAIRS:
        for i, kind in enumerate(KINDS):
            ratio = lambda distances: distances[symbol][i] / distances[euclidean][i]
            lab.check(f"{title}: {kind} distance of {symbol} before and after, relative to that of {euclidean}",
                      ratio(found), "<=", bound, paper and ratio(paper))


def histogram_of_bounded(pair, symbol):
    """Histograms before and after of x / (m + |x|), which makes unbounded distributions bounded."""
    unit = pair[0].median_size()
    return histograms(zip(("before", "after"), (each.bounded(unit) for each in pair)),
                      f"{symbol} / (m + |{symbol}|), m = {number(unit)}, the median of |{symbol}| before", -1, 1)


def plot_distributions(lab, title, found):
    for symbol, (_, _, pair) in found.items():
        lab.plot("-".join(re.findall("[a-zA-Z]+", f"{title} {symbol.replace('ₑ', 'e')}")),
                 histogram_of_bounded(pair, symbol), f"{title}: distribution of {symbol}")
