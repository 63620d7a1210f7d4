# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that the source package has what its build needs: source_package_test.py ROOT."""
import pathlib
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
FOLDERS = ("bindings/python", "cmake", "include", "packaging", "program", "src", "viewer")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([sys.executable, "setup.py", "--quiet", "egg_info", "--egg-base", folder, "sdist", "--dist-dir", folder],
                       check=True, cwd=ROOT, stderr=subprocess.DEVNULL)
        package, = folder.glob("*.tar.gz")
        with tarfile.open(package) as archive:
            archive.extractall(folder)
        unpacked = folder / package.name[:-len(".tar.gz")]
        sources = {path.relative_to(ROOT) for part in FOLDERS for path in (ROOT / part).rglob("*")
                   if path.is_file() and not {"__pycache__", "equiaffine.egg-info"} & set(path.parts)}
        missing = sorted(str(path) for path in sources if not (unpacked / path).exists())
        assert not missing, f"the source package lacks {missing}"
        subprocess.run(["cmake", "-S", unpacked, "-B", folder / "build", "-G", "Ninja", "-DEQUIAFFINE_BUILD_PYTHON=ON",
                        "-DBUILD_TESTING=OFF", "-DEQUIAFFINE_BUILD_REPRODUCE=OFF", f"-DPython3_EXECUTABLE={sys.executable}"],
                       check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["ninja", "-C", folder / "build", "-t", "query", "equiaffine_python"], check=True,
                       stdout=subprocess.DEVNULL)



if __name__ == "__main__":
    main()
