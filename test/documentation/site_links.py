# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds dead links and external resources of a site in a folder: python3 site_links.py SITE.

Reads each page once, whereas LinkChecker reads a page again for each anchor, ten times as much in total."""
import html.parser
import pathlib
import re
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The anchors, the link targets and the loaded resources of a page."""
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loads = set(), set(), set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        (self.links if tag in ("a", "area") else self.loads).update(
            values[key] for key in ("href", "src", "data") if values.get(key))


class Menu:
    """The links of the menu, which are in a script of Doxygen."""
    def __init__(self, path):
        self.links, self.loads = set(re.findall(r'url:"([^"]*)"', path.read_text())), set()


def find_faults(site):
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    menus = {path: Menu(path) for path in site.glob("menudata.js")}
    for path, page in (pages | menus).items():
        name = path.relative_to(site).as_posix()
        for link in sorted(page.links | page.loads):
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                if link in page.loads and url.netloc:
                    yield f"{name}: {link} is loaded from elsewhere"
                continue
            target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
            if not target.is_file():
                yield f"{name}: the link {link} leads to no file"
            elif url.fragment and target in pages and urllib.parse.unquote(url.fragment) not in pages[target].anchors:
                yield f"{name}: the link {link} leads to no anchor"


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]).resolve()
    if not (folder / "index.html").is_file():
        sys.exit(f"no index.html in {folder}; run scripts/documentation")
    found = list(find_faults(folder))
    print("\n".join(found) or "no dead links in the site")
    sys.exit(bool(found))
