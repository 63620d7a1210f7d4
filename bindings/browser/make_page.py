# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the playground, a single self-contained file: make_page.py ROOT MODULE_FOLDER PAGE.

It combines the page of viewer/, the controls and the script of bindings/browser/, and the module built by
scripts/browser."""
import gzip
import pathlib
import re
import sys

FORBIDDEN = (0, ord("\r"), ord("<"))  # characters that HTML changes in a script element


def part(path):
    """The text of a file after its header comment."""
    return path.read_text().split("\n\n", 1)[1]


def script_of(root):
    """The script of the page, assembled as in cmake/embed_viewer.cmake, and that of the playground."""
    viewer = root / "viewer"
    parts = [part(viewer / f"{name}.js") for name in (viewer / "parts.txt").read_text().split()]
    text = re.sub(r"@([a-z.]+\.glsl)@", lambda match: part(viewer / match[1]).rstrip("\n"), "".join(parts))
    playground = "".join(part(root / f"bindings/browser/{name}.js") for name in ("examples", "tasks", "playground"))
    return "'use strict';\n" + text + playground


def worker_of(root, module_folder):
    """The Emscripten glue, the library and the worker as one classic script."""
    glue = (module_folder / "module.mjs").read_text().replace("import.meta.url", "'file:///'")
    glue = glue.replace("export default Module", "const createModule = Module")
    library = part(root / "bindings/browser/equiaffine.mjs").replace("import.meta.url", "'file:///'")
    library += part(root / "bindings/browser/volume_files.mjs")
    library = re.sub(r"^(import .*|export {.*|export )", "", library, flags=re.MULTILINE)
    return glue + "\n" + library + part(root / "bindings/browser/worker.js")


def packed(name, content):
    """A script element with the compressed content, seven bits per character. A forbidden character is combined with
    the next seven bits into a two-byte character that contains its index in FORBIDDEN. boot.js decodes this."""
    data = gzip.compress(content, 9, mtime=0)
    bits = "".join(f"{byte:08b}" for byte in data)
    sevens = iter([int(bits[k:k + 7].ljust(7, "0"), 2) for k in range(0, len(bits), 7)])
    text = "".join(chr(256 + 128 * FORBIDDEN.index(seven) + next(sevens, 0)) if seven in FORBIDDEN else chr(seven)
                   for seven in sevens)
    return f'<script type="text/plain" id="{name}" data-length="{len(data)}">{text}</script>\n'


def page_of(root, module_folder):
    viewer, browser = root / "viewer", root / "bindings/browser"
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Equi-affine playground</title>
<style>{part(viewer / "page.css")}{part(browser / "playground.css")}</style>
</head>
<body>
{part(viewer / "stage.html")}<aside id="panel">
<h1 id="title">Equi-affine curvatures of a formula</h1>
{part(browser / "playground.html")}{part(viewer / "controls.html")}</aside>
{packed("wasm", (module_folder / "equiaffine.wasm").read_bytes())}{
packed("worker", worker_of(root, module_folder).encode())}{packed("script", script_of(root).encode())}<script>
{part(browser / "boot.js")}</script>
</body>
</html>
"""


if __name__ == "__main__":
    page = page_of(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
    pathlib.Path(sys.argv[3]).write_bytes(page.encode())
    print(f"{sys.argv[3]}: {len(page.encode()) // 1000} kB")
