# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots as SVG, without dependencies."""

import html
import math
from dataclasses import dataclass

COLORS = ["#2557c7", "#c2410c", "#0f8a5f", "#7c3aed", "#64748b", "#b4236b"]
WIDTH, HEIGHT = 560, 360
LEFT, RIGHT, TOP, BOTTOM = 70, 16, 12, 46


@dataclass
class Series:
    label: str
    points: list  # (x, y)
    color: str = None
    dashed: bool = False
    kind: str = "line"  # line, marked (line with dots), steps, dots


class Axis:
    """Maps numbers to pixels."""

    def __init__(self, values, low, high, logarithmic):
        values = [v for v in values if math.isfinite(v) and (v > 0 or not logarithmic)] or [1.0, 2.0]
        self.logarithmic, self.low, self.high = logarithmic, low, high
        self.first, self.last = self.scaled(min(values)), self.scaled(max(values))
        if self.first == self.last:
            self.first, self.last = self.first - 1, self.last + 1
        if logarithmic:
            margin = 0.04 * (self.last - self.first)
            self.first, self.last = self.first - margin, self.last + margin

    def scaled(self, value):
        return math.log10(value) if self.logarithmic else value

    def __call__(self, value):
        if self.logarithmic and not value > 0:
            return self.low
        share = (self.scaled(value) - self.first) / (self.last - self.first)
        return self.low + min(1, max(0, share)) * (self.high - self.low)

    def ticks(self):
        if self.logarithmic and self.last - self.first >= 1:
            step = max(1, math.ceil((self.last - self.first) / 6))
            return [(10.0**k, power_of_ten(k)) for k in range(math.ceil(self.first), math.floor(self.last) + 1, step)]
        low, high = (10**self.first, 10**self.last) if self.logarithmic else (self.first, self.last)
        raw = (high - low) / 5
        power = 10 ** math.floor(math.log10(raw))
        step = next(f * power for f in (1, 2, 5, 10) if f * power >= raw * (1 - 1e-9))
        return [(k * step, f"{k * step:.6g}") for k in range(math.ceil(low / step - 1e-9), int(high / step + 1e-9) + 1)]


def power_of_ten(exponent):
    if exponent in (0, 1):
        return str(10**exponent)
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def path_of(series, x_axis, y_axis):
    places = [(x_axis(x), y_axis(y)) for x, y in series.points if math.isfinite(x) and math.isfinite(y)]
    if series.kind == "steps":
        places = [q for (x, y), (following, _) in zip(places, places[1:]) for q in ((x, y), (following, y))]
    return places


def drawn(series, color, x_axis, y_axis):
    places = path_of(series, x_axis, y_axis)
    if series.kind == "dots":
        return "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.5" fill="{color}" opacity=".45"/>' for x, y in places)
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    dashes = ' stroke-dasharray="6 4"' if series.dashed else ""
    text = f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="2"{dashes} stroke-linejoin="round"/>'
    if series.kind == "marked":
        text += "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{color}"/>' for x, y in places)
    return text


def legend_rows(all_series):
    """The number of rows of the legend, which has two columns for four or more series."""
    return len(all_series) if len(all_series) < 4 else (len(all_series) + 1) // 2


def legend(all_series, colors):
    """The legend, above the plot."""
    rows = []
    for i, (series, color) in enumerate(zip(all_series, colors)):
        column, row = divmod(i, legend_rows(all_series))
        x, y = LEFT + column * (WIDTH - LEFT) // 2, TOP + 8 + 17 * row
        dashes = ' stroke-dasharray="6 4"' if series.dashed else ""
        rows.append(f'<line x1="{x}" x2="{x + 26}" y1="{y - 4}" y2="{y - 4}" stroke="{color}" '
                    f'stroke-width="3"{dashes}/><text x="{x + 34}" y="{y}">{html.escape(series.label)}</text>')
    return "".join(rows)


def plot(all_series, x_label, y_label, log_x=False, log_y=False):
    """A plot of the series with axes, and a legend for two or more series."""
    top = TOP + 17 * legend_rows(all_series) + 6 if len(all_series) > 1 else TOP
    x_axis = Axis([x for s in all_series for x, _ in s.points], LEFT, WIDTH - RIGHT, log_x)
    y_axis = Axis([y for s in all_series for _, y in s.points], HEIGHT - BOTTOM, top, log_y)
    colors = [series.color or COLORS[i % len(COLORS)] for i, series in enumerate(all_series)]
    grid, numbers = [], []
    for value, text in x_axis.ticks():
        grid.append(f'<line x1="{x_axis(value):.1f}" x2="{x_axis(value):.1f}" y1="{top}" y2="{HEIGHT - BOTTOM}"/>')
        numbers.append(f'<text x="{x_axis(value):.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{text}</text>')
    for value, text in y_axis.ticks():
        grid.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y_axis(value):.1f}" y2="{y_axis(value):.1f}"/>')
        numbers.append(f'<text x="{LEFT - 7}" y="{y_axis(value) + 4:.1f}" text-anchor="end">{text}</text>')
    middle = (top + HEIGHT - BOTTOM) / 2
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        'font-family="system-ui, DejaVu Sans, sans-serif" font-size="12" fill="#1b2330">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
        f'<g stroke="#e3e7ee">{"".join(grid)}</g>',
        "".join(drawn(series, color, x_axis, y_axis) for series, color in zip(all_series, colors)),
        f'<path d="M{LEFT} {top}V{HEIGHT - BOTTOM}H{WIDTH - RIGHT}" fill="none" stroke="#5c6778"/>',
        "".join(numbers),
        f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">{html.escape(x_label)}</text>',
        f'<text transform="translate(15 {middle}) rotate(-90)" text-anchor="middle">{html.escape(y_label)}</text>',
        legend(all_series, colors) if len(all_series) > 1 else "",
        "</svg>",
    ])


def histograms(labeled, x_label, low, high, bins=60):
    """A plot of pairs of a label and a Distribution as steps; every second one is dashed."""
    width = (high - low) / bins
    all_series = []
    for i, (label, distribution) in enumerate(labeled):
        shares = distribution.histogram(low, high, bins)
        points = [(low + width * k, share / width) for k, share in enumerate(shares)] + [(high, 0.0)]
        all_series.append(Series(label, points, COLORS[i % len(COLORS)], dashed=i % 2 == 1, kind="steps"))
    return plot(all_series, x_label, "density of the affine area")
