# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads cmake/rooms.txt."""
import collections

Room = collections.namedtuple("Room", "uses contents")


def read_sections(root):
    """Heading -> {name: the text after the colon}, in the order of the file."""
    sections = {}
    for line in (root / "cmake/rooms.txt").read_text().splitlines():
        if line.startswith("["):
            section = sections.setdefault(line.strip("[]"), {})
        elif line and not line.startswith("#"):
            name, text = line.split(":", 1)
            section[name] = text.strip()
    return sections


def read_rooms(root):
    """Folder -> {name of a room in it: the rooms that it may use, and what it has}."""
    rooms = {}
    for folder, lines in read_sections(root).items():
        if folder not in ("porch", "looks inside"):
            rooms[folder] = {name: Room(text.split("|")[0].split(), text.split("|", 1)[1].strip())
                             for name, text in lines.items()}
    return rooms


def read_porch(root):
    """Header on the porch -> the room that it belongs to."""
    lines = read_sections(root).get("porch", {})
    return {f"{name}.h": room for room, names in lines.items() for name in names.split()}


def read_lookers(root):
    """File -> the rooms that it looks inside of, although it belongs to none of them."""
    return {name: text.split() for name, text in read_sections(root).get("looks inside", {}).items()}
