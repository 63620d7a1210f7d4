# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests sizes.py with files and functions of the maximum length, longer ones, and headers with too few users."""
import pathlib
import tempfile
import unittest

from sizes import find_faults, functions


def function(lines, head="int f(int x) {"):
    return "\n".join([head] + ["  g(x);"] * (lines - 2) + ["}"]) + "\n"


class Sizes(unittest.TestCase):
    def faults_of(self, files):
        """The faults in a checkout with these files, a dictionary from paths to texts."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(find_faults(pathlib.Path(folder)))

    def faults(self, text):
        """The faults in a checkout with one header and two files that include it."""
        user = "#include <equiaffine/module/a.h>\n"
        return self.faults_of({"include/equiaffine/module/a.h": text, "src/a.cpp": user, "src/b.cpp": user})

    def test_a_file_of_500_lines_is_not_too_long_and_one_of_501_is(self):
        self.assertEqual(self.faults("int x;\n" * 500), [])
        self.assertIn("module/a.h has 501 lines", self.faults("int x;\n" * 501)[0])

    def test_files_of_tests_and_examples_have_the_same_limit_and_functions_there_have_none(self):
        for name in ("test/a/a_test.cpp", "test/a/a_test.py", "benchmark/a.h", "examples/a.cpp", "bindings/a/a.cxx",
                     "reproduce/a.py"):
            self.assertEqual(self.faults_of({name: function(500)}), [])
            self.assertIn(f"{name} has 501 lines", self.faults_of({name: function(501)})[0])

    def test_a_short_header_has_two_users_outside_of_the_tests(self):
        header, user = "program/cli/a.h", '#include "cli/a.h"\n'
        users = {"program/cli/a.cpp": '#include "a.h"\n', "program/main.cpp": user}
        self.assertEqual(self.faults_of({header: "int x;\n" * 59, **users}), [])
        del users["program/main.cpp"]
        self.assertEqual(self.faults_of({header: "int x;\n" * 60, **users}), [])
        users["test/program/a_test.cpp"] = user
        self.assertIn("program/cli/a.h: a header of fewer than 60 lines that only program/cli/a.cpp includes",
                      self.faults_of({header: "int x;\n" * 59, **users})[0])
        self.assertIn("that at most tests include", self.faults_of({header: "int x;\n", "test/a.cpp": user})[0])

    def test_headers_of_one_name_in_two_folders_have_users_of_their_own(self):
        user = '#include "m/a.h"\n'
        found = self.faults_of({"src/m/a.h": "", "program/m/a.h": "", "src/b.cpp": user, "program/b.cpp": user})
        self.assertEqual(len(found), 2)

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
