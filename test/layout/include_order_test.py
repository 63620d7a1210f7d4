# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the order of a small checkout in every way that include_order.py is to find."""
import pathlib
import tempfile
import unittest

from include_order import find_faults


class IncludeOrder(unittest.TestCase):
    def faults(self, **changed):
        """Of a checkout with two rooms each, where the files that are named have other text; `__` stands for `/`."""
        files = {
            "cmake/rooms.txt": "# a comment\n[include/equiaffine]\nlow: | what is low\nhigh: low | what is high\n"
                               "other: | what is beside\n\n[program]\nbelow: |\nabove: below |\n"
                               "[porch]\nhigh: entry\n[looks inside]\nreproduce/a.cpp: low\n",
            "include/equiaffine/entry.h": "#include <equiaffine/high/door.h>\nclass Entry {};\n",
            "include/equiaffine/low/a.h": "#include <equiaffine/low/internal/b.h>\nclass A {};\n",
            "include/equiaffine/low/internal/shared/s.h": "namespace equiaffine::internal {\nclass Shared {};\n}\n",
            "include/equiaffine/low/internal/b.h": "namespace equiaffine::internal {\nclass Hidden {};\n}\n",
            "include/equiaffine/other/c.h": "\n",
            "include/equiaffine/high/door.h": "#include <equiaffine/low/a.h>\n#include <equiaffine/low/internal/shared/s.h>\n"
                                              "class Door {};\n",
            "program/main.cpp": '#include "above/task.h"\ninternal::Shared shared;\n',
            "program/below/file.h": "#include <equiaffine/entry.h>\n#include <equiaffine/low/internal/shared/s.h>\n",
            "examples/e.cpp": "#include <equiaffine/entry.h>\n#include <equiaffine/low/a.h>\n",
            "program/above/task.h": '#include "below/file.h"\n#include <equiaffine/low/a.h>\n',
            "src/high/mesh.cpp": '#include "high/mesh.h"\n#include <equiaffine/high/door.h>\n',
            "src/high/mesh.h": "namespace equiaffine::internal {\n}\n",
            "reproduce/a.cpp": "internal::Hidden hidden;\n",
            "test/low/b_test.cpp": "#include <equiaffine/low/internal/b.h>\ninternal::Hidden hidden;\n",
            "benchmark/group_low.cpp": "internal::Hidden hidden;\n",
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

    def test_a_header_of_a_higher_room(self):
        self.assert_fault("low/a.h includes high/door.h: low does not use the room high",
                          include__equiaffine__low__a_h="#include <equiaffine/high/door.h>\n")

    def test_the_own_header_of_another_room(self):
        self.assert_fault("that header is its room's own",
                          include__equiaffine__high__door_h="#include <equiaffine/low/internal/b.h>\n")

    def test_a_header_of_the_porch_that_belongs_to_a_higher_room(self):
        self.assert_fault("low/a.h includes entry.h: low does not use the room high",
                          include__equiaffine__low__a_h="#  include <equiaffine/entry.h>\n")

    def test_the_own_header_of_another_room_from_the_porch(self):
        self.assert_fault("entry.h includes low/internal/b.h: that header is its room's own",
                          include__equiaffine__entry_h="#include <equiaffine/low/internal/b.h>\n")

    def test_a_header_of_the_porch_without_a_room(self):
        self.assert_fault("new.h: cmake/rooms.txt does not say which room", include__equiaffine__new_h="\n")

    def test_a_header_of_the_porch_that_is_not_there(self):
        self.assert_fault("there is no gone.h on the porch",
                          cmake__rooms_txt="[include/equiaffine]\nlow: |\nhigh: low |\nother: |\n"
                                           "[porch]\nhigh: entry gone\n[program]\nbelow: |\nabove: below |\n")

    def test_a_header_that_only_forwards(self):
        self.assert_fault("other/c.h only forwards: a header has one path", include__equiaffine__other__c_h=
                          "// Why.\n#ifndef C_H\n#define C_H\n\n#include <equiaffine/low/a.h>\n\n#endif\n")

    def test_a_header_that_only_forwards_in_other_words(self):
        for text in ("#pragma once\n#include <equiaffine/low/a.h>\n",
                     "/* Why. */\n#include <equiaffine/low/a.h>\n",
                     "#include <equiaffine/low/a.h>\n#include <equiaffine/low/internal/shared/s.h>\n",
                     "#include <equiaffine/low/a.h> // IWYU pragma: export\n#include <vector>\n",
                     "#include <equiaffine/low/a.h>\nnamespace equiaffine {\n}\n"):
            self.assert_fault("high/forward.h only forwards", include__equiaffine__high__forward_h=text)

    def test_a_header_that_puts_together_what_is_its_own(self):
        self.assertEqual(self.faults(include__equiaffine__low__sum_h="#include <equiaffine/low/internal/b.h>\n"), [])

    def test_a_header_where_none_belongs(self):
        self.assert_fault("low/part/x.h: a header is X.h, ROOM/X.h", include__equiaffine__low__part__x_h="class X {};\n")

    def test_a_header_of_the_porch_in_two_rooms(self):
        self.assert_fault("entry.h belongs to two rooms",
                          cmake__rooms_txt="[include/equiaffine]\nlow: |\nhigh: low |\nother: |\n"
                                           "[porch]\nlow: entry\nhigh: entry\n[program]\nbelow: |\nabove: below |\n")

    def test_a_room_of_the_porch_that_is_not_there(self):
        self.assert_fault("there is no room attic",
                          cmake__rooms_txt="[include/equiaffine]\nlow: |\nhigh: low |\nother: |\n"
                                           "[porch]\nattic: entry\n[program]\nbelow: |\nabove: below |\n")

    def test_a_shared_header_that_nobody_shares(self):
        self.assert_fault("low/internal/shared/alone.h is shared with nobody",
                          include__equiaffine__low__internal__shared__alone_h="class Alone {};\n")

    def test_a_file_that_looks_inside_and_is_not_there(self):
        self.assert_fault("there is no file reproduce/gone.cpp",
                          cmake__rooms_txt="[include/equiaffine]\nlow: |\nhigh: low |\nother: |\n[porch]\nhigh: entry\n"
                                           "[program]\nbelow: |\nabove: below |\n[looks inside]\nreproduce/gone.cpp: low\n")

    def test_a_folder_of_the_program_that_is_no_room(self):
        self.assert_fault("program/attic/x.cpp: there is no such room", program__attic__x_cpp="\n")

    def test_a_test_that_opens_the_namespace_internal(self):
        for text in ("using namespace equiaffine::internal;\n", "namespace i = equiaffine::internal;\n",
                     "namespace equiaffine::internal {\n}\n"):
            self.assert_fault("test/high/a_test.cpp opens the namespace internal", test__high__a_test_cpp=text)

    def test_a_quoted_path_into_the_library(self):
        self.assert_fault("write <equiaffine/...>",
                          test__high__a_test_cpp='#include "../../include/equiaffine/low/internal/b.h"\n')

    def test_the_name_of_another_room_in_a_source(self):
        self.assert_fault("src/high/mesh.cpp uses internal::Hidden", src__high__mesh_cpp="internal::Hidden hidden;\n")

    def test_the_name_of_a_room_in_an_example(self):
        self.assert_fault("examples/e.cpp uses internal::Shared", examples__e_cpp="internal::Shared shared;\n")

    def test_functions_and_constants_are_names_of_a_room(self):
        for definition in ("inline int hidden(int x) {\n", "inline constexpr int hidden = 3;\n",
                           "[[noreturn]] inline void hidden(int x) {\n", "using hidden = int;\n",
                           "template <class T>\nconcept hidden = true;\n", "enum class hidden { A };\n"):
            self.assert_fault("program/main.cpp uses internal::hidden", program__main_cpp="internal::hidden(3);\n",
                              include__equiaffine__low__internal__b_h="namespace equiaffine::internal {\n" + definition)

    def test_the_namespace_internal_of_GoogleTest(self):
        self.assertEqual(self.faults(test__high__a_test_cpp="testing::internal::Hidden hidden;\n"), [])

    def test_a_benchmark_of_peers_is_at_home(self):
        self.assertEqual(self.faults(benchmark__peers__low_peers_cpp="internal::Hidden hidden;\n"), [])

    def test_a_use_that_nothing_makes_in_the_program(self):
        self.assert_fault("no file of program/above uses below", program__above__task_h="#include <equiaffine/low/a.h>\n")

    def test_an_example_that_includes_what_is_internal(self):
        self.assert_fault("examples/e.cpp includes low/internal/shared/s.h: that header is internal",
                          examples__e_cpp="#include <equiaffine/low/internal/shared/s.h>\n")

    def test_the_name_of_another_room_in_the_library(self):
        self.assert_fault("high/door.h uses internal::Hidden: that name is its room's own",
                          include__equiaffine__high__door_h="#include <equiaffine/low/a.h>\ninternal::Hidden hidden;\n")

    def test_a_folder_that_is_no_room(self):
        self.assert_fault("there is no such room", include__equiaffine__attic__x_h="\n")

    def test_a_quoted_include_in_the_library(self):
        self.assert_fault("write <equiaffine/...>", include__equiaffine__low__a_h='#include "internal/b.h"\n')

    def test_a_public_header_that_is_no_door(self):
        self.assert_fault("low/a.h is for users", include__equiaffine__low__a_h="namespace equiaffine::internal {\n}\n")

    def test_headers_that_include_each_other(self):
        self.assert_fault("circle", include__equiaffine__low__internal__b_h="#include <equiaffine/low/a.h>\n")

    def test_the_program_reaching_into_a_room(self):
        self.assert_fault("program/main.cpp includes low/internal/b.h",
                          program__main_cpp="#include <equiaffine/low/internal/b.h>\n")

    def test_the_program_reaching_into_a_room_with_quotes(self):
        self.assert_fault("that header is its room's own",
                          program__above__task_h='#include "equiaffine/low/internal/b.h"\n')

    def test_the_program_including_upwards(self):
        self.assert_fault("below does not use the room above", program__below__file_h='#include "above/task.h"\n')

    def test_a_room_that_is_not_listed_among_those_used(self):
        self.assert_fault("high does not use the room other",
                          include__equiaffine__high__door_h="#include <equiaffine/other/c.h>\n")

    def test_a_use_that_nothing_makes(self):
        self.assert_fault("no file of include/equiaffine/high uses low", include__equiaffine__high__door_h="\n")

    def test_rooms_that_use_each_other(self):
        self.assert_fault("low may use high, which is not above it",
                          cmake__rooms_txt="[include/equiaffine]\nlow: high |\nhigh: low |\nother: |\n"
                                           "[porch]\nhigh: entry\n[program]\nbelow: |\nabove: below |\n")

    def test_the_name_of_another_room_in_a_test(self):
        self.assert_fault("test/high/a_test.cpp uses internal::Hidden: that name is its room's own",
                          test__high__a_test_cpp="auto x = equiaffine::internal::Hidden();\n")

    def test_the_own_header_of_another_room_in_a_benchmark(self):
        self.assert_fault("benchmark/high/a.cpp uses low/internal/b.h: that header is its room's own",
                          benchmark__high__a_cpp="#include <equiaffine/low/internal/b.h>\n")

    def test_the_name_of_a_room_in_the_program(self):
        self.assert_fault("program/main.cpp uses internal::Hidden", program__main_cpp="internal::Hidden hidden;\n")

    def test_what_a_door_exports(self):
        self.assertEqual(self.faults(
            program__main_cpp="internal::Hidden hidden;\n",
            include__equiaffine__low__a_h="#include <equiaffine/low/internal/b.h> // IWYU pragma: export\nclass A {};\n"), [])

    def test_a_source_reaching_into_another_room(self):
        self.assert_fault("src/high/mesh.cpp includes low/internal/b.h: that header is its room's own",
                          src__high__mesh_cpp="#include <equiaffine/low/internal/b.h>\n")

    def test_a_source_that_includes_the_header_of_another_rooms_sources(self):
        self.assert_fault("src/low/a.cpp includes high/mesh.h: that header is its room's own",
                          src__low__a_cpp='#include "high/mesh.h"\n')

    def test_a_source_of_a_room_that_is_not_listed_among_those_used(self):
        self.assert_fault("src/high/mesh.cpp includes other/c.h: high does not use the room other",
                          src__high__mesh_cpp="#include <equiaffine/other/c.h>\n")

    def test_a_folder_of_sources_that_is_no_room(self):
        self.assert_fault("src/attic/x.cpp: there is no such room", src__attic__x_cpp="\n")

    def test_a_header_that_sources_alone_need(self):
        self.assert_fault("low/internal/c.h is included by no header for users",
                          include__equiaffine__low__internal__c_h="class C {};\n")


if __name__ == "__main__":
    unittest.main()
