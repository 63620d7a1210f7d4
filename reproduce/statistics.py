# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions of numbers with weights, their distances, and slopes."""

import math


class Distribution:
    """Finite numbers with weights that sum to one, in ascending order."""

    def __init__(self, values, weights=None):
        weights = weights or [1.0] * len(values)
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

    def mapped(self, function):
        """The distribution of an increasing function of the numbers."""
        return Distribution([function(v) for v in self.values], self.weights)

    def histogram(self, low, high, bins):
        """The share of each bin; what lies outside is counted in the bin at its end."""
        shares = [0.0] * bins
        for value, weight in zip(self.values, self.weights):
            shares[min(bins - 1, max(0, int((value - low) / (high - low) * bins)))] += weight
        return shares


def _steps(first, second):
    """(value, length of the interval to the next value, difference of the distribution functions on it)"""
    events = sorted([(v, w) for v, w in zip(first.values, first.weights)]
                    + [(v, -w) for v, w in zip(second.values, second.weights)])
    difference = 0.0
    for (value, weight), (following, _) in zip(events, events[1:]):
        difference += weight
        yield value, following - value, difference


def kolmogorov_smirnov(first, second):
    """The greatest difference of the distribution functions, 0 to 1."""
    return max((abs(d) for _, length, d in _steps(first, second) if length > 0), default=0.0)


def wasserstein(first, second):
    """How far the numbers of one have to move on average to become the other."""
    return math.fsum(length * abs(d) for _, length, d in _steps(first, second))


def scaled_wasserstein(first, second):
    """The same for x / (m + |x|), m the median of |x|: curvatures grow without bound at parabolic curves, where their
    mean does not exist."""
    unit = Distribution([abs(v) for v in first.values], first.weights).quantile(0.5) or 1.0
    return wasserstein(*(d.mapped(lambda x: x / (unit + abs(x))) for d in (first, second)))


def median(values):
    return quantile(values, 0.5)


def quantile(values, share):
    ordered = sorted(v for v in values if math.isfinite(v))
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def slope(xs, ys):
    """Of the line through (log x, log y) with least squares."""
    points = [(math.log(x), math.log(y)) for x, y in zip(xs, ys) if y > 0]
    mean_x, mean_y = (sum(axis) / len(points) for axis in zip(*points))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)
