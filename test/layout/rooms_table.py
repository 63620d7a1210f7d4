# SPDX-License-Identifier: GPL-3.0-or-later
"""Says whether the tables of rooms in doc/architecture.md are those of cmake/rooms.txt: rooms_table.py ROOT [--write].

With --write they become so."""
import pathlib
import re
import sys

from rooms import read_rooms


def table_of(folder, rooms):
    lines = [f"| `{folder}/` | uses | what is in it |", "|---|---|---|"]
    lines += [f"| `{name}/` | {', '.join(room.uses) or 'nothing'} | {room.contents} |" for name, room in rooms.items()]
    return "\n".join(lines) + "\n"


def with_tables(text, root):
    """The text with each table of rooms, which begins with the name of their folder, as cmake/rooms.txt has it."""
    for folder, rooms in read_rooms(root).items():
        text, count = re.subn(rf"^\| `{folder}/` \|.*\n(\|.*\n)+", lambda _: table_of(folder, rooms), text,
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
        sys.exit("the tables of rooms in doc/architecture.md are not those of cmake/rooms.txt: "
                 "run python3 test/layout/rooms_table.py . --write")
