# SPDX-License-Identifier: GPL-3.0-or-later
"""What an item works with, and what it leaves for the report."""

import json
import operator
import subprocess
from dataclasses import dataclass, field

from .program import Program, points_csv, read_csv


@dataclass
class Item:
    """A figure or table of the paper, or a question that it leaves open. `work(lab)` does it."""

    name: str
    title: str
    paper: str
    work: object


ITEMS = {}


def item(name, title, paper):
    """Makes a function of a Lab an item: `paper` is what the paper shows or claims."""

    def register(work):
        ITEMS[name] = Item(name, title, paper, work)
        return work

    return register


@dataclass
class Check:
    """A number of ours with its target, beside that of the paper's method, if it has one."""

    what: str
    ours: object
    target: str
    passed: bool
    paper_method: object = None
    reason: str = ""


@dataclass
class Lab:
    """The program, a folder, and a notebook for one item."""

    program: Program
    estimates_path: str
    folder: object
    is_small: bool
    bunny: object = None
    is_complete: bool = True
    checks: list = field(default_factory=list)
    entries: list = field(default_factory=list)  # what the report shows, in order: (kind, content)

    def choose(self, usual, small):
        """The usual size of something, or that for a quick run."""
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
        """The paper's methods in single steps, see estimates.cpp."""
        self.program.commands.append("equiaffine-estimates " + what)
        text = "".join(f"{t!r}\n" for t in numbers) if numbers else points_csv(points)
        result = subprocess.run([self.estimates_path, what], input=text, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"equiaffine-estimates: {result.stderr.strip()}")
        return json.loads(result.stdout) if what == "operations" else read_csv(result.stdout)

    # Results

    def check(self, what, ours, comparison, bound, paper_method=None):
        """A number that has to be `<=`, `>=` or `==` a bound; a NaN is none of them."""
        compare, sign = {"<=": (operator.le, "≤"), ">=": (operator.ge, "≥"), "==": (operator.eq, "=")}[comparison]
        passed = compare(ours, bound)
        self.checks.append(Check(what, ours, f"{sign} {number(bound)}", passed, paper_method,
                                 "" if passed else f"{number(ours)} is not {sign} {number(bound)}"))

    def fail(self, reason):
        """The run broke off."""
        self.checks.append(Check("the run", None, "ends", False, None, reason))
        self.is_complete = False

    def say(self, text):
        self.entries.append(("text", text))

    def table(self, header, rows):
        self.entries.append(("table", (header, rows)))

    def plot(self, name, svg, caption):
        (self.folder / (name + ".svg")).write_text(svg, encoding="utf-8")
        self.entries.append(("plot", (name + ".svg", caption)))

    def picture(self, name, caption, *words, of=None):
        """A picture of the mesh `of`.ply, else of `name`.ply; words are options of `equiaffine view`."""
        self.program.run("view", (of or name) + ".ply", "--png", name + ".png", *self.size, *words)
        self.entries.append(("picture", (name + ".png", caption)))

    def pictured(self, name, caption):
        """A picture that a command made on the side."""
        self.entries.append(("picture", (name + ".png", caption)))

    @property
    def passed(self):
        return bool(self.checks) and all(check.passed for check in self.checks)


def number(value):
    """For people: few digits, and no exponent where none is needed."""
    if value is None:
        return "–"
    if isinstance(value, int):
        return f"{value:,}"
    return value if isinstance(value, str) else f"{value:.3g}"
