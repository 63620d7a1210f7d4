# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests include_order.py with every kind of fault in a small checkout."""
import pathlib
import tempfile
import unittest

from include_order import find_faults

MODULES = ("# a comment\n[include/equiaffine]\nlow: | what is low\nother: | what is beside\nhigh: low | what is high\n"
           "\n[program]\nbelow: |\nabove: below |\n")


class IncludeOrder(unittest.TestCase):
    def faults(self, **changed):
        """The faults in a small checkout in which the given files have different text; `__` in a name means `/`."""
        files = {
            "cmake/modules.txt": MODULES,
            "include/equiaffine/low/a.h": "#include <equiaffine/low/internal/b.h>\nclass A {};\n",
            "include/equiaffine/low/internal/b.h": "namespace equiaffine::internal {\nclass B {};\n}\n",
            "include/equiaffine/other/c.h": "\n",
            "include/equiaffine/high/d.h": "#include <equiaffine/low/a.h>\n#include <equiaffine/low/internal/b.h>\n"
                                           "class D {};\n",
            "src/high/mesh.cpp": '#include "high/mesh.h"\n#include <equiaffine/high/d.h>\n'
                                 "#include <equiaffine/low/internal/b.h>\n",
            "src/high/mesh.h": "namespace equiaffine::internal {\n}\n",
            "program/main.cpp": '#include "above/task.h"\n',
            "program/below/file.h": "#include <equiaffine/high/d.h>\n#include <equiaffine/low/internal/b.h>\n",
            "program/above/task.h": '#include "below/file.h"\n#include <equiaffine/low/a.h>\n',
            "examples/e.cpp": "#include <equiaffine/high/d.h>\n#include <equiaffine/low/a.h>\n",
            "test/other/c_test.cpp": '#include "high/mesh.h"\n#include <equiaffine/low/internal/b.h>\ninternal::B b;\n',
            "benchmark/group.cpp": "#include <equiaffine/low/internal/b.h>\ninternal::B b;\n",
            "reproduce/a.cpp": "#include <equiaffine/low/internal/b.h>\ninternal::B b;\n",
        }
        files |= {name.replace("__", "/").replace("_h", ".h").replace("_cpp", ".cpp").replace("_txt", ".txt"): text
                  for name, text in changed.items()}
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return find_faults(root)

    def assert_fault(self, words, **changed):
        faults = self.faults(**changed)
        self.assertTrue(any(words in fault for fault in faults), faults)

    def test_a_checkout_in_order_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_a_header_of_a_higher_module(self):
        self.assert_fault("low/a.h includes high/d.h: low does not use the module high",
                          include__equiaffine__low__a_h="#  include <equiaffine/high/d.h>\n")

    def test_an_internal_header_of_a_module_that_is_not_listed(self):
        self.assert_fault("other/c.h includes low/internal/b.h: other does not use the module low",
                          include__equiaffine__other__c_h="#include <equiaffine/low/internal/b.h>\nclass C {};\n")

    def test_a_header_of_a_module_that_is_not_listed(self):
        self.assert_fault("high/d.h includes other/c.h: high does not use the module other",
                          include__equiaffine__high__d_h="#include <equiaffine/other/c.h>\nclass D {};\n")

    def test_a_header_of_a_module_that_is_not_there(self):
        self.assert_fault("high/d.h includes attic/x.h: there is no such module",
                          include__equiaffine__high__d_h="#include <equiaffine/attic/x.h>\nclass D {};\n")

    def test_a_use_that_no_file_makes(self):
        self.assert_fault("no file of include/equiaffine/high uses low", include__equiaffine__high__d_h="\n",
                          src__high__mesh_cpp="\n")

    def test_a_use_that_only_sources_make(self):
        self.assertEqual(self.faults(include__equiaffine__high__d_h="\n"), [])

    def test_a_use_that_no_file_of_the_program_makes(self):
        self.assert_fault("no file of program/above uses below",
                          program__above__task_h="#include <equiaffine/low/a.h>\n")

    def test_modules_that_use_each_other(self):
        self.assert_fault("low uses high, which is not above it",
                          cmake__modules_txt=MODULES.replace("low: | what", "low: high | what"))

    def test_a_module_that_uses_one_that_is_not_there(self):
        self.assert_fault("low uses attic, which is not above it",
                          cmake__modules_txt=MODULES.replace("low: | what", "low: attic | what"))

    def test_a_header_directly_in_the_folder_of_the_library(self):
        self.assert_fault("entry.h: a header is MODULE/x.h or MODULE/internal/x.h",
                          include__equiaffine__entry_h="class Entry {};\n")

    def test_a_header_in_a_folder_that_is_no_place_of_headers(self):
        for name in ("include__equiaffine__low__part__x_h", "include__equiaffine__low__internal__part__x_h"):
            self.assert_fault("/part/x.h: a header is MODULE/x.h or MODULE/internal/x.h", **{name: "class X {};\n"})

    def test_a_file_among_the_headers_that_is_none(self):
        self.assert_fault("low/a.cpp: a header is MODULE/x.h", include__equiaffine__low__a_cpp="\n")

    def test_a_folder_of_headers_that_is_no_module(self):
        self.assert_fault("include/equiaffine/attic/x.h: there is no such module", include__equiaffine__attic__x_h="\n")

    def test_a_folder_of_sources_that_is_no_module(self):
        self.assert_fault("src/attic/x.cpp: there is no such module", src__attic__x_cpp="\n")

    def test_a_source_in_no_folder(self):
        self.assert_fault("src/x.cpp: a source stands in the folder of a module", src__x_cpp="\n")

    def test_a_folder_of_the_program_that_is_no_module(self):
        self.assert_fault("program/attic/x.cpp: there is no such module", program__attic__x_cpp="\n")

    def test_a_header_that_only_forwards(self):
        for text in ("// Why.\n#ifndef X_H\n#define X_H\n\n#include <equiaffine/low/a.h>\n\n#endif\n",
                     "#pragma once\n#include <equiaffine/low/a.h>\n",
                     "/* Why. */\n#include <equiaffine/low/a.h>\n",
                     "#include <equiaffine/low/internal/b.h>\n",
                     "#include <equiaffine/low/a.h>\n#include <equiaffine/low/internal/b.h>\n",
                     "#include <equiaffine/low/a.h> // IWYU pragma: export\n#include <vector>\n",
                     "#include <equiaffine/low/a.h>\nnamespace equiaffine {\n}\n"):
            self.assert_fault("high/forward.h only forwards: a header has one path",
                              include__equiaffine__high__forward_h=text)

    def test_a_header_that_puts_together_what_is_internal_in_its_module(self):
        self.assertEqual(self.faults(include__equiaffine__low__sum_h="#include <equiaffine/low/internal/b.h>\n"), [])

    def test_headers_that_include_each_other(self):
        self.assert_fault("cycle", include__equiaffine__low__internal__b_h="#include <equiaffine/low/a.h>\n")

    def test_a_header_that_sources_alone_need(self):
        self.assert_fault("low/internal/c.h is included by no public header",
                          include__equiaffine__low__internal__c_h="class C {};\n",
                          src__high__mesh_h="#include <equiaffine/low/internal/c.h>\n")

    def test_a_header_that_sources_of_two_modules_need(self):
        include = "#include <equiaffine/low/internal/c.h>\n"
        self.assertEqual(self.faults(include__equiaffine__low__internal__c_h="class C {};\n", src__low__a_cpp=include,
                                     src__high__b_cpp=include), [])

    def test_a_header_that_a_program_or_a_binding_needs(self):
        for name in ("program__below__file_h", "bindings__python__core_cpp"):
            self.assertEqual([], self.faults(include__equiaffine__low__internal__c_h="class C {};\n",
                                             **{name: "#include <equiaffine/low/internal/c.h>\n"}))

    def test_a_quoted_include_in_the_library(self):
        self.assert_fault("write <equiaffine/...>", include__equiaffine__low__a_h='#include "internal/b.h"\n')

    def test_a_quoted_path_into_the_library(self):
        self.assert_fault("write <equiaffine/...>",
                          test__high__a_test_cpp='#include "../../include/equiaffine/low/internal/b.h"\n')

    def test_a_source_that_includes_a_header_of_a_module_that_is_not_listed(self):
        self.assert_fault("src/high/mesh.cpp includes other/c.h: high does not use the module other",
                          src__high__mesh_cpp="#include <equiaffine/other/c.h>\n")

    def test_a_source_that_includes_the_private_header_of_another_module(self):
        self.assert_fault("src/low/a.cpp includes high/mesh.h: that header is for the sources of its module",
                          src__low__a_cpp='#include "high/mesh.h"\n')

    def test_the_program_including_upwards(self):
        self.assert_fault("program/below/file.h includes above/task.h: below does not use the module above",
                          program__below__file_h='#include "above/task.h"\n')

    def test_the_program_including_a_private_header_of_the_library(self):
        self.assert_fault("program/main.cpp includes high/mesh.h: there is no such module",
                          program__main_cpp='#include "high/mesh.h"\n')

    def test_an_example_that_includes_what_is_internal(self):
        self.assert_fault("examples/e.cpp includes low/internal/b.h: that header is internal",
                          examples__e_cpp="#include <equiaffine/low/internal/b.h>\n")

    def test_an_example_that_uses_an_internal_name(self):
        self.assert_fault("examples/e.cpp uses internal::B: that name is internal", examples__e_cpp="internal::B b;\n")


if __name__ == "__main__":
    unittest.main()
