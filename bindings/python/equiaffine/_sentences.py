# SPDX-License-Identifier: GPL-3.0-or-later
"""The program's sentences speak of its command line; here they speak of arguments."""
import contextlib
import re
import warnings

from . import _core

_COMMANDS = {"annotate": "curvatures"}
_ARGUMENTS = {"isovalue": "level", "function": "f", "volume": "f", "fit": "f", "set": "constants", "min-overlap": "overlap",
              "output": "path"}
_CHANGES = [
    (r"see 'equiaffine (\w+) --help'", lambda match: f"see help(equiaffine.{_COMMANDS.get(match[1], match[1])})"),
    (r"--set (\w+)=VALUE", r'constants={"\1": VALUE}'),
    (r"the option --([a-z-]+) is missing", lambda match: f"{_ARGUMENTS.get(match[1], match[1])} is missing"),
    (r"the --function is", "the formula is"),
    (r"--box -2 2 -2 2 -2 2", "box=2"),
    (r"--no-reflection", "reflection=False"),
    (r"'equiaffine mesh --fit \S+ -o OUT\.ply --html PAGE\.html' shows", "fit(V).mesh() has"),
    (r"it is for the (picture of --png|page of --html and the picture of --png); add (--png|one of them) or leave it out",
     "it is for a file; give the path of one or leave it out"),
    (r"use --fit\b", "use a fit"),
    (r"\ban --isovalue", "a level"),
    (r"--(method|kind|smoothing|scale) (auto|none|delaunay|marching-cubes|remesh|affine|equiaffine|similarity|rigid)\b",
     r'\1="\2"'),
    (r"--([a-z][a-z-]*) ([A-Z]+|[\d.]+)\b", lambda match: f"{_ARGUMENTS.get(match[1], match[1].replace('-', '_'))}={match[2]}"),
    (r"--([a-z][a-z-]*)", lambda match: _ARGUMENTS.get(match[1], match[1].replace("-", "_"))),
]


def here(text):
    """The sentence with the names of arguments."""
    for pattern, change in _CHANGES:
        text = re.sub(pattern, change, text)
    return text


@contextlib.contextmanager
def sentences():
    """Lets errors of the program be ValueErrors with the names of arguments."""
    try:
        yield
    except _core.Sentence as error:
        sentence, line_end, excerpt = str(error).partition("\n")
        raise ValueError(here(sentence) + line_end + excerpt) from None


def warn(text):
    """Warns where a function of the module was called."""
    warnings.warn(here(text), UserWarning, stacklevel=3)
