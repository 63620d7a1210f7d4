# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the named parameters of functions with their documentation: documented_parameters.py ROOT.

A function accepts the parameters whose tags are arguments of its call of check_parameters. Its comment must contain
each of them in backticks, or refer to other functions: "The same", "in the place of" and "those of" mean the functions
above it in the header, and those that it names. A table must not have rows for other parameters."""
import pathlib
import re
import sys

from named_parameters import CHECKS, TAKES_PARAMETERS

DEFINED = re.compile(r"\bauto (\w+)\([^)]*\) CONST \{[^}]*?internal::(\w+_tag)>|"
                     r"^ *EQUIAFFINE_VERTEX_MAP\((\w+), (\w+_tag)", re.MULTILINE)
CHECKER = re.compile(r"\bconstexpr void (check_\w+)\([^{};]*\) \{(.*?)^\}|^using (\w+_tags) =(.*?);",
                     re.MULTILINE | re.DOTALL)
SHARES = re.compile(r"\bThe same\b|[Ii]n the place of|\bthose of\b")


def tags_in(text, checkers):
    """The tags in a call of a check, including those of other checks and lists that it uses."""
    found = set(re.findall(r"\b[A-Z]\w*_tag\b", text))
    for name in set(re.findall(r"\b\w+\b", text)) & checkers.keys():
        found |= tags_in(checkers[name], {other: code for other, code in checkers.items() if other != name})
    return found


def comment_before(text, position):
    """The comment directly before the declaration at a position."""
    lines = re.split(r"\n\s*\n", text[:position])[-1].split("\n")
    return "\n".join(line for line in lines if line.lstrip().startswith("///"))


def functions_of(text):
    """(name, comment, calls of checks) of each function with named parameters."""
    heads = list(TAKES_PARAMETERS.finditer(text))
    for head, end in zip(heads, [head.start() for head in heads[1:]] + [len(text)]):
        name = re.search(r"(\w+)\(", head[1])
        calls = " ".join(text[call.start():text.index(";", call.start())]
                         for call in CHECKS.finditer(text, head.end(), end))
        yield name[1] if name else head[1].strip(), comment_before(text, head.start()), calls


def find_faults(headers):
    """The faults in a dictionary from paths to texts of all headers, public and internal."""
    names = {a or c: b or d for text in headers.values() for a, b, c, d in DEFINED.findall(text)}
    checkers = {a or c: b or d for text in headers.values() for a, b, c, d in CHECKER.findall(text)}
    functions = [(path, *function) for path, text in headers.items() if "/internal/" not in path
                 for function in functions_of(text)]
    spans = [set(re.findall(r"`(\w+)`", comment)) & names.keys() for _, _, comment, _ in functions]

    def documented(n):
        path, _, comment, _ = functions[n]
        if not SHARES.search(comment):
            return spans[n]
        named = {call or span for call, span in re.findall(r"\b(\w+)\(\)|`(\w+)`", comment)}
        return spans[n].union(*(documented(m) for m in range(n) if functions[m][0] == path),
                              *(spans[m] for m in range(len(functions)) if functions[m][1] in named))

    for n, (path, name, comment, calls) in enumerate(functions):
        rows = {row for line in re.findall(r"/// \|([^|]*)\|", comment) for row in re.findall(r"`(\w+)`", line)}
        taken = {known for known, tag in names.items() if tag in tags_in(calls, checkers)}
        yield from (f"{path}: {name} takes {known}, but does not document it" for known in sorted(taken - documented(n)))
        if calls:
            yield from (f"{path}: {name} documents {row}, but does not take it" for row in sorted(rows - taken))


if __name__ == "__main__":
    include = pathlib.Path(sys.argv[1], "include")
    texts = {path.relative_to(include).as_posix(): path.read_text() for path in sorted(include.rglob("*.h"))}
    if sum(1 for text in texts.values() for _, _, calls in functions_of(text) if calls) < 20:
        sys.exit("fewer than twenty functions with named parameters found; check ROOT")
    found = list(find_faults(texts))
    print("\n".join(found) or "all functions document their named parameters")
    sys.exit(bool(found))
