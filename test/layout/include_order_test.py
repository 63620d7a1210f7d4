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
            "cmake/rooms.txt": "# a comment\ninclude/equiaffine low high\nsrc below above\n",
            "include/equiaffine/door.h": "#include <equiaffine/high/door.h>\n",
            "include/equiaffine/low/a.h": "#include <equiaffine/low/internal/b.h>\n",
            "include/equiaffine/low/internal/b.h": "#include <vector>\n",
            "include/equiaffine/high/door.h": "#include <equiaffine/low/a.h>\n",
            "src/main.cpp": '#include "above/task.h"\n',
            "src/below/file.h": "#include <equiaffine/door.h>\n",
            "src/above/task.h": '#include "below/file.h"\n#include <equiaffine/low/a.h>\n',
            "mesher/mesh.cpp": '#include "mesh.h"\n#include <equiaffine/high/door.h>\n',
        }
        files |= {name.replace("__", "/").replace("_h", ".h").replace("_cpp", ".cpp"): text
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
        self.assert_fault("low/a.h includes high/door.h: the room high is above low",
                          include__equiaffine__low__a_h="#include <equiaffine/high/door.h>\n")

    def test_the_own_header_of_another_room(self):
        self.assert_fault("that header is its room's own",
                          include__equiaffine__high__door_h="#include <equiaffine/low/internal/b.h>\n")

    def test_the_porch_from_inside(self):
        self.assert_fault("the porch is for users only",
                          include__equiaffine__high__door_h="#  include <equiaffine/door.h>\n")

    def test_the_own_header_of_a_room_from_the_porch(self):
        self.assert_fault("that header is its room's own",
                          include__equiaffine__door_h="#include <equiaffine/low/internal/b.h>\n")

    def test_a_folder_that_is_no_room(self):
        self.assert_fault("there is no such room", include__equiaffine__attic__x_h="\n")

    def test_a_quoted_include_in_the_library(self):
        self.assert_fault("write <equiaffine/...>", include__equiaffine__low__a_h='#include "internal/b.h"\n')

    def test_a_public_header_that_is_no_door(self):
        self.assert_fault("low/a.h is no door", include__equiaffine__low__a_h="namespace equiaffine::internal {\n}\n")

    def test_headers_that_include_each_other(self):
        self.assert_fault("circle", include__equiaffine__low__internal__b_h="#include <equiaffine/low/a.h>\n")

    def test_the_program_reaching_into_a_room(self):
        self.assert_fault("src/main.cpp includes low/internal/b.h",
                          src__main_cpp="#include <equiaffine/low/internal/b.h>\n")

    def test_the_program_reaching_into_a_room_with_quotes(self):
        self.assert_fault("that header is its room's own",
                          src__above__task_h='#include "equiaffine/low/internal/b.h"\n')

    def test_the_program_including_upwards(self):
        self.assert_fault("the room above is above below", src__below__file_h='#include "above/task.h"\n')

    def test_the_mesher_reaching_into_a_room(self):
        self.assert_fault("mesher/mesh.cpp includes", mesher__mesh_cpp="#include <equiaffine/low/internal/b.h>\n")


if __name__ == "__main__":
    unittest.main()
