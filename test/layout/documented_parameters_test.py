# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests documented_parameters.py with every kind of difference between comments and functions."""
import unittest

from documented_parameters import find_faults

INTERNAL = """
  inline auto size(int n) CONST {   \\
    return internal::add_parameter<internal::Size_tag>(n, GIVEN);   \\
  }   \\
  EQUIAFFINE_VERTEX_MAP(map_of_k, K_tag, CONST, GIVEN)   \\
  EQUIAFFINE_VERTEX_MAP(map_of_h, H_tag, CONST, GIVEN)
using Map_tags = Tag_list<K_tag, H_tag>;
template <class Parameters, class... OtherTags>
constexpr void check_map_parameters() {
  check_parameters_of_list<Parameters, OtherTags...>(Map_tags());
}
"""


def function(comment, tags, name="f", check="check_parameters", template="internal::Parameter_chain... Parameters"):
    """A function with a comment, which checks these tags."""
    lines = "".join(f"/// {line}\n" for line in comment.split("\n"))
    known = ", ".join(["Joined_parameters<Parameters...>", *(f"internal::{tag}" for tag in tags.split())])
    body = f"{{\n  internal::{check}<{known}>();\n}}\n\n"
    return f"{lines}template <{template}>\nvoid {name}(const Parameters&... given) {body}"


class DocumentedParameters(unittest.TestCase):
    def faults(self, header, other=""):
        return list(find_faults({"a.h": header, "b.h": other, "base/internal/list.h": INTERNAL}))

    def test_a_table_of_what_a_function_takes_is_right(self):
        self.assertEqual([], self.faults(function("| `size`, `map_of_k` | int |", "Size_tag K_tag")))
        self.assertEqual([], self.faults(function("Takes `size`.\n| `map_of_k`, `map_of_h` |", "Size_tag",
                                                  check="check_map_parameters")))

    def test_a_parameter_without_documentation_is_found(self):
        self.assertEqual(["a.h: f takes map_of_k, but does not document it"],
                         self.faults(function("| `size` | map_of_k |", "Size_tag K_tag")))
        self.assertEqual(["a.h: f takes map_of_h, but does not document it"],
                         self.faults(function("| `map_of_k` |", "", check="check_map_parameters")))

    def test_a_row_for_what_a_function_does_not_take_is_found(self):
        self.assertEqual(["a.h: f documents map_of_k, but does not take it"],
                         self.faults(function("| `size`, `map_of_k` |", "Size_tag")))
        self.assertEqual(["a.h: f documents no_parameter, but does not take it"],
                         self.faults(function("| `no_parameter` |\n`size`", "Size_tag")))

    def test_the_same_means_the_functions_above(self):
        above = function("| `size` |", "Size_tag") + function("The same with `map_of_k`.", "Size_tag K_tag")
        self.assertEqual([], self.faults(above + function("The same.", "Size_tag K_tag")))
        self.assertEqual(["a.h: f takes size, but does not document it"],
                         self.faults(above + function("More.", "Size_tag")))
        self.assertEqual(["a.h: f takes map_of_h, but does not document it"],
                         self.faults(above + function("The same.", "Size_tag H_tag")))

    def test_those_of_another_function_are_in_its_header(self):
        comment, other = "Its parameters are those of g().", function("| `size` |", "Size_tag", "g")
        self.assertEqual([], self.faults(function(comment, "Size_tag"), other))
        self.assertEqual(["a.h: f takes size, but does not document it"],
                         self.faults(function(comment.replace("g()", "h()"), "Size_tag"), other))

    def test_every_way_to_take_parameters_is_known(self):
        for template in ("internal::Parameter_chain Parameters = internal::No_parameters,\n"
                         "          internal::Parameter_chain Other_parameters = internal::No_parameters",
                         "class Parameters = internal::No_parameters",
                         "internal::Parameter_chain Parameters = internal::No_parameters,\n"
                         "          std::derived_from<CGAL::Sequential_tag> Tag = CGAL::Parallel_if_available_tag"):
            self.assertEqual(["a.h: f takes size, but does not document it"],
                             self.faults(function("None.", "Size_tag", template=template)))


if __name__ == "__main__":
    unittest.main()
