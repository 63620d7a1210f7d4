# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what is wrong with the elements and the style of the page:

    elements_and_style.py VIEWER NODE TIDY MODULES

VIEWER is the folder of the files of the page, MODULES the one of those of Node. HTML Tidy reads the elements as one page,
CSSTree the style. A rule whose element, class or name is nowhere else in the page is a fault, too, and a label of
nothing."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PAGE = '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>page</title></head><body>\n{}</body></html>\n'
TYPES_OF_EVERY_PAGE = {"html", "body"}


def text_of(viewer, *suffixes):
    return "".join(path.read_text() for path in sorted(viewer.iterdir()) if path.suffix in suffixes)


def faults_of_elements(viewer, tidy):
    text = "".join((viewer / name).read_text() for name in ("stage.html", "controls.html"))
    with tempfile.NamedTemporaryFile("w", suffix=".html") as page:
        page.write(PAGE.format(text))
        page.flush()
        result = subprocess.run([tidy, "-errors", "--drop-empty-elements", "no", page.name], capture_output=True,
                                text=True, check=False)
    names = set(re.findall(r'\bid="([^"]+)"', text))
    lost = [f"there is no element {name} for a label" for name in re.findall(r'\bfor="([^"]+)"', text) if name not in names]
    if "No warnings or errors were found." in result.stderr + result.stdout:
        return lost
    lines = [line for line in result.stderr.splitlines() if re.match(r"line \d+", line)]
    return lost + [f"stage.html and controls.html: {line}" for line in lines or ["HTML Tidy says nothing"]]


def faults_of_style(viewer, node, modules):
    checker = pathlib.Path(__file__).with_name("style_faults.js")
    result = subprocess.run([node, checker, viewer / "page.css"], capture_output=True, text=True, check=False,
                            env=os.environ | {"NODE_PATH": modules})
    lines = (result.stdout + result.stderr).splitlines()
    return [] if lines == ["no fault in style sheets"] else lines or ["page.css: CSSTree says nothing"]


def unused_rules(viewer):
    """The elements, names and classes for which there is a rule and nothing else."""
    head = (viewer.parent / "src/display/write_page.cpp").read_text()
    elements, script = text_of(viewer, ".html") + head, text_of(viewer, ".js")
    quoted = " ".join(re.findall(r"'[^'\n]*'|\"[^\"\n]*\"|`[^`]*`", script)) + " ".join(re.findall(r'"[^"\n]*"', elements))
    style = re.sub(r"/\*.*?\*/|\[[^\]]*\]|:+[\w-]+", "", (viewer / "page.css").read_text(), flags=re.DOTALL)
    selectors = [text for text in re.findall(r"([^{};]*)\{", style) if "@" not in text]
    for selector in selectors:
        for mark, name in re.findall(r"([#.]?)\b([a-zA-Z][\w-]*)", selector):
            where = quoted if mark else "".join(re.findall(r"<\w+", elements)) + quoted
            if not re.search(rf"(?<![\w-]){name}(?![\w-])", where) and name not in TYPES_OF_EVERY_PAGE:
                yield f"page.css: nothing in the page is called {mark}{name}"


if __name__ == "__main__":
    viewer = pathlib.Path(sys.argv[1])
    faults = [*faults_of_elements(viewer, sys.argv[3]), *faults_of_style(viewer, sys.argv[2], sys.argv[4]),
              *sorted(set(unused_rules(viewer)))]
    print("\n".join(faults) or "no fault in the elements and the style of the page")
    sys.exit(bool(faults))
