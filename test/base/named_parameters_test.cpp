// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/named_parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace named_parameters_test {

using namespace equiaffine;
using internal::get_parameter;
using internal::has_parameter;

using Nodes = std::array<std::size_t, 3>;

TEST(Named_parameters, a_parameter_that_is_not_given_has_its_default) {
  EXPECT_EQ(get_parameter<internal::Clip_tag>(parameters::default_values(), 7), 7);
  EXPECT_EQ(get_parameter<internal::Clip_tag>(parameters::facet_sizing(1), 7), 7);
}

TEST(Named_parameters, every_parameter_of_a_chain_is_found) {
  const auto given = parameters::clip(1).facet_sizing(2).number_of_nodes({3, 4, 5}).comments(6);
  EXPECT_EQ(get_parameter<internal::Clip_tag>(given, 0), 1);
  EXPECT_EQ(get_parameter<internal::Facet_sizing_tag>(given, 0), 2);
  EXPECT_EQ(get_parameter<internal::Number_of_nodes_tag>(given, Nodes{}), (Nodes{3, 4, 5}));
  EXPECT_EQ(get_parameter<internal::Comments_tag>(given, 0), 6);
}

TEST(Named_parameters, the_last_one_given_counts) {
  EXPECT_EQ(get_parameter<internal::Clip_tag>(parameters::clip(1).clip(2), 0), 2);
}

TEST(Named_parameters, a_negative_number_of_nodes_is_refused) {
  EXPECT_THROW(parameters::number_of_nodes(-5), std::invalid_argument);
  EXPECT_THROW(parameters::skip_empty_space().planes_per_slab(-1L), std::invalid_argument);
}

TEST(Named_parameters, one_number_of_nodes_is_that_of_every_axis) {
  EXPECT_EQ(get_parameter<internal::Number_of_nodes_tag>(parameters::number_of_nodes(9), Nodes{}), (Nodes{9, 9, 9}));
}

TEST(Named_parameters, joined_chains_of_both_libraries_are_one_in_which_the_last_one_counts) {
  const auto chain = parameters::joined(parameters::scale(1).noise(2), CGAL::parameters::vertex_point_map(3),
                                        parameters::default_values(), parameters::scale(4));
  EXPECT_EQ(get_parameter<internal::Scale_tag>(chain, std::optional<double>()), 4);
  EXPECT_EQ(get_parameter<internal::Noise_tag>(chain, std::optional<double>()), 2);
  EXPECT_EQ(get_parameter<internal::Vertex_point_tag>(chain, 0), 3);
}

TEST(Named_parameters, a_parameter_without_value_is_given_or_not) {
  using Given = decltype(parameters::vertex_position(1).skip_empty_space());
  EXPECT_TRUE((has_parameter<internal::Skip_empty_space_tag, Given>));
  EXPECT_FALSE((has_parameter<internal::Parabolic_features_tag, Given>));
}

} // namespace named_parameters_test
