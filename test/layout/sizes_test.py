# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes files and functions that are just short enough, and one line too long."""
import pathlib
import tempfile
import unittest

from sizes import find_faults, functions


def function(lines, head="int f(int x) {"):
    return "\n".join([head] + ["  g(x);"] * (lines - 2) + ["}"]) + "\n"


class Sizes(unittest.TestCase):
    def faults(self, text):
        """Of a checkout with one header."""
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder) / "include/equiaffine/module/a.h"
            header.parent.mkdir(parents=True)
            header.write_text(text)
            return list(find_faults(pathlib.Path(folder)))

    def test_a_file_of_500_lines_is_not_too_long_and_one_of_501_is(self):
        self.assertEqual(self.faults("int x;\n" * 500), [])
        self.assertIn("module/a.h has 501 lines", self.faults("int x;\n" * 501)[0])

    def test_a_function_of_60_lines_is_not_too_long_and_one_of_61_is(self):
        self.assertEqual(self.faults(function(60)), [])
        self.assertIn("a.h:1: a function of 61 lines", self.faults(function(61))[0])

    def test_the_lines_of_a_function_begin_with_its_head(self):
        head = "template <class T>\nvoid f(const T& x,\n       const T& y) {"
        self.assertEqual(list(functions(function(10, head))), [(1, 12)])

    def test_a_constructor_and_a_member_in_a_class_are_functions(self):
        text = ("class A {\npublic:\n  A(int x, int y)\n      : x_(x), y_(y) {\n    g();\n  }\n"
                "  int f() const {\n    return 1;\n  }\n};\n")
        self.assertEqual(list(functions(text)), [(3, 4), (7, 3)])

    def test_a_constant_made_by_a_lambda_is_a_function(self):
        self.assertIn("a function of 61 lines", self.faults(function(61, "inline constexpr int x = [] {"))[0])

    def test_a_loop_and_a_class_are_no_functions(self):
        self.assertEqual(list(functions("struct A\n    : B(1) {\n  int x;\n};\nfor (;;) {\n}\n")), [])

    def test_a_function_of_a_script_counts(self):
        self.assertIn("61 lines", self.faults('auto script = R"js(\n' + function(61, "function f(x) {") + ')js";\n')[0])


if __name__ == "__main__":
    unittest.main()
