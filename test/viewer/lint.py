# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what is wrong with the script of the page and its programs for the graphics processor:

    lint.py SOURCE TSC GLSLANG

SOURCE is the generated header that has the script, as the page has it, or the root of the project for the script of the
playground. The TypeScript compiler finds names that do not
exist or are not used, calls with a wrong number of arguments, and errors of syntax; types of elements, which are not
declared, are left out. Glslang compiles each program."""
import pathlib
import re
import subprocess
import sys
import tempfile

# No such property of a type, and values of another type than was guessed.
TYPES = {"TS2322", "TS2339", "TS2345", "TS2365"}
OPTIONS = ("--allowJs --checkJs --strict false --noEmit --target es2022 --lib es2022,dom,dom.iterable --noUnusedLocals "
           "--noUnusedParameters").split()
PROGRAM = re.compile(r"const (\w+(Vertex|Fragment)) = (placing \+ )?`(.*?)`;", re.DOTALL)


def script_of(source):
    if source.is_dir():
        sys.path.insert(0, str(source / "bindings/browser"))
        import make_page
        return "const wasmBytes = new ArrayBuffer(0), workerText = '';\n" + make_page.script_of(source)
    parts = source.read_text().split("viewer_script[] = {")[1]
    return "".join(re.findall(r'R"viewer\((.*?)\)viewer"', parts, re.DOTALL))


def faults_of_script(script, tsc, folder):
    (folder / "page.js").write_text(script)
    (folder / "newer.d.ts").write_text("interface Uint8ArrayConstructor { fromBase64?(text: string): Uint8Array }")
    result = subprocess.run([tsc, *OPTIONS, "page.js", "newer.d.ts"], cwd=folder, capture_output=True, text=True, check=False)
    found = re.findall(r"^page\.js\((\d+),\d+\): error (TS\d+): (.*)", result.stdout, re.MULTILINE)
    lines = script.split("\n")
    for line, code, reason in found:
        if code not in TYPES:
            yield f"{code}: {reason}\n    {lines[int(line) - 1].strip()}"
    if result.returncode and not found:
        yield f"{tsc} has status {result.returncode}: {result.stdout}{result.stderr}"


def faults_of_programs(script, glslang, folder):
    placing = re.search(r"const placing = `(.*?)`;", script, re.DOTALL)[1]
    programs = PROGRAM.findall(script)
    if len(programs) < 2:
        yield "the script has no programs"
    for name, stage, has_placing, text in programs:
        path = folder / (name + (".vert" if stage == "Vertex" else ".frag"))
        path.write_text((placing if has_placing else "") + text)
        compiled = subprocess.run([glslang, path], capture_output=True, text=True, check=False)
        if compiled.returncode:
            yield compiled.stdout


if __name__ == "__main__":
    script = script_of(pathlib.Path(sys.argv[1]))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        faults = [*faults_of_script(script, sys.argv[2], folder), *faults_of_programs(script, sys.argv[3], folder)]
    print("\n".join(faults) or "no fault in the script of the page")
    sys.exit(bool(faults))
