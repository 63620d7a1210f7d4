# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds functions of the library that take named parameters without checking them: python3 named_parameters.py ROOT.

Without a call of check_parameters, an unknown named parameter would be ignored silently."""
import pathlib
import re
import sys

TAKES_PARAMETERS = re.compile(r"(?:class \w*Parameters = internal::No_parameters|"
                              r"Parameter_chain(?:\.\.\.)? \w*[Pp]arameters(?: = internal::No_parameters)?)"
                              r"(?:,\s*(?:class|[\w:<>]+) \w+ = [\w:]+)?>\n(.*\n)")
CHECKS = re.compile(r"\binternal::check_(\w+_)?parameters<")
CALLS_ANOTHER = re.compile(r"(?<!joined_parameters)\([^()]*(?:\([^()]*\)[^()]*)*given\.\.\.\)")


def find_faults(path, text):
    heads = list(TAKES_PARAMETERS.finditer(text))
    ends = [head.start() for head in heads[1:]] + [len(text)]
    return [f"{path}: no check of named parameters in {head.group(1).strip()}" for head, end in zip(heads, ends)
            if not CHECKS.search(text, head.end(), end) and not CALLS_ANOTHER.search(text, head.end(), end)]


if __name__ == "__main__":
    headers = {path: path.read_text() for path in sorted(pathlib.Path(sys.argv[1], "include").rglob("*.h"))
               if "internal" not in path.parts}
    if not any(TAKES_PARAMETERS.search(text) for text in headers.values()):
        sys.exit("no functions with named parameters found; check ROOT")
    found = [fault for path, text in headers.items() for fault in find_faults(path, text)]
    print("\n".join(found) or "all functions check their named parameters")
    sys.exit(bool(found))
