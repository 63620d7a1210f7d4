# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which include lines of a checkout leave the road, and which headers are no doors: include_order.py ROOT.

A room is a folder. Its headers, and those of include/equiaffine that cmake/rooms.txt gives it, are for users; those in
`internal/shared` are for the rooms that may use it, for the program and for tests; all others in `internal` are its own.
Its sources and their headers are in src. cmake/rooms.txt says which rooms each may use. Tests and benchmarks of a room look
inside of it."""
import functools
import pathlib
import re
import sys

from rooms import read_lookers, read_porch, read_rooms, read_sections

LIBRARY = "include/equiaffine"
INCLUDE = re.compile(r'^ *# *include *(?:[<"]equiaffine/([^>"]+)[>"]|"([^"]+)")', re.MULTILINE)
EXPORT = re.compile(r"^#include <equiaffine/([^>]+)> *// IWYU pragma: export", re.MULTILINE)
NAME = re.compile(r"(?<!testing::)\binternal::(\w+)")
OPENED = re.compile(r"\busing namespace (?:equiaffine::)?internal\b|\bnamespace \w+ = (?:equiaffine::)?internal\b|"
                    r"^namespace equiaffine::internal\b", re.MULTILINE)
PLACE = re.compile(r"[^/]+\.h|[^/]+/[^/]+\.h|[^/]+/internal/(?:[^/]+/)?[^/]+\.h")


def room_of(path, porch={}):
    """The first folder of a path below include/equiaffine, src or program; on the porch, the room of the header."""
    folder, slash, _ = path.partition("/")
    return folder if slash else porch.get(path)


def is_for_users(path):
    return "/internal/" not in path


def is_own(path):
    return "/internal/" in path and "/internal/shared/" not in path


def faults_of_rooms(folder, rooms):
    names = list(rooms)
    for name, room in rooms.items():
        for used in room.uses:
            if used not in names[:names.index(name)]:
                yield f"cmake/rooms.txt: {folder}/{name} may use {used}, which is not above it"


def faults_of_porch(porch, rooms, paths):
    on_porch = {path for path in paths if "/" not in path}
    for path in sorted(on_porch - porch.keys()):
        yield f"{path}: cmake/rooms.txt does not say which room it belongs to"
    for path in sorted(porch.keys() - on_porch):
        yield f"cmake/rooms.txt: there is no {path} on the porch"
    for room in sorted(set(porch.values()) - rooms.keys()):
        yield f"cmake/rooms.txt: there is no room {room}"


def faults_of_step(rooms, path, included, porch={}):
    """What is wrong with an include line between two files of the library, or two of the program."""
    here, there = room_of(path, porch), room_of(included, porch)
    if there not in rooms:
        yield "there is no such room in cmake/rooms.txt"
    elif here is not None and here != there and there not in rooms[here].uses:
        yield f"{here} does not use the room {there}"
    if is_own(included) and here != there:
        yield "that header is its room's own"


def faults_of_uses(folder, rooms, texts, quoted, porch={}):
    """One line for each use that cmake/rooms.txt allows and nothing makes."""
    used = {(room_of(path, porch), room_of(steps[quoted], porch))
            for path, text in texts.items() for steps in INCLUDE.findall(text)}
    return [f"cmake/rooms.txt: no file of {folder}/{name} uses {other}"
            for name, room in rooms.items() for other in room.uses if (name, other) not in used]


def only_forwards(text):
    """Whether a header has include lines and nothing else, so that others have two paths: it may put together what is
    its room's own."""
    rest = re.sub(r"/\*.*?\*/|//[^\n]*|^ *#.*?$|namespace [\w:]* *\{\s*\}", "", text, flags=re.MULTILINE | re.DOTALL)
    included = [library for library, _ in INCLUDE.findall(text) if library]
    return bool(included) and not rest.strip() and not all(is_own(each) for each in included)


def faults_of_library_file(rooms, porch, path, text):
    if only_forwards(text):
        yield f"{path} only forwards: a header has one path"
    if is_for_users(path) and re.search(r"^namespace (equiaffine::)?internal\b", text, re.MULTILINE):
        yield f"{path} is for users, who see no namespace internal"
    for library, quoted in INCLUDE.findall(text):
        if quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'
        for fault in faults_of_step(rooms, path, library, porch) if library else ():
            yield f"{path} includes {library}: {fault}"


def faults_of_source(rooms, porch, path, text):
    """What is wrong with the include lines of a file of src: a room's headers there are for its sources."""
    for library, quoted in INCLUDE.findall(text):
        for fault in faults_of_step(rooms, path, library, porch) if library else ():
            yield f"{path} includes {library}: {fault}"
        if quoted and room_of(quoted) != room_of(path):
            yield f"{path} includes {quoted}: that header is its room's own"


def faults_of_program_file(rooms, path, text):
    for library, quoted in INCLUDE.findall(text):
        if library and is_own(library):
            yield f"{path} includes {library}: that header is its room's own"
        for fault in faults_of_step(rooms, path, quoted) if quoted else ():
            yield f"{path} includes {quoted}: {fault}"


def faults_of_reach(library, programs):
    """One line for each header that no header for users and no program includes: what sources alone need is not installed."""
    reached = set()
    next_ones = {path for path in library if is_for_users(path)}
    next_ones |= {path for text in programs for path, _ in INCLUDE.findall(text) if path in library}
    while next_ones:
        reached |= next_ones
        included = {included for path in next_ones for included, _ in INCLUDE.findall(library[path])}
        next_ones = (included & library.keys()) - reached
    return [f"{path} is included by no header for users, and by no program: it belongs to src" for path in sorted(library.keys() - reached)]


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


