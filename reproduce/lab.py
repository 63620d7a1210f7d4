# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools and the results of an item."""

import json
import operator
import subprocess
from dataclasses import dataclass, field

from .program import Program, points_csv, read_csv


@dataclass
class Item:
    """A figure or table of the paper, or one of its open questions. `work(lab)` reproduces it."""

    name: str
    title: str
    paper: str
    work: object


ITEMS = {}


def item(name, title, paper):
    """Decorator that registers a function of a Lab as an item. `paper`: what the paper shows or claims."""

    def register(work):
        ITEMS[name] = Item(name, title, paper, work)
        return work

    return register


@dataclass
class Check:
    """A result with its target, and the result of the paper's method if available."""

    what: str
    ours: object
    target: str
    passed: bool
    paper_method: object = None
    reason: str = ""


@dataclass
class Lab:
    """The program, the folder and the results of one item."""

    program: Program
    estimates_path: str
    folder: object
    is_small: bool
    bunny: object = None
    is_complete: bool = True
    checks: list = field(default_factory=list)
    entries: list = field(default_factory=list)  # content of the report, in order: (kind, content)

    def choose(self, usual, small):
        """The usual value, or that for a quick run."""
        return small if self.is_small else usual

    @property
    def size(self):
        """The option for the size of pictures."""
        return ["--size", *self.choose((640, 520), (160, 120))]

    # Work

    def mesh(self, name, *words):
        return self.program.mesh(name, *words)

    def evaluate(self, points, *words):
        return self.program.evaluate(points, *words)

    def evaluate_many(self, name, points, *words):
        return self.program.evaluate_many(name, points, *words)

    def estimates(self, what, points=(), numbers=()):
        """Results of the paper's methods, see estimates.cpp."""
        self.program.commands.append("equiaffine-estimates " + what)
        text = "".join(f"{t!r}\n" for t in numbers) if numbers else points_csv(points)
        result = subprocess.run([self.estimates_path, what], input=text, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"equiaffine-estimates: {result.stderr.strip()}")
        return json.loads(result.stdout) if what == "operations" else read_csv(result.stdout)

    # Results

    def check(self, what, ours, comparison, bound, paper_method=None):
        """Requires a number to be `<=`, `>=` or `==` a bound; NaN fails."""
        compare, sign = {"<=": (operator.le, "≤"), ">=": (operator.ge, "≥"), "==": (operator.eq, "=")}[comparison]
        passed = compare(ours, bound)
        self.checks.append(Check(what, ours, f"{sign} {number(bound)}", passed, paper_method,
                                 "" if passed else f"{number(ours)} is not {sign} {number(bound)}"))

    def fail(self, reason):
        """Records that the run failed."""
        self.checks.append(Check("the run", None, "completes", False, None, reason))
        self.is_complete = False

    def say(self, text):
        self.entries.append(("text", text))

    def table(self, header, rows):
        self.entries.append(("table", (header, rows)))

    def plot(self, name, svg, caption):
        (self.folder / (name + ".svg")).write_text(svg, encoding="utf-8")
        self.entries.append(("plot", (name + ".svg", caption)))

    def picture(self, name, caption, *words, of=None):
        """Draws the mesh `of`.ply, by default `name`.ply; `words` are options of `equiaffine view`."""
        self.program.run("view", (of or name) + ".ply", "--png", name + ".png", *self.size, *words)
        self.entries.append(("picture", (name + ".png", caption)))

    def pictured(self, name, caption):
        """Adds a picture that a command has made."""
        self.entries.append(("picture", (name + ".png", caption)))

    @property
    def passed(self):
        return bool(self.checks) and all(check.passed for check in self.checks)


def number(value):
    """A number as readable text: three digits, and no unnecessary exponent."""
    if value is None:
        return "–"
    if isinstance(value, int):
        return f"{value:,}"
    return value if isinstance(value, str) else f"{value:.3g}"
