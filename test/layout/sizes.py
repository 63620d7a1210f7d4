# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which files and functions are too long to be read at a sitting: python3 sizes.py ROOT.

Files of include, src, program and viewer have at most 500 lines, functions there at most 60, in C++ as in JavaScript.
The code is formatted by clang-format, so that a function ends at the first closing brace as far left as its head."""
import pathlib
import re
import sys

MOST_LINES_OF_FILE, MOST_LINES_OF_FUNCTION = 500, 60
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
    """The line that closes what begins at line `begin` and has a body from line `body` on; None if that is no block."""
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


def find_faults(root):
    for folder in ("include", "src", "program", "viewer"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp", ".js", ".glsl", ".css", ".html"):
                continue
            name, text = path.relative_to(root).as_posix(), path.read_text()
            if (length := text.count("\n")) > MOST_LINES_OF_FILE:
                yield f"{name} has {length} lines, {MOST_LINES_OF_FILE} at most: can one idea be one file?"
            for line, length in functions(text):
                if length > MOST_LINES_OF_FUNCTION:
                    yield f"{name}:{line}: a function of {length} lines, {MOST_LINES_OF_FUNCTION} at most"


if __name__ == "__main__":
    found = list(find_faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "no file and no function is too long")
    sys.exit(bool(found))
