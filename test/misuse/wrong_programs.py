# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles the mistakes of wrong_program.cpp: wrong_programs.py FILE COMPILER [FLAG...]. The first error of each has to
have the words that its comment has, and without a mistake the file has to compile. The headers are compiled once."""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

CASE = re.compile(r"CASE == (\d+) +// (.*)")
INCLUDE = re.compile(r"^#include .*\n", re.MULTILINE)


def first_error(arguments):
    result = subprocess.run([*sys.argv[2:], "-std=c++20", *arguments], capture_output=True, text=True, check=False)
    return next((line for line in result.stderr.splitlines() if re.search(r"\berror: ", line)), "")


def fault(program, headers, case, words):
    error = first_error(["-include", str(headers), "-Winvalid-pch", "-fsyntax-only", f"-DCASE={case}", str(program)])
    if words is None:
        return error and f"without a mistake: {error}"
    return "" if words in error else f"case {case}: '{words}' is not in '{error}'"


if __name__ == "__main__":
    text = pathlib.Path(sys.argv[1]).read_text()
    cases = [(int(number), words.strip()) for number, words in CASE.findall(text)]
    if len(cases) < 10:
        sys.exit("there are fewer than ten mistakes")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        headers, program = pathlib.Path(folder, "headers.h"), pathlib.Path(folder, "program.cpp")
        headers.write_text("".join(INCLUDE.findall(text)))
        program.write_text(INCLUDE.sub("", text))
        error = first_error(["-x", "c++-header", str(headers), "-o", f"{headers}.gch"])
        if error:
            sys.exit(error)
        faults = [text for text in pool.map(lambda case: fault(program, headers, *case), [(0, None), *cases]) if text]
    print("\n".join(faults) or f"the compiler explains {len(cases)} mistakes")
    sys.exit(bool(faults))
