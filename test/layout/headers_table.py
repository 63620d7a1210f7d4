# SPDX-License-Identifier: GPL-3.0-or-later
"""Says whether doc/headers.md has each header for users with its first sentence: headers_table.py ROOT [--write].

With --write it becomes so."""
import pathlib
import re
import sys

from rooms import read_porch, read_rooms

LIBRARY = "include/equiaffine"
BEGINNING = """# Headers

These headers are the interface of the library: documented, tested, and kept as [versions.md](versions.md) promises. What is in a
folder `internal` may change at any time.

What people begin with is directly in the folder; the others have types of its arguments and results, and functions for
special purposes. A header brings the types that it needs.
This list is made of the first sentence of each header; the rest of its documentation stands there.
"""


def first_sentence(text):
    """What the comment at the top of a header says, or else the one of its first declaration; None without either."""
    top = re.match(r"// SPDX.*\n((?:// .*\n)+)", text)
    comment = top[1] if top else next(iter(re.findall(r"^(?: *///[^<].*\n)+", text, re.MULTILINE)), "")
    words = re.sub(r"^ *///?", "", comment, flags=re.MULTILINE).replace("\\file", "").split()
    return re.split(r"(?<=[.])(?<!et al.) ", " ".join(words))[0] or None


def escaped(sentence):
    """Markdown in a table that shows the sentence as it is, apart from code between backticks."""
    parts = sentence.replace("|", "\\|").split("`")
    return "`".join(re.sub(r"[_*<]", r"\\\g<0>", part) if n % 2 == 0 else part for n, part in enumerate(parts))


def document_of(root):
    folder, porch = root / LIBRARY, read_porch(root)
    paths = {room: [] for room in read_rooms(root)[LIBRARY]}
    for path in sorted(folder.rglob("*.h"), key=lambda path: (path.parent != folder, path)):
        name = path.relative_to(folder).as_posix()
        if "/internal/" not in name:
            paths[porch.get(name) or name.partition("/")[0]].append(name)
    lines = [BEGINNING]
    for room, names in paths.items():
        lines += [f"## {room}\n", f"| `equiaffine/` | |", "|---|---|"] if names else []
        for name in names:
            sentence = first_sentence((folder / name).read_text())
            if not sentence:
                sys.exit(f"{name} has no documentation")
            lines.append(f"| `{name}` | {escaped(sentence)} |")
        lines += [""] if names else []
    return "\n".join(lines)


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    document, expected = root / "doc/headers.md", document_of(root)
    if "--write" in sys.argv:
        document.write_text(expected)
    elif not document.exists() or document.read_text() != expected:
        sys.exit("doc/headers.md does not have the headers for users as they are: "
                 "run python3 test/layout/headers_table.py . --write")
