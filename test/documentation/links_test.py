# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests links.py with dead links in a small checkout."""
import pathlib
import tempfile
import unittest

from links import find_faults


class Links(unittest.TestCase):
    def faults(self, readme):
        """The faults in a checkout with this README, a page and a picture."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "doc").mkdir()
            (root / "doc/page.md").write_text("# Page\n\n## What `f(x)` is\n\n## Again\n\n```sh\n# none\n```\n\n## Again\n")
            (root / "doc/a.png").write_text("")
            (root / "README.md").write_text(readme)
            return list(find_faults(root))

    def test_links_to_files_folders_and_headings_are_alive(self):
        self.assertEqual([], self.faults(
            "# Title\n\n[a](doc/page.md) ![b](doc/a.png) [c](doc) [d](doc/page.md#what-fx-is) [e](#title)\n"
            "[in two\nlines](doc/page.md#again-1) [elsewhere](https://example.org/x)\n"))

    def test_a_link_to_no_file_is_found(self):
        self.assertEqual(["README.md:2: the link doc/gone.md leads to no file"], self.faults("x\n[a](doc/gone.md)\n"))

    def test_a_link_to_no_heading_is_found(self):
        self.assertEqual(["README.md:1: the link doc/page.md#gone leads to no heading",
                          "README.md:1: the link doc/page.md#none leads to no heading",
                          "README.md:1: the link #again-2 leads to no heading"],
                         self.faults("[a](doc/page.md#gone) [b](doc/page.md#none) [c](#again-2)\n"))

    def test_code_has_no_links(self):
        self.assertEqual([], self.faults("`a[0](b)`\n\n```cpp\nx[1](y)\n```\n"))


if __name__ == "__main__":
    unittest.main()
