# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests site_links.py with dead links in a small site."""
import pathlib
import tempfile
import unittest

from site_links import find_faults


class SiteLinks(unittest.TestCase):
    def faults(self, index, menu=""):
        """The faults in a site with this page and another one in a folder."""
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / "sub").mkdir()
            (site / "sub/a b.html").write_text('<a name="x"/><h2 id="y(z)">text</h2><a href="../index.html">up</a>')
            (site / "style.css").write_text("")
            (site / "menudata.js").write_text(menu)
            (site / "index.html").write_text(index)
            return list(find_faults(site))

    def test_links_to_pages_anchors_and_elsewhere_are_alive(self):
        self.assertEqual([], self.faults('<link href="style.css"/><a href="sub/a%20b.html">a</a><a href="#i">i</a>'
                                         '<p id="i"><a href="sub/a%20b.html#x"></a><a href="sub/a%20b.html#y%28z%29">'
                                         '</a><a href="https://example.org/x">e</a><iframe src="javascript:void(0)">'))

    def test_dead_links_are_found(self):
        self.assertEqual(["index.html: the link #no leads to no anchor",
                          "index.html: the link gone.html leads to no file",
                          "index.html: the link gone.png leads to no file",
                          "index.html: the link sub/a%20b.html#z leads to no anchor"],
                         self.faults('<a href="gone.html"></a><img src="gone.png"/><a href="#no"></a>'
                                     '<a href="sub/a%20b.html#z"></a>'))

    def test_what_is_loaded_from_elsewhere_is_found(self):
        self.assertEqual(["index.html: //example.org/b.css is loaded from elsewhere",
                          "index.html: https://example.org/a.js is loaded from elsewhere"],
                         self.faults('<script src="https://example.org/a.js"></script>'
                                     '<link href="//example.org/b.css"/>'))

    def test_dead_links_of_the_menu_are_found(self):
        self.assertEqual(["menudata.js: the link gone.html leads to no file", "menudata.js: the link index.html#no leads to no anchor"],
                         self.faults("", 'var menudata={children:[{text:"A",url:"gone.html"},{text:"B",url:"index.html"},'
                                         '{text:"C",url:"index.html#no"}]}'))


if __name__ == "__main__":
    unittest.main()
