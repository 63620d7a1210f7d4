# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which include lines of a checkout leave the road, and which headers are no doors: include_order.py ROOT.

A room is a folder. Its headers are what other rooms may include, and those in its folder `internal` are its own.
cmake/rooms.txt lists the rooms of the library and of the program, lowest first. The headers directly in
include/equiaffine are the porch: forwards for users, which no room includes."""
import pathlib
import re
import sys

LIBRARY = "include/equiaffine"
INCLUDE = re.compile(r'^ *# *include +(?:[<"]equiaffine/([^>"]+)[>"]|"([^"]+)")', re.MULTILINE)


def read_rooms(root):
    """The rooms in their order, per folder that has rooms."""
    lines = (root / "cmake/rooms.txt").read_text().splitlines()
    return {words[0]: words[1:] for words in map(str.split, lines) if words and words[0] != "#"}


def room_of(path):
    """The first folder of a path below include/equiaffine or src; None on the porch."""
    folder, slash, _ = path.partition("/")
    return folder if slash else None


def is_internal(path):
    return "/internal/" in path


def faults_of_step(order, path, included):
    """What is wrong with an include line between two files of the library, or two of the program."""
    here, there = room_of(path), room_of(included)
    if there is None:
        yield "the porch is for users only"
    elif there not in order:
        yield "there is no such room in cmake/rooms.txt"
    elif here is not None and order.index(there) > order.index(here):
        yield f"the room {there} is above {here}"
    if is_internal(included) and here != there:
        yield "that header is its room's own"


def faults_of_library_file(order, path, text):
    if not is_internal(path) and re.search(r"^namespace (equiaffine::)?internal\b", text, re.MULTILINE):
        yield f"{path} is no door: a namespace internal belongs to a header of the room's own"
    for library, quoted in INCLUDE.findall(text):
        if quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'
        for fault in faults_of_step(order, path, library) if library else ():
            yield f"{path} includes {library}: {fault}"


def faults_of_program_file(order, path, text):
    for library, quoted in INCLUDE.findall(text):
        if library and is_internal(library):
            yield f"{path} includes {library}: that header is its room's own"
        for fault in faults_of_step(order, path, quoted) if quoted and order else ():
            yield f"{path} includes {quoted}: {fault}"


def faults_of_circles(texts):
    """One line for each header that includes itself by way of others, or lies between two such."""
    includes = {path: {a for a, _ in INCLUDE.findall(text) if a in texts} for path, text in texts.items()}
    while True:
        included = set().union(*includes.values()) if includes else set()
        ends = {path for path, steps in includes.items() if not steps or path not in included}
        if not ends:
            break
        includes = {path: steps - ends for path, steps in includes.items() if path not in ends}
    return [f"{path} is in a circle of includes" for path in sorted(includes)]


def read_files(folder):
    """Path below the folder -> text, of all headers and sources."""
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))
    return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def find_faults(root):
    rooms = read_rooms(root)
    library = read_files(root / LIBRARY)
    faults = [f"{path}: there is no such room in cmake/rooms.txt"
              for path in library if room_of(path) not in (None, *rooms[LIBRARY])]
    for path, text in library.items():
        faults += faults_of_library_file(rooms[LIBRARY], path, text)
    faults += faults_of_circles(library)
    for folder in ("src", "mesher", "examples", "reproduce"):
        for path, text in read_files(root / folder).items():
            faults += (f"{folder}/{fault}" for fault in faults_of_program_file(rooms.get(folder), path, text))
    return faults


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    if not read_files(root / LIBRARY):
        sys.exit(f"no headers below {root / LIBRARY}")
    found = find_faults(root)
    print("\n".join(found) or "every include leads down the road")
    sys.exit(bool(found))
