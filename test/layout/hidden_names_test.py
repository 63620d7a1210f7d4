# SPDX-License-Identifier: GPL-3.0-or-later
import unittest

import hidden_names

OUTER = """namespace equiaffine {

/// Whether it is known.
template <class Point>
constexpr bool check_coordinates() {
  return true;
}

} // namespace equiaffine
"""


def internal(function):
    return f"namespace equiaffine::internal {{\n\n{function}\n\n}} // namespace equiaffine::internal\n"


class HiddenNames(unittest.TestCase):
    def faults(self, inner):
        return list(hidden_names.find_faults({"a.h": OUTER, "b.h": inner}))

    def test_a_function_that_hides_another_is_found(self):
        self.assertEqual(self.faults(internal("inline void check_coordinates(const Mesh& mesh) {\n  f(mesh);\n}")),
                         ["b.h: equiaffine::internal::check_coordinates hides equiaffine::check_coordinates of a.h: "
                          "rename one of them"])

    def test_namespaces_within_internal_count(self):
        inner = "namespace equiaffine::internal {\n\nnamespace parts {\n\nbool check_coordinates(int n) {\n}\n\n"
        self.assertEqual(len(self.faults(inner + "} // namespace parts\n\n} // namespace equiaffine::internal\n")), 1)

    def test_calls_members_and_other_names_hide_nothing(self):
        for function in ("bool check_coordinate(int n) {\n  return check_coordinates(n);\n}",
                         "struct Mesh {\n  bool check_coordinates(int n) const;\n};",
                         "// void check_coordinates(int n)"):
            self.assertEqual(self.faults(internal(function)), [])

    def test_overloads_in_one_namespace_hide_nothing(self):
        self.assertEqual(list(hidden_names.find_faults({"a.h": OUTER, "b.h": OUTER})), [])


if __name__ == "__main__":
    unittest.main()
