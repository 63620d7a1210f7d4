# SPDX-License-Identifier: GPL-3.0-or-later
"""Weighted distributions of numbers, their distances, and slopes. NaN counts as infinite, so that a failed computation
does not meet a target."""

import math


def greatest(values):
    return max((math.inf if math.isnan(v) else v for v in values), default=math.inf)


def quantile(values, share):
    ordered = sorted(math.inf if math.isnan(v) else v for v in values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else math.inf


def median(values):
    return quantile(values, 0.5)


def median_size(values):
    return median([abs(v) for v in values])


def slope(xs, ys):
    """The slope of the least-squares line through (log x, log y)."""
    points = [(math.log(x), math.log(y)) for x, y in zip(xs, ys)]
    mean_x, mean_y = (sum(axis) / len(points) for axis in zip(*points))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


class Distribution:
    """Finite numbers in ascending order, with weights that sum to one."""

    def __init__(self, values, weights):
        pairs = sorted((v, w) for v, w in zip(values, weights) if math.isfinite(v) and w > 0)
        total = math.fsum(w for _, w in pairs)
        if not total > 0:
            raise RuntimeError("there are no finite numbers to compare")
        self.values = [v for v, _ in pairs]
        self.weights = [w / total for _, w in pairs]

    def quantile(self, share):
        cumulated = 0.0
        for value, weight in zip(self.values, self.weights):
            cumulated += weight
            if cumulated >= share:
                return value
        return self.values[-1]

    def median_size(self):
        return Distribution([abs(v) for v in self.values], self.weights).quantile(0.5) or 1.0

    def bounded(self, unit):
        """The distribution of x / (unit + |x|), between -1 and 1."""
        return Distribution([x / (unit + abs(x)) for x in self.values], self.weights)

    def histogram(self, low, high, bins):
        """The fraction in each bin. Values outside are ignored."""
        shares = [0.0] * bins
        for value, weight in zip(self.values, self.weights):
            if low <= value <= high:
                shares[min(bins - 1, int((value - low) / (high - low) * bins))] += weight
        return shares


def distances(first, second):
    """The Kolmogorov-Smirnov distance of two distributions, the maximum difference of the distribution functions, and
    the Wasserstein distance of x / (m + |x|), m the median of |x|. The latter bounds the curvatures, which tend to
    infinity at parabolic curves and have no mean."""
    unit = first.median_size()
    bounded = lambda x: x / (unit + abs(x))
    events = sorted([*zip(first.values, first.weights), *((v, -w) for v, w in zip(second.values, second.weights))])
    difference = most = moved = 0.0
    for (value, weight), (following, _) in zip(events, events[1:]):
        difference += weight
        if following > value:
            most = max(most, abs(difference))
            moved += abs(difference) * (bounded(following) - bounded(value))
    return most, moved
