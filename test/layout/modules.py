# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads cmake/modules.txt."""
import collections

Module = collections.namedtuple("Module", "uses contents")


def read_modules(root):
    """A dictionary: folder -> {name of a module: the modules that it uses, and its contents}, in the order of the
    file."""
    folders = {}
    for line in (root / "cmake/modules.txt").read_text().splitlines():
        if line.startswith("["):
            modules = folders.setdefault(line.strip("[]"), {})
        elif line and not line.startswith("#"):
            name, text = line.split(":", 1)
            uses, contents = text.split("|", 1)
            modules[name] = Module(uses.split(), contents.strip())
    return folders
