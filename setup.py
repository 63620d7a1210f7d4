# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the extension module of the Python package with CMake. See pyproject.toml for everything else."""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DEQUIAFFINE_BUILD_PYTHON=ON", "-DBUILD_TESTING=OFF", "-DEQUIAFFINE_BUILD_REPRODUCE=OFF",
                        "-DEQUIAFFINE_UNITY_BUILD=ON", "-DEQUIAFFINE_INSTALL=OFF",
                        f"-DPython3_EXECUTABLE={sys.executable}",
                        *os.environ.get("CMAKE_ARGS", "").split()], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "equiaffine_python"], check=True)
        built, = (build / "bindings/python/equiaffine").glob("_core*.so")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, target)


setup(ext_modules=[Extension("equiaffine._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
