// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/display/internal/trust.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace trust_test {

using namespace equiaffine;
using Columns = std::vector<Vertex_attributes::Column>;

std::string first_of(Columns columns) {
  Vertex_attributes attributes;
  attributes.columns = std::move(columns);
  return first_shown(attributes);
}

const Vertex_attributes::Column affine = {"affine_gaussian_curvature", {1, -2, 3}},
                                pick = {"pick_invariant", {1, 1, 1}}, gaussian = {"gaussian_curvature", {4, 5, 6}},
                                mean = {"mean_curvature", {7, 8, 9}}, normal = {"nx", {1, 0, 0}};

Vertex_attributes::Column errors(std::vector<double> values) {
  return {"affine_gaussian_curvature_error", std::move(values)};
}

TEST(Trust, numbers_without_errors_are_shown_by_rank) {
  EXPECT_EQ(first_of({normal, gaussian, mean, pick, affine}), "affine_gaussian_curvature");
  EXPECT_EQ(first_of({normal, gaussian, mean, pick}), "pick_invariant");
}

TEST(Trust, numbers_smaller_than_their_errors_are_not_shown_first_nor_what_is_made_of_the_same_derivatives) {
  EXPECT_EQ(first_of({normal, gaussian, mean, affine, pick, errors({0.1, 5, 7})}), "mean_curvature");
  EXPECT_EQ(first_of({normal, gaussian, mean, affine, pick, errors({0.1, 5, 0.1})}), "affine_gaussian_curvature");
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(first_of({gaussian, affine, errors({infinity, nan, 0.1})}), "gaussian_curvature");
}

TEST(Trust, errors_are_parts_of_sizes_that_are_not_zero_where_curvatures_change_their_sign) {
  const Vertex_attributes::Column K = {"affine_gaussian_curvature", {0.1, 0, -0.1}},
                                  H = {"affine_mean_curvature", {1, 1, 1}};
  EXPECT_EQ(first_of({gaussian, K, H, errors({0.4, 0.4, 0.4})}), "affine_gaussian_curvature");
  EXPECT_EQ(first_of({gaussian, K, H, errors({0.6, 0.6, 0.6})}), "gaussian_curvature");
  const Vertex_attributes::Column angle = {"affine_normal_angle", {2, 3, 4}},
                                  error = {"affine_normal_angle_error", {14, 14, 16}};
  EXPECT_EQ(first_of({K, H, errors({6, 6, 6}), angle, error}), "affine_normal_angle");
}

TEST(Trust, errors_of_vectors_are_no_quantities) {
  const Vertex_attributes::Column error = {"affine_normal_error", {1, 1, 1}}, x = {"affine_normal_x", {1, 0, 0}};
  EXPECT_TRUE(first_of({x, error}) == "plain");
}

TEST(Trust, a_sentence_says_which_numbers_are_unknown_at_most_vertices) {
  Vertex_attributes attributes;
  attributes.columns = {gaussian, affine, errors({0.1, 5, 7})};
  const std::vector<std::string> sentences = sentences_of_doubt(attributes);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0],
            "Affine Gaussian curvature is unknown at 67 % of the vertices: its error exceeds half its size");
  attributes.columns.back() = errors({0.1, 0.1, 7});
  EXPECT_TRUE(sentences_of_doubt(attributes).empty());
}

TEST(Trust, what_noise_makes_of_a_number_is_not_shown_first) {
  const Vertex_attributes::Column noise = {"affine_gaussian_curvature_noise", {1, 1, 1}};
  EXPECT_EQ(first_of({affine, errors({9, 9, 9}), noise}), "affine_gaussian_curvature");
  EXPECT_EQ(first_of({noise}), "affine_gaussian_curvature_noise");
}

TEST(Trust, columns_of_others_are_shown_first_only_where_there_is_nothing_of_ours) {
  const Vertex_attributes::Column other = {"fit_outcome", {0, 0, 1}};
  EXPECT_EQ(first_of({other, affine, errors({9, 9, 9})}), "affine_gaussian_curvature");
  EXPECT_EQ(first_of({normal, other}), "fit_outcome");
}

TEST(Trust, something_is_shown_even_if_nothing_is_trusted) {
  EXPECT_EQ(first_of({normal, affine, errors({9, 9, 9})}), "affine_gaussian_curvature");
  EXPECT_EQ(first_of({normal}), "plain");
  Vertex_attributes attributes;
  attributes.status.emplace(3, Point_status::REGULAR);
  EXPECT_EQ(first_shown(attributes), "status");
}

TEST(Trust, a_column_without_numbers_is_not_shown_first) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vertex_attributes::Column none = {"affine_gaussian_curvature", {nan, nan, nan}};
  EXPECT_EQ(first_of({none, gaussian}), "gaussian_curvature");
  EXPECT_EQ(first_of({none, errors({nan, nan, nan}), gaussian}), "gaussian_curvature");
  EXPECT_EQ(first_of({none}), "plain");
}

TEST(Trust, a_color_is_in_doubt_by_the_share_of_the_bar_that_the_error_takes) {
  const Color_range diverging = {-4, 4, 1, true}, sequential = {0, 8, 1, false};
  for (const Color_range& range : {diverging, sequential}) {
    EXPECT_EQ(color_doubt(2, 0, Color_mapping{range}), 0);
    EXPECT_DOUBLE_EQ(color_doubt(2, 1, Color_mapping{range}), 0.5);
    EXPECT_EQ(color_doubt(2, 2, Color_mapping{range}), 1);
    EXPECT_EQ(color_doubt(2, std::numeric_limits<double>::infinity(), Color_mapping{range}), 1);
    EXPECT_EQ(color_doubt(100, 50, Color_mapping{range}), 0) << "the whole interval has the end color";
  }
}

} // namespace trust_test
