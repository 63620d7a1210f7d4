# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public header of a function refuses what the library cannot be compiled with: wrong_flags.py ROOT COMPILER
[FLAG...]. Names of functions are lower case; headers of types may be mere structs."""
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r"#include <(equiaffine/[^>]+)>")
CHECK = "equiaffine/base/internal/compiler.h"
REFUSED = {"-ffast-math": "compile without -ffast-math", "-Ofast": "compile without -ffast-math",
           "-ffinite-math-only": "compile without -ffast-math", "-std=c++17": "equiaffine needs C++20"}


def reached(folder, header, seen):
    """Adds the headers of the library that a header includes, also by way of others."""
    if header not in seen:
        seen.add(header)
        if (folder / header).exists():
            for included in INCLUDE.findall((folder / header).read_text()):
                reached(folder, included, seen)
    return seen


def first_error(flags):
    result = subprocess.run([*flags, "-x", "c++", "-E", "-o", "/dev/null", "-"], input=f"#include <{CHECK}>\n",
                            capture_output=True, text=True, check=False)
    return next((line for line in result.stderr.splitlines() if "error" in line), "")


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) / "include"
    compiler = [*sys.argv[2:], f"-I{folder}", "-std=c++20"]
    headers = sorted(path.relative_to(folder).as_posix() for path in (folder / "equiaffine").glob("*/[a-z]*.h"))
    faults = [f"{header} does not include {CHECK}" for header in headers if CHECK not in reached(folder, header, set())]
    faults += [f"{flag}: '{words}' is not in '{first_error([*compiler, flag])}'"
               for flag, words in REFUSED.items() if words not in first_error([*compiler, flag])]
    if not headers or first_error(compiler):
        faults.append(f"{len(headers)} public headers; without a wrong flag: {first_error(compiler)}")
    print("\n".join(faults) or f"{len(headers)} headers refuse {', '.join(REFUSED)}")
    sys.exit(bool(faults))
