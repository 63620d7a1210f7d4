# SPDX-License-Identifier: GPL-3.0-or-later
"""The report: a single self-contained page, and results.json for programs."""

import base64
import html
import itertools
import json
import math
import re

from .lab import number
from .plot import power_of_ten

STYLE = """
:root { --ink: #1b2330; --quiet: #5c6778; --line: #d9dee7; --good: #0f7a4f; --bad: #b91c1c; --soft: #f4f6fa; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1180px; padding: 40px 28px 80px; color: var(--ink); background: #fff;
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 31px; line-height: 1.2; margin: 0 0 8px; }
h2 { font-size: 22px; margin: 0; }
p { max-width: 78ch; margin: 10px 0; }
a { color: inherit; }
code, pre { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; }
.quiet { color: var(--quiet); }
table { border-collapse: collapse; margin: 14px 0; font-size: 14.5px; }
th, td { padding: 6px 14px 6px 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { color: var(--quiet); font-weight: 600; }
td { font-variant-numeric: tabular-nums; }
.number { white-space: nowrap; }
#summary { font-size: 13px; line-height: 1.4; }
#summary td:first-child { width: 150px; }
#summary a { font-weight: 700; font-size: 15px; }
#summary td:nth-child(2) { width: 310px; color: var(--quiet); }
#summary td:nth-child(3) { width: 260px; }
.mark { font-weight: 700; white-space: nowrap; }
.mark.pass { color: var(--good); }
.mark.fail, .reason { color: var(--bad); }
section { border-top: 2px solid var(--ink); margin-top: 52px; padding-top: 18px; }
section header { display: flex; justify-content: space-between; align-items: baseline; gap: 20px; }
blockquote { margin: 12px 0; padding: 8px 16px; border-left: 4px solid var(--line); background: var(--soft);
  max-width: 90ch; }
blockquote b { color: var(--quiet); font-weight: 600; }
.figures { display: grid; gap: 18px; margin: 16px 0; }
.two { grid-template-columns: repeat(auto-fill, minmax(420px, 1fr)); }
.three { grid-template-columns: repeat(auto-fill, minmax(320px, 1fr)); }
figure { margin: 0; max-width: 560px; break-inside: avoid; }
figure img, figure svg { width: 100%; height: auto; display: block; border: 1px solid var(--line); border-radius: 8px; }
figcaption { font-size: 14px; color: var(--quiet); margin-top: 6px; }
details { margin-top: 12px; }
summary { cursor: pointer; color: var(--quiet); font-size: 14px; }
pre { background: var(--soft); padding: 12px 14px; border-radius: 8px; white-space: pre-wrap; overflow-wrap: anywhere; }
@media print {
  body { max-width: none; padding: 0; font-size: 11pt; }
  h2, blockquote { break-after: avoid; }
  blockquote, tr { break-inside: avoid; }
  details { display: none; }
}
"""


def results(items_and_labs):
    """One object per item. `checks` contains the numbers, the other values are text for readers."""

    def joined(lab, value):
        return "; ".join(f"{c.what}: {number(value(c))}" for c in lab.checks if value(c) not in (None, "")) or "–"

    return {"items": [{
        "name": item.name,
        "paper": item.paper,
        "paper_method_measured": joined(lab, lambda c: c.paper_method),
        "ours": joined(lab, lambda c: c.ours),
        "target": joined(lab, lambda c: c.target),
        "pass": lab.passed,
        "checks": [vars(check) for check in lab.checks],
    } for item, lab in items_and_labs]}


