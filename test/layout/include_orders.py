# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles all public headers together in a different order: include_orders.py ROOT ORDER COMPILER [FLAG...].

ORDER is `reverse` or `random`. all_headers.h has alphabetic order; with the reverse order, each header comes before
each other one in one of the two. The two random orders, the same in every run, put different headers between them."""
import concurrent.futures
import os
import pathlib
import random
import subprocess
import sys


def first_error(headers, command):
    lines = "".join(f"#include <{header}>\n" for header in headers)
    result = subprocess.run([*command, "-std=c++20", "-fsyntax-only", "-x", "c++", "-"], input=lines,
                            capture_output=True, text=True, check=False)
    error = next((line for line in result.stderr.splitlines() if "error" in line), "")
    return error or (result.stderr if result.returncode else "")


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) / "include"
    headers = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.h")
                     if "internal" not in path.parts)
    if len(headers) < 50:
        sys.exit(f"only {len(headers)} headers found; check ROOT")
    orders = {"reverse": [("reverse", headers[::-1])],
              "random": [(f"random {seed}", random.Random(seed).sample(headers, len(headers)))
                         for seed in (1, 2)]}[sys.argv[2]]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        errors = list(pool.map(lambda order: first_error(order[1], sys.argv[3:]), orders))
    faults = [f"{name} order: {error}\n  " + " ".join(order) for (name, order), error in zip(orders, errors) if error]
    print("\n".join(faults) or f"{len(headers)} headers compile in {len(orders)} orders")
    sys.exit(bool(faults))
