# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs items and composes the report: python3 -m reproduce --help."""

import argparse
import os
import pathlib
import platform
import sys
import time
import traceback

from .items import ITEMS
from .lab import Lab
from .program import Program
from .report import to_html, to_json


def parse_arguments():
    parser = argparse.ArgumentParser(prog="reproduce", description="Reproduces the paper's figures and tables.")
    parser.add_argument("folder", type=pathlib.Path, help="the output folder of the report")
    parser.add_argument("--program", type=pathlib.Path, required=True, help="the program equiaffine")
    parser.add_argument("--estimates", type=pathlib.Path, required=True, help="the program equiaffine-estimates")
    parser.add_argument("--bunny", type=pathlib.Path, help="the mesh of the Stanford bunny")
    parser.add_argument("--item", action="append", choices=list(ITEMS), help="run only this item; can be repeated")
    parser.add_argument("--small", action="store_true", help="use coarse grids, for a test of a few seconds")
    parser.add_argument("--require", action="store_true", help="fail unless every item holds, not only completes")
    return parser.parse_args()


def run(item, arguments):
    folder = arguments.folder / item.name
    folder.mkdir(parents=True, exist_ok=True)
    bunny = arguments.bunny and arguments.bunny.resolve()
    program = Program(arguments.program.resolve(), folder)
    lab = Lab(program, str(arguments.estimates.resolve()), folder, arguments.small, bunny)
    start, processor_start = time.monotonic(), sum(os.times()[:4])
    try:
        item.work(lab)
    except RuntimeError as error:  # a command failed, or there is nothing to compare
        lab.fail(str(error))
    except Exception as error:  # a bug in the item: continue with the others
        traceback.print_exc()
        lab.fail(f"{type(error).__name__}: {error}")
    seconds, processor_seconds = time.monotonic() - start, sum(os.times()[:4]) - processor_start
    print(f"{item.name:10s} {'holds' if lab.passed else 'does not hold'}  {seconds:6.1f} s, CPU time "
          f"{processor_seconds:.1f} s", flush=True)
    for check in lab.checks:
        if not check.passed:
            print(f"           {check.what}: {check.reason}")
    return lab


def main():
    arguments = parse_arguments()
    names = arguments.item or list(ITEMS)
    start = time.monotonic()
    done = [(ITEMS[name], run(ITEMS[name], arguments)) for name in names]
    facts = (f"{time.strftime('%Y-%m-%d')}, {platform.machine()}, {os.cpu_count()} processors, "
             f"{time.monotonic() - start:.0f} seconds.")
    (arguments.folder / "results.json").write_text(to_json(done), encoding="utf-8")
    (arguments.folder / "report.html").write_text(to_html(done, facts), encoding="utf-8")
    print(f"wrote {arguments.folder / 'report.html'}\nwrote {arguments.folder / 'results.json'}")
    is_good = all(lab.passed if arguments.require else lab.is_complete for _, lab in done)
    return 0 if is_good else 1


sys.exit(main())
