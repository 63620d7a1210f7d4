# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which include lines of a checkout leave the road, and which headers are no doors: include_order.py ROOT.

A room is a folder. Its headers are what other rooms may include, and those in its folder `internal` are its own.
cmake/rooms.txt says which rooms each may use. The headers directly in include/equiaffine are the porch: forwards for
users, which no room includes. Tests and benchmarks of a room look inside of it."""
import functools
import pathlib
import re
import sys

from rooms import read_lookers, read_rooms

LIBRARY = "include/equiaffine"
INCLUDE = re.compile(r'^ *# *include +(?:[<"]equiaffine/([^>"]+)[>"]|"([^"]+)")', re.MULTILINE)
EXPORT = re.compile(r"^#include <equiaffine/([^>]+)> *// IWYU pragma: export", re.MULTILINE)
NAME = re.compile(r"(?<!testing::)\binternal::(\w+)")


def room_of(path):
    """The first folder of a path below include/equiaffine or src; None on the porch."""
    folder, slash, _ = path.partition("/")
    return folder if slash else None


def is_internal(path):
    return "/internal/" in path


def faults_of_rooms(folder, rooms):
    names = list(rooms)
    for name, room in rooms.items():
        for used in room.uses:
            if used not in names[:names.index(name)]:
                yield f"cmake/rooms.txt: {folder}/{name} may use {used}, which is not above it"


def faults_of_step(rooms, path, included):
    """What is wrong with an include line between two files of the library, or two of the program."""
    here, there = room_of(path), room_of(included)
    if there is None:
        yield "the porch is for users only"
    elif there not in rooms:
        yield "there is no such room in cmake/rooms.txt"
    elif here is not None and here != there and there not in rooms[here].uses:
        yield f"{here} does not use the room {there}"
    if is_internal(included) and here != there:
        yield "that header is its room's own"


def faults_of_uses(folder, rooms, texts, quoted):
    """One line for each use that cmake/rooms.txt allows and nothing makes."""
    used = {(room_of(path), room_of(steps[quoted])) for path, text in texts.items() for steps in INCLUDE.findall(text)}
    return [f"cmake/rooms.txt: no file of {folder}/{name} uses {other}"
            for name, room in rooms.items() for other in room.uses if (name, other) not in used]


def faults_of_library_file(rooms, path, text):
    if not is_internal(path) and re.search(r"^namespace (equiaffine::)?internal\b", text, re.MULTILINE):
        yield f"{path} is no door: a namespace internal belongs to a header of the room's own"
    for library, quoted in INCLUDE.findall(text):
        if quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'
        for fault in faults_of_step(rooms, path, library) if library else ():
            yield f"{path} includes {library}: {fault}"


def faults_of_program_file(rooms, path, text):
    for library, quoted in INCLUDE.findall(text):
        if library and is_internal(library):
            yield f"{path} includes {library}: that header is its room's own"
        for fault in faults_of_step(rooms, path, quoted) if quoted and rooms else ():
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


def rooms_that_define(name, library):
    """The rooms whose own headers define a name of the namespace internal. What a door exports is everybody's."""
    definition = re.compile(rf"\b(class|struct|concept|using|enum class) {name}\b|^\w[^=;/(]*[ &*>]{name}\(|"
                            rf"^(inline )?constexpr [^=;(]*\b{name}\b", re.MULTILINE)
    exported = {header for text in library.values() for header in EXPORT.findall(text)}
    return {room_of(path) for path, text in library.items()
            if is_internal(path) and path not in exported and definition.search(text)}


def is_home(path, room):
    """Whether a file is one of the tests or benchmarks of a room."""
    return bool(re.match(rf"test/{room}/|benchmark/({room}/|(peers/|group_){room}\w*\.cpp)", path))


def faults_of_looker(path, text, lookers, rooms_of_name):
    """What a file outside of the library looks at inside of a room that is not its own."""
    seen = {f"{a}: that header is its room's own": {room_of(a)} for a, _ in INCLUDE.findall(text) if is_internal(a)}
    for name in NAME.findall(text):
        rooms = rooms_of_name(name)
        if rooms:
            seen[f"internal::{name}: that name is its room's own"] = rooms
    for fault, rooms in seen.items():
        if not any(is_home(path, room) or room in lookers.get(path, ()) for room in rooms):
            yield f"{path} uses {fault}"


def read_files(folder):
    """Path below the folder -> text, of all headers and sources."""
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))
    return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def find_faults(root):
    all_rooms, lookers = read_rooms(root), read_lookers(root)
    library, program = read_files(root / LIBRARY), read_files(root / "src")
    rooms = all_rooms[LIBRARY]
    faults = [f"{path}: there is no such room in cmake/rooms.txt"
              for path in library if room_of(path) not in (None, *rooms)]
    if faults:
        return faults
    for folder, files, quoted in ((LIBRARY, library, 0), ("src", program, 1)):
        faults += [*faults_of_rooms(folder, all_rooms[folder]),
                   *faults_of_uses(folder, all_rooms[folder], files, quoted)]
    for path, text in library.items():
        faults += faults_of_library_file(rooms, path, text)
    faults += faults_of_circles(library)
    for folder in ("src", "mesher"):
        for path, text in read_files(root / folder).items():
            faults += (f"{folder}/{fault}" for fault in faults_of_program_file(all_rooms.get(folder), path, text))
    rooms_of_name = functools.cache(lambda name: rooms_that_define(name, library))
    for folder in ("src", "examples", "reproduce", "test", "benchmark"):
        for path, text in read_files(root / folder).items():
            faults += faults_of_looker(f"{folder}/{path}", text, lookers, rooms_of_name)
    return faults


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    if not read_files(root / LIBRARY):
        sys.exit(f"no headers below {root / LIBRARY}")
    found = find_faults(root)
    print("\n".join(found) or "every file uses what its room may use")
    sys.exit(bool(found))
