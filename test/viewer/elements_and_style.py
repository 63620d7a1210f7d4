# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what is wrong with the elements and the style of the page:

    elements_and_style.py VIEWER NODE TIDY

VIEWER is the folder of the files of the page. HTML Tidy reads the elements as one page, CSSTree the style. A rule whose
element, class or name is nowhere else in the page is a fault, too."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PAGE = '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>page</title></head><body>\n{}</body></html>\n'


def faults_of_elements(viewer):
    parts = [viewer / "stage.html", viewer / "controls.html"]
    with tempfile.NamedTemporaryFile("w", suffix=".html") as page:
        page.write(PAGE.format("".join(part.read_text() for part in parts)))
        page.flush()
        result = subprocess.run([sys.argv[3], "-quiet", "-errors", "--drop-empty-elements", "no", page.name],
                                capture_output=True, text=True, check=False)
    return [f"stage.html and controls.html: {line}" for line in result.stderr.splitlines()]


def faults_of_style(viewer, node):
    checker = pathlib.Path(__file__).with_name("style_faults.js")
    modules = os.environ | {"NODE_PATH": "/usr/share/nodejs"}
    result = subprocess.run([node, checker, viewer / "page.css"], capture_output=True, text=True, check=False, env=modules)
    return (result.stdout + result.stderr).splitlines() if result.returncode else []


def unused_rules(viewer):
    """The names and classes for which there is a rule and nothing else."""
    rest = "".join(path.read_text() for path in sorted(viewer.iterdir()) if path.suffix in (".html", ".js"))
    selectors = re.findall(r"([^{}]*)\{", re.sub(r"/\*.*?\*/", "", (viewer / "page.css").read_text(), flags=re.DOTALL))
    names = {name for selector in selectors for name in re.findall(r"[#.]([a-zA-Z][\w-]*)", selector)}
    return [f"page.css: nothing in the page is called {name}" for name in sorted(names)
            if not re.search(rf"\b{name}\b", rest)]


if __name__ == "__main__":
    viewer = pathlib.Path(sys.argv[1])
    faults = [*faults_of_elements(viewer), *faults_of_style(viewer, sys.argv[2]), *unused_rules(viewer)]
    print("\n".join(faults) or "no fault in the elements and the style of the page")
    sys.exit(bool(faults))
