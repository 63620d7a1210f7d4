# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a page with the figures of all groups of benchmarks and their targets:
  figures_page.py FOLDER_OF_LOGS PAGE
A log GROUP.txt contains lines `figure NAME VALUE UNIT [target >=X]`, and ends with `seconds S status N`. The page is a
self-contained HTML file. Prints the number of targets that are met, and each one that is missed."""
import datetime
import html
import math
import platform
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

FIGURE = re.compile(r"^figure (?P<name>\S+) (?P<value>\S+) (?P<unit>.*?)(?: target (?P<target>.*))?$")
BOUND = re.compile(r"^(?P<side>[<>]=?|=)\s*(?P<bound>[-+\d.eE]+)")
STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
table { border-collapse: collapse; width: 100%; margin-bottom: 1rem; }
td, th { padding: 0.15rem 0.6rem; text-align: left; border-bottom: 1px solid #ddd; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
td { white-space: nowrap; }
.met { color: #17692b; } .missed { color: #a4161a; font-weight: 600; }
svg { vertical-align: middle; } svg .met { fill: #7fb98d; } svg .missed { fill: #d9777a; }
"""


@dataclass
class Figure:
    """A measured figure; `margin` is its ratio to the target, more than 1 if it is better, if this makes sense."""
    name: str
    value: float
    unit: str
    target: str
    is_met: bool | None
    margin: float | None


def figure_of(line):
    found = FIGURE.match(line)
    if not found:
        return None
    try:
        value = float(found["value"])
    except ValueError:
        return None
    target, is_met, margin = found["target"] or "", None, None
    if bound := BOUND.match(target):
        limit = float(bound["bound"])
        is_met = {"<": value < limit, "<=": value <= limit, ">": value > limit, ">=": value >= limit,
                  "=": value == limit}[bound["side"]]
        if value > 0 and limit > 0 and bound["side"] != "=":
            margin = limit / value if bound["side"].startswith("<") else value / limit
    return Figure(found["name"], value, found["unit"], target, is_met, margin)


def bar(figure):
    """A bar that extends from the target to the right if the figure is better, to the left if it is worse; full at
    10."""
    if figure.margin is None:
        return ""
    width, middle = 200, 100
    length = max(-1.0, min(1.0, math.log10(figure.margin))) * (middle - 2)
    kind = "met" if figure.is_met else "missed"
    return (f'<svg width="{width}" height="14" role="img" aria-label="{figure.margin:.3g} times better than the target">'
            f'<rect class="{kind}" x="{min(middle, middle + length):.1f}" y="2" width="{max(abs(length), 1):.1f}" '
            f'height="10"/><line x1="{middle}" y1="0" x2="{middle}" y2="14" stroke="#444"/></svg>')


def row(figure):
    mark = {True: '<span class="met">met</span>', False: '<span class="missed">missed</span>', None: ""}[figure.is_met]
    return (f"<tr><td>{html.escape(figure.name)}</td><td class=number>{figure.value:.4g}</td>"
            f"<td>{html.escape(figure.unit)}</td><td>{html.escape(figure.target)}</td><td>{mark}</td>"
            f"<td>{bar(figure)}</td></tr>")


def section(group, log):
    """The HTML of a group, and its figures."""
    lines = log.splitlines()
    figures = [figure for line in lines if (figure := figure_of(line))]
    end = re.match(r"seconds (\d+) status (\d+)", lines[-1]) if lines else None
    note = f"{end[1]} s" if end and end[2] == "0" else "it did not come to its end"
    table = "<p>There are no figures.</p>"
    if figures:
        head = "<tr><th>figure<th>value<th>unit<th>target<th><th>worse | better than the target, up to 10 times</tr>"
        table = f"<table>{head}{''.join(row(figure) for figure in figures)}</table>"
    text = html.escape("\n".join(lines[:-1] if end else lines))
    return (f"<h2 id={group}>{group}</h2><p>{note}</p>{table}<details><summary>Complete output</summary>"
            f"<pre>{text}</pre></details>"), figures


def machine():
    """A line that describes the machine, the compiler and the commit."""
    model = next((line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
                  if line.startswith("model name")), platform.machine())
    cores = len(re.findall(r"^processor", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M))
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True, check=False).stdout.split("\n")[0]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False).stdout
    return f"{model}, {cores} cores; {compiler}; commit {commit.strip() or 'unknown'}; {datetime.date.today()}"


def main(folder, page):
    sections, links, all_figures = [], [], []
    for log in sorted(Path(folder).glob("*.txt")):
        text, figures = section(log.stem, log.read_text(encoding="utf-8", errors="replace"))
        sections.append(text)
        all_figures += figures
        with_target = [figure for figure in figures if figure.is_met is not None]
        links.append(f"<a href=#{log.stem}>{log.stem}</a> {sum(f.is_met for f in with_target)} of {len(with_target)}")
    with_target = [figure for figure in all_figures if figure.is_met is not None]
    met = sum(figure.is_met for figure in with_target)
    summary = f"{met} of {len(with_target)} targets met; {len(all_figures) - len(with_target)} figures without a target."
    body = f"<h1>Benchmarks of equiaffine</h1><p>{html.escape(machine())}</p><p>{summary}</p><p>{'; '.join(links)}</p>"
    Path(page).write_text(f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Benchmarks of equiaffine</title>"
                          f"<style>{STYLE}</style><body>{body}{''.join(sections)}</body></html>\n", encoding="utf-8")
    print(summary)
    for figure in with_target:
        if not figure.is_met:
            print(f"missed: {figure.name} {figure.value:.4g} {figure.unit} target {figure.target}")
    print(f"wrote {page}")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