def valid(value):
    """Replaces infinities and NaN, which JSON does not support, by text."""
    if isinstance(value, dict):
        return {name: valid(each) for name, each in value.items()}
    if isinstance(value, list):
        return [valid(each) for each in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def to_json(items_and_labs):
    return json.dumps(valid(results(items_and_labs)), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def readable(value):
    """A number or text as HTML, with powers of ten."""
    text = html.escape(number(value))
    return re.sub(r"\b(\d[\d.]*)e([+-]\d+)\b", lambda m: times_power(m[1], int(m[2])), text)


def times_power(mantissa, exponent):
    power = power_of_ten(exponent)
    return f'<span class="number">{power if mantissa == "1" else mantissa + " · " + power}</span>'


def mark(passed):
    return f'<span class="mark {"pass" if passed else "fail"}">{"✓ holds" if passed else "✗ does not hold"}</span>'


def table(header, rows, attributes=""):
    """A table. The cells of the rows are HTML."""
    head = "".join(f"<th>{html.escape(cell)}</th>" for cell in header)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table {attributes}><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def verdict(passed, reason):
    return mark(passed) + (f'<div class="reason">{readable(reason)}</div>' if reason else "")


def summary(items_and_labs):
    """A table with a row for each item: its first failed check, or its first check if all hold."""
    rows = []
    for item, lab in items_and_labs:
        check = next((c for c in lab.checks if not c.passed), lab.checks[0])
        rows.append([
            f'<a href="#{item.name}">{item.name}</a><br><span class="quiet">{html.escape(item.title)}</span>',
            html.escape(item.paper), html.escape(check.what), readable(check.paper_method), readable(check.ours),
            f'<span class="number">{readable(check.target)}</span>', verdict(check.passed, check.reason),
        ])
    return table(["", "claim of the paper", "measured here", "the paper's method", "ours", "target", ""], rows,
                 'id="summary"')


def checks_table(lab):
    rows = [[html.escape(check.what), readable(check.paper_method), readable(check.ours),
             f'<span class="number">{readable(check.target)}</span>', verdict(check.passed, check.reason)]
            for check in lab.checks]
    return table(["", "the paper's method", "ours", "target", ""], rows)


def figure(folder, kind, name, caption):
    if kind == "plot":
        content = (folder / name).read_text(encoding="utf-8")
    else:
        data = base64.b64encode((folder / name).read_bytes()).decode()
        content = f'<img alt="{html.escape(caption)}" src="data:image/png;base64,{data}">'
    return f"<figure>{content}<figcaption>{readable(caption)}</figcaption></figure>"


def entries(lab):
    """The entries as HTML. Consecutive pictures and plots share a grid."""
    parts = []
    for kind, group in itertools.groupby(lab.entries, key=lambda entry: entry[0]):
        contents = [content for _, content in group]
        if kind in ("picture", "plot"):
            figures = "".join(figure(lab.folder, kind, *content) for content in contents)
            parts.append(f'<div class="figures {"three" if len(contents) in (3, 5) else "two"}">{figures}</div>')
        elif kind == "text":
            parts += [f"<p>{readable(text)}</p>" for text in contents]
        else:
            parts += [table(header, [map(readable, row) for row in rows]) for header, rows in contents]
    return "\n".join(parts)


def section(item, lab):
    commands = "\n".join(lab.program.commands)
    return f"""<section id="{item.name}">
<header><h2>{item.name} · {html.escape(item.title)}</h2>{mark(lab.passed)}</header>
<blockquote><b>The paper.</b> {html.escape(item.paper)}</blockquote>
{checks_table(lab)}
{entries(lab)}
<details><summary>To run only this item: <code>scripts/reproduce --item {item.name}</code>. Its commands:</summary>
<pre>{html.escape(commands)}</pre></details>
</section>"""


def to_html(items_and_labs, facts):
    passed = sum(lab.passed for _, lab in items_and_labs)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>The paper, reproduced</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Affine-invariant curvature estimators, reproduced</h1>
<p>This report reproduces the figures and tables of M. Andrade, T. Lewiner, <i>Affine-invariant curvature estimators for
implicit surfaces</i>, Computer Aided Geometric Design 29(2), 2012, with equiaffine. It compares the claims of the
paper, measurements of its method, and ours. An affine map of determinant 1 can shear and stretch a surface. The affine
Gaussian and mean curvatures K and H and the Pick invariant J do not change, and the affine normal ξ is mapped to the
affine normal of the image; the Euclidean curvatures change. For maps of other determinants, the weights of these
quantities are taken into account.</p>
<p><b>{passed} of {len(items_and_labs)} items hold.</b> <span class="quiet">{html.escape(facts)}</span></p>
{summary(items_and_labs)}
{"".join(section(item, lab) for item, lab in items_and_labs)}
</body>
</html>
"""
