# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants faults in the code of a small checkout, for the compiler $CXX."""
import os
import pathlib
import tempfile
import unittest

from code_blocks import find_faults

PREAMBLE = """#define CGAL_VERSION_NUMBER(x, y, z) (10000 * x + 100 * y + 10 * z)
#define CGAL_VERSION_NR CGAL_VERSION_NUMBER(5, 5, 1)
extern int given;
"""


class CodeBlocks(unittest.TestCase):
    def faults(self, *blocks):
        """The faults in a checkout whose README contains these blocks, each after an empty line and the line ```cpp."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "test/documentation").mkdir(parents=True)
            (root / "test/documentation/code_blocks.h").write_text(PREAMBLE)
            (root / "README.md").write_text("".join(f"\n```cpp\n{block}\n```\n" for block in blocks))
            return find_faults(root, [os.environ.get("CXX", "c++")])

    def only_fault(self, *blocks):
        faults = [line for line in self.faults(*blocks) if "error: " in line]
        self.assertEqual(1, len(faults), faults)
        return faults[0]

    def test_blocks_are_functions_that_know_what_is_given(self):
        self.assertEqual([], self.faults("int i = given;\nnamespace s = std;", "int i = 2 * given;"))

    def test_includes_classes_and_templates_stand_before_the_function(self):
        self.assertEqual([], self.faults("#include <vector>\nstruct S {\n  template <class T> void f(T) {}\n};\n\n"
                                         "template <class T>\nT g(T t) {\n  return t;\n}\n"
                                         "S().f(g(std::vector<int>()));", "struct S;\nS* s = nullptr;"))

    def test_a_fault_is_found_in_its_line(self):
        self.assertRegex(self.only_fault("int i = given;", "int i = 1;\ni = taken;"), r"^README\.md:8:.*taken")
        self.assertRegex(self.only_fault("int i;\nstruct S {\n  T t;\n};\ni = 1;"), r"^README\.md:5:.*T")
        self.assertRegex(self.only_fault("int i;\n#include <no_such_header>"), r"^README\.md:4:.*no_such_header")

    def test_a_block_does_not_know_another_one(self):
        self.assertRegex(self.only_fault("int i = given;", "int j = i;"), r"^README\.md:7:")

    def test_a_block_in_a_list_is_compiled(self):
        text = "int i;\n```\n\n- text\n\n  ```cpp\n  taken;\n  ```\n\n```cpp"
        self.assertRegex(self.only_fault(text), r"^README\.md:9:")

    def test_a_block_for_a_newer_CGAL_is_left_out(self):
        text = "int i;\n```\n\n<!-- needs CGAL %s -->\n```cpp\ntaken;"
        self.assertEqual([], self.faults(text % "6.1"))
        self.assertRegex(self.only_fault(text % "5.5"), r"^README\.md:8:")

    def test_other_code_is_not_compiled(self):
        self.assertEqual([], self.faults("int i;\n```\n\n```sh\nls\n```\n\n```\ntaken\n```\n\n```cpp"))


if __name__ == "__main__":
    unittest.main()
