# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds include lines that violate the order of the modules, and misplaced files: include_order.py ROOT.

A module is a folder of include/equiaffine with public headers, and internal headers in its folder `internal`. A file of
a module can include headers of its own module and of the modules listed in its line of cmake/modules.txt. The sources
of a module and their private headers are in src. The folders of the program are also modules, and can include any
header of the library. Examples can only include public headers; tests, benchmarks and reproduce can include any
header."""
import pathlib
import re
import sys

from modules import read_modules

LIBRARY = "include/equiaffine"
INCLUDE = re.compile(r'^ *# *include *(?:[<"]equiaffine/([^>"]+)[>"]|"([^"]+)")', re.MULTILINE)
PLACE = re.compile(r"[^/]+/(?:internal/)?[^/]+\.h")


def module_of(path):
    """The first folder of a path below include/equiaffine, src or program; None for a file beside these folders."""
    folder, slash, _ = path.partition("/")
    return folder if slash else None


def is_public(path):
    return "/internal/" not in path


def read_files(folder):
    """A dictionary from paths relative to the folder to texts, of all headers and sources."""
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp", ".cxx"))
    return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def faults_of_places(folder):
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and not PLACE.fullmatch(name):
            yield f"{name}: a header is MODULE/x.h or MODULE/internal/x.h"


def faults_of_order(folder, modules):
    names = list(modules)
    for name, module in modules.items():
        for used in module.uses:
            if used not in names[:names.index(name)]:
                yield f"cmake/modules.txt: {folder}/{name} uses {used}, which is not above it"


def faults_of_uses(folder, modules, texts, quoted):
    """A line for each unused dependency in cmake/modules.txt."""
    used = {(module_of(path), module_of(steps[quoted]))
            for path, text in texts.items() for steps in INCLUDE.findall(text)}
    return [f"cmake/modules.txt: no file of {folder}/{name} uses {other}"
            for name, module in modules.items() for other in module.uses if (name, other) not in used]


def faults_of_step(modules, path, included):
    """The faults of an include line between two files of the library, or two of the program."""
    here, there = module_of(path), module_of(included)
    if there not in modules:
        yield f"{path} includes {included}: there is no such module in cmake/modules.txt"
    elif here is not None and here != there and there not in modules[here].uses:
        yield f"{path} includes {included}: {here} does not use the module {there}"


def only_forwards(path, text):
    """Whether a header has include lines and nothing else, so that others have two paths. It may put together what is
    internal in its module."""
    rest = re.sub(r"/\*.*?\*/|//[^\n]*|^ *#.*?$|namespace [\w:]* *\{\s*\}", "", text, flags=re.MULTILINE | re.DOTALL)
    included = [library for library, _ in INCLUDE.findall(text) if library]
    return bool(included) and not rest.strip() and \
        any(is_public(each) or module_of(each) != module_of(path) for each in included)


def faults_of_library_file(modules, path, text):
    if only_forwards(path, text):
        yield f"{path} only forwards: a header has one path; remove it"
    for library, quoted in INCLUDE.findall(text):
        if quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'
        yield from faults_of_step(modules, path, library) if library else ()


def faults_of_source(modules, path, text):
    """The faults of the include lines of a file of src, whose headers are only for the sources of their module."""
    for library, quoted in INCLUDE.findall(text):
        yield from faults_of_step(modules, path, library) if library else ()
        if quoted and module_of(quoted) != module_of(path):
            yield f"{path} includes {quoted}: that header is for the sources of its module"


def faults_of_program_file(modules, path, text):
    for _, quoted in INCLUDE.findall(text):
        yield from faults_of_step(modules, path, quoted) if quoted else ()


def faults_of_example(path, text):
    """The faults of an example, which can only use the public interface."""
    for library, _ in INCLUDE.findall(text):
        if library and not is_public(library):
            yield f"{path} includes {library}: that header is internal"
    for name in re.findall(r"\binternal::(\w+)", text):
        yield f"{path} uses internal::{name}: that name is internal"


def faults_of_reach(library, sources, callers):
    """A line for each header that is not included, directly or indirectly, by a public header, a program, a binding, or
    the sources of several modules. Headers that only the sources of one module need belong to src, and are not
    installed."""
    reached = set()
    next_ones = {path for path in library if is_public(path)}
    users = {(path, module_of(source)) for source, text in sources.items() for path, _ in INCLUDE.findall(text)}
    needed = [path for path, _ in users]
    next_ones |= {path for path in needed if path in library and needed.count(path) > 1}
    next_ones |= {path for text in callers for path, _ in INCLUDE.findall(text) if path in library}
    while next_ones:
        reached |= next_ones
        included = {included for path in next_ones for included, _ in INCLUDE.findall(library[path])}
        next_ones = (included & library.keys()) - reached
    return [f"{path} is included by no public header, and by no program or binding; move it to src"
            for path in sorted(library.keys() - reached)]


def faults_of_circles(texts):
    """A line for each header in a cycle of includes, or between two cycles."""
    includes = {path: {a for a, _ in INCLUDE.findall(text) if a in texts} for path, text in texts.items()}
    while True:
        included = set().union(*includes.values()) if includes else set()
        ends = {path for path, steps in includes.items() if not steps or path not in included}
        if not ends:
            break
        includes = {path: steps - ends for path, steps in includes.items() if path not in ends}
    return [f"{path} is in a cycle of includes; remove one" for path in sorted(includes)]


def faults_of_quotes(path, text):
    """Includes of the library in quotes, which no other check finds."""
    for _, quoted in INCLUDE.findall(text):
        if "include/equiaffine/" in quoted:
            yield f'{path} includes "{quoted}": write <equiaffine/...>'


def find_faults(root):
    all_modules = read_modules(root)
    library, sources, program = read_files(root / LIBRARY), read_files(root / "src"), read_files(root / "program")
    modules, parts = all_modules[LIBRARY], all_modules["program"]
    faults = [*faults_of_places(root / LIBRARY)]
    for folder, files, known in ((LIBRARY, library, modules), ("src", sources, modules), ("program", program, parts)):
        faults += (f"{folder}/{path}: there is no such module in cmake/modules.txt"
                   for path in files if module_of(path) not in {*known, None})
    faults += (f"src/{path}: a source stands in the folder of a module" for path in sources if module_of(path) is None)
    if faults:
        return faults
    for folder, files, quoted in ((LIBRARY, library | sources, 0), ("program", program, 1)):
        faults += faults_of_order(folder, all_modules[folder])
        faults += faults_of_uses(folder, all_modules[folder], files, quoted)
    for path, text in library.items():
        faults += faults_of_library_file(modules, path, text)
    faults += faults_of_circles(library)
    callers = [text for folder in ("program", "bindings", "reproduce") for text in read_files(root / folder).values()]
    faults += faults_of_reach(library, sources, callers)
    for path, text in sources.items():
        faults += (f"src/{fault}" for fault in faults_of_source(modules, path, text))
    for path, text in program.items():
        faults += (f"program/{fault}" for fault in faults_of_program_file(parts, path, text))
    for path, text in read_files(root / "examples").items():
        faults += faults_of_example(f"examples/{path}", text)
    for folder in ("src", "program", "examples", "reproduce", "test", "benchmark"):
        for path, text in read_files(root / folder).items():
            faults += faults_of_quotes(f"{folder}/{path}", text)
    return faults


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    if not read_files(root / LIBRARY):
        sys.exit(f"no headers in {root / LIBRARY}; check ROOT")
    found = find_faults(root)
    print("\n".join(found) or "no include line violates the order of the modules")
    sys.exit(bool(found))
