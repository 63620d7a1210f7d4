# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds dead relative links in the Markdown files: python3 links.py ROOT.

A link must lead to an existing file or folder, and its anchor to a heading of this file."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "doc"))
from site_sources import slug  # noqa: E402

NOT_OURS = ("build", "results")
LINK = re.compile(r"\[[^]]*\]\(([^)\s]+)\)")


def without_code(text):
    """The text without blocks and spans of code, with unchanged line numbers."""
    text = re.sub(r"^( *)```.*?^ *```", lambda match: "\n" * match[0].count("\n"), text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"(?<!`)`[^`\n]+`(?!`)", "", text)


def anchors(path):
    """The anchors of the headings of a file on sites such as GitHub; equal headings are numbered."""
    found = {}
    text = re.sub(r"^( *)```.*?^ *```", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)
    for heading in re.findall(r"^#{1,6} (.*)$", text, re.MULTILINE):
        name = slug(heading)
        found[name] = found.get(name, -1) + 1
    return {f"{name}-{n}" if n else name for name, count in found.items() for n in range(count + 1)}


def pages(root):
    """The Markdown files of a checkout, except for build folders."""
    for path in sorted(root.rglob("*.md")):
        folder = path.relative_to(root).parts[0]
        if folder not in NOT_OURS and not folder.startswith("."):
            yield path


def find_faults(root):
    for path in pages(root):
        name, text = path.relative_to(root), without_code(path.read_text())
        for link in LINK.finditer(text):
            target, _, anchor = link[1].partition("#")
            if re.match(r"[a-z]+:", link[1]):
                continue
            file = path.parent / target if target else path
            line = text.count("\n", 0, link.start()) + 1
            if not file.exists():
                yield f"{name}:{line}: the link {link[1]} leads to no file"
            elif anchor and (file.suffix != ".md" or anchor not in anchors(file)):
                yield f"{name}:{line}: the link {link[1]} leads to no heading"


if __name__ == "__main__":
    found = list(find_faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "no dead relative links")
    sys.exit(bool(found))
