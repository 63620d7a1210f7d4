# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles the C++ code of the Markdown files: code_blocks.py ROOT COMPILER [FLAG...].

Each ```cpp block becomes a function in one translation unit, after test/documentation/code_blocks.h, which includes all
public headers and declares the variables that the pages assume. `#include` lines, classes and templates of a block are
moved before its function. A comment `<!-- needs CGAL 6.1 -->` on the line before a block excludes it for older versions
of CGAL. Errors of the compiler refer to the page and its line."""
import pathlib
import re
import subprocess
import sys
import textwrap

from links import pages

BLOCK = re.compile(r"(?:<!-- needs CGAL (\d+)\.(\d+) -->\n)?^( *)```(?:cpp|c\+\+)[^\n]*\n(.*?)^\3```",
                   re.MULTILINE | re.DOTALL | re.IGNORECASE)
INCLUDE = re.compile(r"^#[^\n]*$", re.MULTILINE)
DECLARATION = re.compile(r"^(?:template|struct|class|enum|concept)\b(?:[^\n]*;$|.*?^\}[^\n]*;?$)",
                         re.MULTILINE | re.DOTALL)


def cut(pattern, code):
    """The parts of the code that match the pattern, and the rest, with unchanged line numbers."""
    rest = pattern.sub(lambda match: "\n" * match[0].count("\n"), code)
    found = "\n".join("" if line == left else line for line, left in zip(code.split("\n"), rest.split("\n")))
    return found, rest


def function_of(number, place, code):
    """The block as C++ at namespace scope; `place` is its `#line` directive."""
    includes, code = cut(INCLUDE, code)
    declarations, statements = cut(DECLARATION, code)
    return (f"{place}\n{includes}\nnamespace block_{number} {{\n{place}\n{declarations}\n"
            f"void code() {{\n{place}\n{statements}\n}}\n}}\n")


def unit_of(root):
    """(number of blocks, C++ code of all of them)."""
    blocks = []
    for path in pages(root):
        text = path.read_text()
        for match in BLOCK.finditer(text):
            place = f'#line {text.count(chr(10), 0, match.start(4)) + 1} "{path.relative_to(root).as_posix()}"'
            block = function_of(len(blocks), place, textwrap.dedent(match[4]))
            version = f"#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER({match[1]}, {match[2]}, 0)\n"
            blocks.append(f"{version}{block}#endif\n" if match[1] else block)
    return len(blocks), "".join(blocks)


def find_faults(root, command):
    """The compiler's error lines that refer to a page, or all of them if none does."""
    preamble = root / "test/documentation/code_blocks.h"
    command = [*command, "-std=c++20", "-fsyntax-only", "-include", str(preamble), "-x", "c++", "-"]
    result = subprocess.run(command, input=unit_of(root)[1], capture_output=True, text=True, check=False)
    lines = [line for line in result.stderr.splitlines() if re.match(r"[^ ]+\.md:\d+:|.*\berror: ", line)]
    return lines or ([result.stderr] if result.returncode else [])


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]).resolve()
    count = unit_of(folder)[0]
    if count < 10:
        sys.exit("fewer than ten blocks of C++ found; check ROOT")
    found = find_faults(folder, sys.argv[2:])
    print("\n".join(found) or f"{count} blocks of C++ compile")
    sys.exit(bool(found))
