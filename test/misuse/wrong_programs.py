# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles the mistakes of wrong_program.cpp: wrong_programs.py FILE COMPILER [FLAG...]. The first error of each has to
have the words that its comment has, and without a mistake the file has to compile."""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

CASE = re.compile(r"CASE == (\d+) +// (.*)")


def first_error(case):
    result = subprocess.run([*sys.argv[2:], "-std=c++20", "-fsyntax-only", f"-DCASE={case}", sys.argv[1]],
                            capture_output=True, text=True, check=False)
    return next((line for line in result.stderr.splitlines() if re.search(r"\berror: ", line)), "")


def fault(case, words):
    error = first_error(case)
    if words is None:
        return error and f"without a mistake: {error}"
    return "" if words in error else f"case {case}: '{words}' is not in '{error}'"


if __name__ == "__main__":
    cases = [(int(number), words.strip()) for number, words in CASE.findall(pathlib.Path(sys.argv[1]).read_text())]
    if len(cases) < 10:
        sys.exit("there are less than ten mistakes")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [text for text in pool.map(lambda case: fault(*case), [(0, None), *cases]) if text]
    print("\n".join(faults) or f"the compiler explains {len(cases)} mistakes")
    sys.exit(bool(faults))
