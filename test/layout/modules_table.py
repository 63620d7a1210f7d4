# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the tables of modules in doc/architecture.md agree with cmake/modules.txt: modules_table.py ROOT
[--write].

--write updates the tables."""
import pathlib
import re
import sys

from modules import read_modules


def table_of(folder, modules):
    lines = [f"| `{folder}/` | uses | contents |", "|---|---|---|"]
    lines += [f"| `{name}/` | {', '.join(module.uses) or 'nothing'} | {module.contents} |"
              for name, module in modules.items()]
    return "\n".join(lines) + "\n"


def with_tables(text, root):
    """The text with updated tables of modules. Each table begins with the name of its folder."""
    for folder, modules in read_modules(root).items():
        text, count = re.subn(rf"^\| `{folder}/` \|.*\n(\|.*\n)+", lambda _: table_of(folder, modules), text,
                              flags=re.MULTILINE)
        if count != 1:
            sys.exit(f"doc/architecture.md has {count} tables of {folder}")
    return text


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    path = root / "doc/architecture.md"
    text = path.read_text()
    expected = with_tables(text, root)
    if "--write" in sys.argv:
        path.write_text(expected)
    elif text != expected:
        sys.exit("the tables of modules in doc/architecture.md differ from cmake/modules.txt: "
                 "run python3 test/layout/modules_table.py . --write")
