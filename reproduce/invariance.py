# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions of curvatures over a surface and over its image under a map of determinant 1."""

import re

from .plot import histograms
from .statistics import Distribution, distances

PAIRS = [("affine_gaussian_curvature", "gaussian_curvature", "K", "Kₑ"),
         ("affine_mean_curvature", "mean_curvature", "H", "Hₑ")]
CURVATURES = ",".join(column for affine, euclidean, *_ in PAIRS for column in (affine, euclidean))
KINDS = ("Kolmogorov-Smirnov", "Wasserstein")


def sampled(lab, name, surface, *words):
    """The curvatures at the centers of the triangles, by the function that words say, with areas: a sum over them is
    an integral over the surface up to the square of the triangles' size. Vertices would not do: in the layers of a grid
    that is parallel to a symmetry of the surface they have equal numbers, which makes steps in the distributions."""
    return lab.evaluate_many(name, surface.centers(), *words)


def distribution(samples, column, is_used=None):
    """Of the numbers of a column, weighted by the affine area |K_e|^(1/4) dA."""
    weights = [area * abs(k) ** 0.25 for area, k in zip(samples["area"], samples["gaussian_curvature"])]
    if is_used:
        weights = [weight if used else 0.0 for weight, used in zip(weights, is_used)]
    return Distribution(samples[column], weights)


def used_share(samples, is_used=None):
    """Of the area."""
    return sum(a for a, used in zip(samples["area"], is_used or samples.is_regular()) if used) / sum(samples["area"])


def compared(before, after, are_used=(None, None)):
    """By the symbols of the curvatures their distances before and after, and their distributions."""
    result = {}
    for affine, euclidean, *symbols in PAIRS:
        for column, symbol in zip((affine, euclidean), symbols):
            pair = [distribution(*each) for each in zip((before, after), (column, column), are_used)]
            result[symbol] = *distances(*pair), pair
    return result


def tabulate(lab, title, found):
    lab.table([title, KINDS[0], f"{KINDS[1]}, of x / (m + |x|), m the median of |x|"],
              [[symbol, ks, w] for symbol, (ks, w, _) in found.items()])


def require_invariance(lab, title, found, bound, paper=None):
    """Affine distances are at most `bound` times the Euclidean ones; `paper` is what the paper's method has."""
    for _, _, symbol, euclidean in PAIRS:
        for i, kind in enumerate(KINDS):
            ratio = lambda distances: distances[symbol][i] / distances[euclidean][i]
            lab.check(f"{title}: {kind} distance of {symbol} before and after, over that of {euclidean}", ratio(found),
                      "<=", bound, paper and ratio(paper))


def plot_distributions(lab, title, found):
    for symbol, (_, _, pair) in found.items():
        low, high = pair[0].quantile(0.04), pair[0].quantile(0.96)
        margin = 0.1 * (high - low)
        lab.plot("-".join(re.findall("[a-zA-Z]+", f"{title} {symbol.replace('ₑ', 'e')}")),
                 histograms(list(zip(("before", "after"), pair)), symbol, low - margin, high + margin),
                 f"{title}: distribution of {symbol}")
