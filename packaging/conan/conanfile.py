# SPDX-License-Identifier: GPL-3.0-or-later
"""A Conan 2 recipe for the library (not tested):
conan create packaging/conan -s compiler.cppstd=20 --build=missing"""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Equiaffine(ConanFile):
    name = "equiaffine"
    version = "1.0.0"
    license = "GPL-3.0-or-later"
    description = "Euclidean and equi-affine curvatures of implicit surfaces, in the style of CGAL"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    default_options = {"onetbb/*:tbbmalloc": True}  # required by CGAL's target for TBB

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for part in ("CMakeLists.txt", "LICENSE", "CHANGELOG.md", "cmake/*", "include/*", "src/*", "packaging/*", "viewer/*"):
            copy(self, part, root, self.export_sources_folder)

    def requirements(self):
        for package in ("cgal/[>=5.5 <7]", "onetbb/[>=2021.8]"):
            self.requires(package, transitive_headers=True)
        for package in ("eigen/[>=3.4 <6]", "boost/[>=1.74]"):
            self.requires(package, transitive_headers=True, force=True)  # the recipe of cgal requires a single version

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({"EQUIAFFINE_BUILD_PROGRAM": "OFF", "EQUIAFFINE_BUILD_REPRODUCE": "OFF",
                                          "BUILD_TESTING": "OFF"})
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "equiaffine")
        headers = self.cpp_info.components["headers"]
        headers.set_property("cmake_target_name", "equiaffine::headers")
        headers.requires = ["cgal::cgal", "eigen::eigen", "boost::headers", "onetbb::libtbb", "onetbb::tbbmalloc"]
        headers.defines = ["CGAL_LINKED_WITH_TBB"]
        library = self.cpp_info.components["library"]
        library.set_property("cmake_target_name", "equiaffine::equiaffine")
        library.libs = ["equiaffine"]
        library.requires = ["headers"]
