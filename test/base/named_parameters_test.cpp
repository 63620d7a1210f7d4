// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/named_parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <gtest/gtest.h>


namespace named_parameters_test {

using namespace equiaffine;
using internal::get_parameter;
using internal::has_parameter;

TEST(Named_parameters, a_parameter_that_is_not_given_has_its_default) {
  EXPECT_EQ(get_parameter<internal::Point_tag>(parameters::default_values(), 7), 7);
  EXPECT_EQ(get_parameter<internal::Point_tag>(parameters::feature_curves(1), 7), 7);
}

TEST(Named_parameters, every_parameter_of_a_chain_is_found) {
  const auto given = parameters::point_map(1).feature_curves(2).vertex_status_map(3).comments(4);
  EXPECT_EQ(get_parameter<internal::Point_tag>(given, 0), 1);
  EXPECT_EQ(get_parameter<internal::Feature_curves_tag>(given, 0), 2);
  EXPECT_EQ(get_parameter<internal::Vertex_status_tag>(given, 0), 3);
  EXPECT_EQ(get_parameter<internal::Comments_tag>(given, 0), 4);
}

TEST(Named_parameters, the_last_one_given_counts) {
  EXPECT_EQ(get_parameter<internal::Point_tag>(parameters::point_map(1).point_map(2), 0), 2);
}

TEST(Named_parameters, joined_chains_of_both_libraries_are_one_in_which_the_last_one_counts) {
  const auto chain = parameters::joined(parameters::comments(1).geom_traits(2), CGAL::parameters::vertex_point_map(3),
                                        parameters::default_values(), parameters::comments(4));
  EXPECT_EQ(get_parameter<internal::Comments_tag>(chain, 0), 4);
  EXPECT_EQ(get_parameter<internal::Geom_traits_tag>(chain, 0), 2);
  EXPECT_EQ(get_parameter<internal::Vertex_point_tag>(chain, 0), 3);
}

TEST(Named_parameters, a_parameter_is_given_or_not) {
  using Given = decltype(parameters::point_map(1).comments(2));
  EXPECT_TRUE((has_parameter<internal::Comments_tag, Given>));
  EXPECT_FALSE((has_parameter<internal::Feature_curves_tag, Given>));
}

} // namespace named_parameters_test
