# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that doc/headers.md lists each public header with its first sentence: headers_table.py ROOT [--write].

--write updates the file."""
import pathlib
import re
import sys

from modules import read_modules

LIBRARY = "include/equiaffine"
BEGINNING = """# Headers

These headers are the interface of the library: documented, tested, and kept as [versions.md](versions.md) promises. What is in a
folder or a namespace `internal` may change at any time.

`equiaffine/MODULE/x.h` is what the module has for its users: functions, classes, and the types of their arguments and
results. A header brings the types that it needs.
This list is made of the first sentence of each header; the rest of its documentation stands there.
"""


def first_sentence(text):
    """The first sentence of the comment at the top of a header, or of its first declaration; None without a comment."""
    top = re.match(r"// SPDX.*\n((?:// .*\n)+)", text)
    comment = top[1] if top else next(iter(re.findall(r"^(?: *///[^<].*\n)+", text, re.MULTILINE)), "")
    words = re.sub(r"^ *///?", "", comment, flags=re.MULTILINE).replace("\\file", "").split()
    return re.split(r"(?<=[.])(?<!et al.) ", " ".join(words))[0] or None


def escaped(sentence):
    """The sentence escaped for a Markdown table, except for code in backticks."""
    parts = sentence.replace("|", "\\|").split("`")
    return "`".join(re.sub(r"[_*<]", r"\\\g<0>", part) if n % 2 == 0 else part for n, part in enumerate(parts))


def document_of(root):
    folder = root / LIBRARY
    paths = {module: [] for module in read_modules(root)[LIBRARY]}
    for path in sorted(folder.glob("*/*.h")):
        name = path.relative_to(folder).as_posix()
        paths[name.partition("/")[0]].append(name)
    lines = [BEGINNING]
    for module, names in paths.items():
        lines += [f"## {module}\n", "| `equiaffine/` | |", "|---|---|"] if names else []
        for name in names:
            sentence = first_sentence((folder / name).read_text())
            if not sentence:
                sys.exit(f"{name} has no documentation; add a comment at its top")
            lines.append(f"| `{name}` | {escaped(sentence)} |")
        lines += [""] if names else []
    return "\n".join(lines)


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    document, expected = root / "doc/headers.md", document_of(root)
    if "--write" in sys.argv:
        document.write_text(expected)
    elif not document.exists() or document.read_text() != expected:
        sys.exit("doc/headers.md is out of date: "
                 "run python3 test/layout/headers_table.py . --write")
