# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds macros of equiaffine that remain defined after its public headers: macros.py ROOT COMPILER [FLAG...]."""
import pathlib
import subprocess
import sys

root, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
include = root / "include"
headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h") if "internal" not in path.parts)
text = "".join(f"#include <{header}>\n" for header in headers)
result = subprocess.run([*command, f"-I{include}", "-std=c++20", "-x", "c++", "-dM", "-E", "-"], input=text, check=True,
                        capture_output=True, text=True)
names = [line.split()[1].partition("(")[0] for line in result.stdout.splitlines()]
guards = [name for name in names if name.startswith("EQUIAFFINE_") and name.endswith("_H")]
leaked = [name for name in names if name.startswith("EQUIAFFINE_") and not name.endswith("_H")]
if len(guards) < len(headers) / 2:
    sys.exit("the compiler did not read the headers; check ROOT and COMPILER")
print("\n".join(f"{name} is defined after the public headers" for name in leaked) or "no macro leaks")
sys.exit(bool(leaked))
