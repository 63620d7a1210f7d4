# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds names of functions both in equiaffine and in equiaffine::internal or nested namespaces: hidden_names.py ROOT.

In equiaffine::internal such a name hides the outer one if its header was included before. Depending on the order of
includes, code does not compile, or calls a different function. Functions of numbers are exempt, since they are found by
argument-dependent lookup."""
import pathlib
import re
import sys

FOUND_BY_ARGUMENTS = {"natural_power", "pow"}
NAMESPACE = re.compile(r"^(inline )?namespace ([\w:]+) \{|^\} // namespace ([\w:]+)", re.MULTILINE)
# A declaration at namespace scope starts at the beginning of a line: a type, the name, and a parenthesis.
FUNCTION = re.compile(r"^(?!static_assert|using|return|#|//|/\*|namespace|friend|\s|\})[\w:<>,&*\[\]() .]*?[ &*>](\w+)\(",
                      re.MULTILINE)


def functions_of(text):
    """Pairs of a namespace and the name of a function in it."""
    text = re.sub(r"//(?! namespace).*|/\*.*?\*/", "", text)
    marks = list(NAMESPACE.finditer(text))
    open_namespaces = []
    for mark, end in zip(marks, [mark.start() for mark in marks[1:]] + [len(text)]):
        if mark[2]:
            open_namespaces.append(mark[2])
        elif open_namespaces:
            open_namespaces.pop()
        for function in FUNCTION.finditer(text, mark.end(), end):
            yield "::".join(open_namespaces), function[1]


def find_faults(headers):
    """The faults in a dictionary from paths to texts of all headers."""
    places = {}
    for path, text in headers.items():
        for namespace, name in functions_of(text):
            places.setdefault(name, {}).setdefault(namespace, path)
    for name, spaces in sorted(places.items()):
        for inner, path in sorted(spaces.items()):
            if inner.startswith("equiaffine::internal") and "equiaffine" in spaces and name not in FOUND_BY_ARGUMENTS:
                yield f"{path}: {inner}::{name} hides equiaffine::{name} of {spaces['equiaffine']}: rename one of them"


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1], "include")
    headers = {path.relative_to(root).as_posix(): path.read_text() for path in sorted(root.rglob("*.h"))}
    count = sum(1 for text in headers.values() for _ in functions_of(text))
    found = list(find_faults(headers)) + ([] if count > 500 else [f"only {count} functions were found"])
    print("\n".join(found) or f"no name of {count} functions hides another")
    sys.exit(bool(found))
