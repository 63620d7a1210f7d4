// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace Attribute_selection_test {

using namespace equiaffine;

TEST(Attribute_selection, the_names_are_the_contract_in_its_order) {
  const auto names = [](const char* list) {
    std::string joined;
    for (const Attribute& a : select_attributes(list).columns) joined += std::string(a.name) + " ";
    return joined;
  };
  const std::string basic = "nx ny nz k1 k2 gaussian_curvature mean_curvature conormal_x conormal_y conormal_z "
                            "affine_normal_x affine_normal_y affine_normal_z affine_gaussian_curvature "
                            "affine_mean_curvature pick_invariant ";
  const std::string later = "affine_normal_angle affine_area_density ";
  EXPECT_EQ(names("basic"), basic + later);
  EXPECT_EQ(names("all"), basic +
                              "affine_k1 affine_k2 direction1_x direction1_y direction1_z direction2_x direction2_y "
                              "direction2_z metric_xx metric_xy metric_xz metric_yy metric_yz metric_zz " +
                              later);
  EXPECT_EQ(names("none"), "");
  EXPECT_EQ(names("metric_xx,normal,k2"), "metric_xx nx ny nz k2 ") << "in the order that they are asked for";
  EXPECT_EQ(names("nz,status,k2,normal,k2,nz"), "nz k2 nx ny ") << "each of them once";
  EXPECT_EQ(names("status"), "");
  EXPECT_FALSE(select_attributes("none").has_status);
  EXPECT_TRUE(select_attributes("status").has_status);
  EXPECT_THROW(select_attributes("k3"), Input_error);
  EXPECT_THROW(select_attributes("k1,"), Input_error);
  EXPECT_THROW(select_attributes(""), Input_error);
}

std::string joined(const std::vector<std::string_view>& names) {
  std::string result;
  for (const std::string_view name : names) result += std::string(name) + " ";
  return result;
}

TEST(Attribute_selection, names_for_people_have_vectors_by_one_name) {
  const Attribute_names names = attribute_names();
  EXPECT_EQ(joined(names.basic), "normal k1 k2 gaussian_curvature mean_curvature conormal affine_normal "
                                 "affine_gaussian_curvature affine_mean_curvature pick_invariant affine_normal_angle "
                                 "affine_area_density ");
  EXPECT_EQ(joined(names.added_by_all), "affine_k1 affine_k2 direction1 direction2 metric ");
  EXPECT_EQ(joined(names.by_name),
            "quadric_defect shape_index curvedness vertex_area affine_area affine_frame1 affine_frame2 "
            "affine_frame3 affine_frame_scale affine_frame_quality affine_signature ");
  EXPECT_EQ(joined(names.signature), "affine_gaussian_curvature affine_mean_curvature pick_invariant "
                                     "affine_gaussian_curvature_gradient affine_mean_curvature_gradient "
                                     "pick_invariant_gradient ");
}

TEST(Attribute_selection, every_name_is_that_of_one_row) {
  for (const auto& row : attribute_table<double>) {
    const auto columns = select_attributes(row.name).columns;
    ASSERT_EQ(columns.size(), row.size()) << row.name;
    for (std::size_t i = 0; i < row.size(); ++i) {
      EXPECT_EQ(columns[i].name, row.column(i));
      EXPECT_EQ(select_attributes(row.column(i)).columns.size(), row.column(i) == row.name ? row.size() : 1);
    }
  }
}

/// The text of a page of the manual, from a title on to the next one.
std::string section_of(const std::string& page, const std::string& title) {
  std::ifstream file(std::string(EQUIAFFINE_TEST_DATA) + "/../../doc/" + page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = text.find("\n## " + title + "\n");
  EXPECT_NE(begin, std::string::npos) << page;
  return text.substr(begin, text.find("\n## ", begin + 1) - begin);
}

TEST(Attribute_selection, the_documentation_has_the_rows_of_the_table_with_their_weights) {
  const std::string quantities = section_of("conventions.md", "Quantities");
  const std::string attributes = section_of("program.md", "Attributes");
  for (const auto& row : attribute_table<double>) {
    const std::string name(row.name), first(row.column(0)), last(row.column(row.size() - 1));
    EXPECT_TRUE(attributes.find(name) != std::string::npos || attributes.find(first) != std::string::npos) << name;
    std::string line; // that has the first or the last component
    std::istringstream lines(quantities);
    while (std::getline(lines, line)) {
      const std::string cell = ' ' + line.substr(0, line.find(" | ")) + ' ';
      const auto has = [&](const std::string& column) {
        for (const char* const end : {"`", " "})
          for (const char* const begin : {"`", " "})
            if (cell.find(begin + column + end) != std::string::npos) return true;
        return false;
      };
      if (line.starts_with("| `") && (has(first) || has(last))) break;
    }
    ASSERT_TRUE(lines) << name << " is not in doc/conventions.md";
    if (row.quantity.label.empty()) continue;
    const int weight = row.quantity.weight;
    const std::string text = weight % 2 ? std::to_string(weight) + "/2" : std::to_string(weight / 2);
    EXPECT_TRUE(line.ends_with(" | " + text + " |")) << line;
  }
}

TEST(Attribute_selection, errors_have_the_columns_of_the_contract_in_its_order) {
  std::string names;
  for (const auto* const row : rows_with_error) names += std::string(row->name) + " ";
  EXPECT_EQ(names, "affine_gaussian_curvature affine_mean_curvature pick_invariant affine_normal affine_normal_angle "
                   "affine_area_density conormal normal gaussian_curvature mean_curvature k1 k2 ");
}

} // namespace Attribute_selection_test