def faults_of_example(path, text):
    """An example shows what users may include and name."""
    for library, _ in INCLUDE.findall(text):
        if library and not is_for_users(library):
            yield f"{path} includes {library}: that header is internal"
    for name in NAME.findall(text):
        yield f"{path} uses internal::{name}: that name is internal"


def faults_of_places(root, porch_lines, library):
    """Files where no header belongs, headers on the porch that two rooms have, and shared ones that nobody else uses."""
    for path in sorted((root / LIBRARY).rglob("*")):
        name = path.relative_to(root / LIBRARY).as_posix()
        if path.is_file() and not PLACE.fullmatch(name):
            yield f"{name}: a header is X.h, ROOM/X.h, ROOM/internal/X.h or ROOM/internal/PART/X.h"
    names = [name for line in porch_lines for name in line.split()]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"cmake/rooms.txt: {name}.h belongs to two rooms"
    used = set()
    for folder in (LIBRARY, "src", "program", "test", "benchmark", "reproduce"):
        for path, text in read_files(root / folder).items():
            for included, _ in INCLUDE.findall(text):
                if included and not (folder == LIBRARY and is_own(path) and room_of(path) == room_of(included)):
                    used.add(included)
    for path in library:
        if "/internal/shared/" in path and path not in used:
            yield f"{path} is shared with nobody"


def rooms_that_define(name, library):
    """The rooms whose own headers alone define a name of the namespace internal. What a door exports is everybody's."""
    definition = re.compile(rf"\b(class|struct|concept|using|enum class) {name}\b|^[\w\[][^=;/(]*[ &*>]{name}\(|"
                            rf"^(inline )?constexpr [^=;(]*\b{name}\b", re.MULTILINE)
    exported = {header for text in library.values() for header in EXPORT.findall(text)}
    defining = [path for path, text in library.items() if "/internal/" in path and name in text and definition.search(text)]
    is_everybodys = any(not is_own(path) or path in exported for path in defining)
    return set() if is_everybodys else {room_of(path) for path in defining}


def is_home(path, room):
    """Whether a file is one of the sources, tests or benchmarks of a room."""
    return bool(re.match(rf"src/{room}/|test/{room}/|benchmark/({room}/|(peers/|group_){room}\w*\.cpp)", path))


def faults_of_looker(path, text, lookers, rooms_of_name):
    """What a file outside of the library looks at inside of a room that is not its own."""
    if OPENED.search(text) and not path.startswith("src/"):
        yield f"{path} opens the namespace internal: write internal::NAME"
    for _, quoted in INCLUDE.findall(text):
        if "include/equiaffine/" in quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'
    seen = {f"{a}: that header is its room's own": {room_of(a)} for a, _ in INCLUDE.findall(text) if is_own(a)}
    for name in NAME.findall(text):
        rooms = rooms_of_name(name)
        if rooms:
            seen[f"internal::{name}: that name is its room's own"] = rooms
    for fault, rooms in seen.items():
        if not any(is_home(path, room) or room in lookers.get(path, ()) for room in rooms):
            yield f"{path} uses {fault}"


def read_files(folder):
    """Path below the folder -> text, of all headers and sources."""
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp", ".cxx"))
    return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def faults_of_names(rooms_of_name, room, path, text):
    """One line for each name of the namespace internal that belongs to another room."""
    for name in sorted(set(NAME.findall(text))):
        rooms = rooms_of_name(name)
        if rooms and room not in rooms:
            yield f"{path} uses internal::{name}: that name is its room's own"


def find_faults(root):
    all_rooms, porch, lookers = read_rooms(root), read_porch(root), read_lookers(root)
    library, sources, program = read_files(root / LIBRARY), read_files(root / "src"), read_files(root / "program")
    rooms = all_rooms[LIBRARY]
    faults = [f"{path}: there is no such room in cmake/rooms.txt"
              for path in library if "/" in path and room_of(path) not in rooms]
    faults += (f"src/{path}: there is no such room in cmake/rooms.txt" for path in sources if room_of(path) not in rooms)
    faults += (f"program/{path}: there is no such room in cmake/rooms.txt"
               for path in program if "/" in path and room_of(path) not in all_rooms["program"])
    faults += faults_of_porch(porch, rooms, library)
    faults += faults_of_places(root, read_sections(root).get("porch", {}).values(), library)
    faults += (f"cmake/rooms.txt: there is no file {path}" for path in lookers if not (root / path).exists())
    if faults:
        return faults
    for folder, files, quoted, doors in ((LIBRARY, library | sources, 0, porch), ("program", program, 1, {})):
        faults += [*faults_of_rooms(folder, all_rooms[folder]),
                   *faults_of_uses(folder, all_rooms[folder], files, quoted, doors)]
    for path, text in library.items():
        faults += faults_of_library_file(rooms, porch, path, text)
    faults += faults_of_circles(library)
    beside = [text for folder in ("program", "vtk", "browser", "python", "reproduce")
              for text in read_files(root / folder).values()]
    faults += faults_of_reach(library, beside)
    for path, text in sources.items():
        faults += (f"src/{fault}" for fault in faults_of_source(rooms, porch, path, text))
    for path, text in program.items():
        faults += (f"program/{fault}" for fault in faults_of_program_file(all_rooms["program"], path, text))
    for path, text in read_files(root / "examples").items():
        faults += faults_of_example(f"examples/{path}", text)
    rooms_of_name = functools.cache(lambda name: rooms_that_define(name, library))
    for path, text in library.items():
        faults += faults_of_names(rooms_of_name, room_of(path, porch), path, text)
    for folder in ("src", "program", "examples", "reproduce", "test", "benchmark"):
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
