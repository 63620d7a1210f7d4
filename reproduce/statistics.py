# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions of numbers with weights, their distances, and slopes. What is not a number counts as infinite, so that
no target is met by what could not be computed."""

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
    """Of the line through (log x, log y) with least squares."""
    points = [(math.log(x), math.log(y)) for x, y in zip(xs, ys)]
    mean_x, mean_y = (sum(axis) / len(points) for axis in zip(*points))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


class Distribution:
    """Finite numbers with weights that sum to one, in ascending order."""

    def __init__(self, values, weights):
        pairs = sorted((v, w) for v, w in zip(values, weights) if math.isfinite(v) and w > 0)
        total = math.fsum(w for _, w in pairs)
        if not total > 0:
            raise RuntimeError("no number is left to compare")
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
        """Of x / (unit + |x|), between -1 and 1."""
        return Distribution([x / (unit + abs(x)) for x in self.values], self.weights)

    def histogram(self, low, high, bins):
        """The share of each bin; what lies outside is in none."""
        shares = [0.0] * bins
        for value, weight in zip(self.values, self.weights):
            if low <= value <= high:
                shares[min(bins - 1, int((value - low) / (high - low) * bins))] += weight
        return shares


def distances(first, second):
    """Of two distributions, by Kolmogorov and Smirnov, the greatest difference of the distribution functions, 0 to 1;
    and by Wasserstein, how far the numbers of one have to move on average to become the other, as x / (m + |x|), m the
    median of |x|: curvatures grow without bound at parabolic curves, where their mean does not exist."""
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
