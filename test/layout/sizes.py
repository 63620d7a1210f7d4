# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds files and functions that are too long, and headers that are too short: python3 sizes.py ROOT.

Files must have at most 500 lines. Functions of include, src, program and viewer must have at most 60 lines, in C++ and
in JavaScript. The code is formatted by clang-format, so a function ends at the first closing brace with the indentation
of its head.

A header of include, src or program with fewer than 60 lines must have two users, that is, files outside of test that
include it. If there is one user, move its lines there."""
import pathlib
import re
import sys

MOST_LINES_OF_FILE, MOST_LINES_OF_FUNCTION = 500, 60
LEAST_LINES_OF_HEADER_WITH_ONE_USER = 60
SHORT_HEADERS = {  # exceptions with one user, and the reasons
    "include/equiaffine/io/write_curves.h": "it is for callers, as the other writers are",
    "src/display/oklab.h": "its test reads the maps of colors before they are clamped",
}
WITH_FUNCTIONS = ("include", "src", "program", "viewer")
OTHERS = ("test", "benchmark", "examples", "bindings", "reproduce")
WITH_HEADERS = ("include", "src", "program")
INCLUDE = re.compile(r'^ *# *include *[<"]([^>"]+)[>"]', re.MULTILINE)
NO_FUNCTION = re.compile(r"(namespace|class|struct|enum|union|extern|concept|if|else|for|while|do|switch|try|catch|return)\b"
                         r"|[}#@]|//")
END_OF_STATEMENT = re.compile(r"([;{}:]|\*/|^\s*//.*|^\s*#.*|R\"\w*\()$")


def indent(line):
    return len(line) - len(line.lstrip())


def head_of(lines, end):
    """The first line of the declaration whose body begins at the end of line `end`."""
    begin = end
    while begin > 0 and lines[begin - 1].strip() and not END_OF_STATEMENT.search(lines[begin - 1]):
        begin -= 1
    return begin


def end_of(lines, begin, body):
    """The last line of the block that begins at line `begin` and whose body begins at line `body`; None if not a
    block."""
    for n in range(body + 1, len(lines)):
        line = lines[n]
        if line.strip() and not line.startswith("#") and indent(line) <= indent(lines[begin]):
            return n if line.strip().startswith("}") else None
    return None


def functions(text):
    """(first line, number of lines) of each function, lines counted from 1."""
    lines = text.split("\n")
    for n, line in enumerate(lines):
        if not re.search(r"\)[^;=]*\{$|^\s+[:,].*\{$|= \[.*\{$", line):
            continue
        begin = head_of(lines, n)
        head = next((line for line in lines[begin:n + 1] if not line.strip().startswith("template")), "")
        end = end_of(lines, begin, n)
        if end is not None and not NO_FUNCTION.match(head.strip()):
            yield begin + 1, end - begin + 1


def files(root, folders, suffixes):
    """(path relative to the root, text) of each file of the folders."""
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes:
                yield path.relative_to(root).as_posix(), path.read_text()


def users_of_headers(root):
    """A dictionary from paths of headers to the files outside of test that include them."""
    users = {}
    for name, text in files(root, WITH_HEADERS + OTHERS, (".h", ".cpp", ".cxx")):
        if name.startswith("test/"):
            continue
        places = [(root / name).parent, root / name.split("/")[0]] + [root / folder for folder in WITH_HEADERS]
        for included in INCLUDE.findall(text):
            header = next((place / included for place in places if (place / included).is_file()), None)
            if header is not None:
                users.setdefault(header.resolve().relative_to(root.resolve()).as_posix(), set()).add(name)
    return users


def faults_of_headers(root):
    users = users_of_headers(root)
    for name, text in files(root, WITH_HEADERS, (".h",)):
        number = len(users.get(name, ()))
        is_short = text.count("\n") < LEAST_LINES_OF_HEADER_WITH_ONE_USER and number < 2
        if is_short and name not in SHORT_HEADERS:
            lines = f"fewer than {LEAST_LINES_OF_HEADER_WITH_ONE_USER} lines"
            if number == 0:
                yield f"{name}: a header of {lines} that at most tests include; remove it"
            else:
                yield f"{name}: a header of {lines} that only {min(users[name])} includes; make it a part of that file"
        elif not is_short and name in SHORT_HEADERS:
            yield f"{name}: no longer needs an exception in SHORT_HEADERS; remove it there"


def find_faults(root):
    for name, text in [*files(root, WITH_FUNCTIONS, (".h", ".cpp", ".js", ".glsl", ".css", ".html")),
                       *files(root, OTHERS, (".h", ".cpp", ".cxx", ".py"))]:
        if (length := text.count("\n")) > MOST_LINES_OF_FILE:
            yield f"{name} has {length} lines, at most {MOST_LINES_OF_FILE} allowed; split it"
        if name.startswith(tuple(folder + "/" for folder in WITH_FUNCTIONS)):
            for line, length in functions(text):
                if length > MOST_LINES_OF_FUNCTION:
                    yield f"{name}:{line}: a function of {length} lines, at most {MOST_LINES_OF_FUNCTION} allowed; split it"
    yield from faults_of_headers(root)


if __name__ == "__main__":
    found = list(find_faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "no file or function is too long, and no header is too short")
    sys.exit(bool(found))
