// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/page_text.h"
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/display/write_HTML.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace write_HTML_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = Indexed_triangle_mesh_3<Kernel>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A tetrahedron far from the origin, with every kind of column and status.
Mesh tetrahedron() {
  Mesh mesh;
  mesh.points = {{1000, 0, 0}, {1001, 0, 0}, {1000, 2, 0}, {1000, 0, 4}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

Vertex_attributes some_attributes() {
  Vertex_attributes attributes;
  attributes.columns = {{"nx", {1, 0, 0, 0.5}},
                        {"gaussian_curvature", {0.1, -2e-5, nan, 1e300}},
                        {"anything else", {-1e300, 1e-60, 7, 0}}};
  attributes.status = {Point_status::REGULAR, Point_status::PARABOLIC, Point_status::OUTSIDE, Point_status::REGULAR};
  return attributes;
}

std::string page(const Mesh& mesh, const Vertex_attributes& attributes = {}, const Display_options& options = {}) {
  std::ostringstream out;
  write_HTML(out, mesh, attributes, options);
  return out.str();
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t result = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size())) ++result;
  return result;
}

/// The text of the element with that id, up to the next tag.
std::string content(const std::string& page, const std::string& id) {
  const auto found = page.find(" id=\"" + id + "\"");
  if (found == std::string::npos) throw std::runtime_error("no element " + id);
  const auto begin = page.find('>', found) + 1;
  return page.substr(begin, page.find('<', begin) - begin);
}

/// RFC 4648, straight from its definition.
std::vector<std::uint8_t> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0u);
  std::string bits;
  for (const char c : text.substr(0, text.find('='))) {
    const auto digit = digits.find(c);
    EXPECT_NE(digit, std::string::npos) << c;
    for (int i = 5; i >= 0; --i) bits += digit >> i & 1 ? '1' : '0';
  }
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 8 <= bits.size(); i += 8)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(bits.substr(i, 8), nullptr, 2)));
  return bytes;
}

std::vector<std::uint32_t> words(const std::string& text) {
  const auto bytes = decoded(text);
  EXPECT_EQ(bytes.size() % 4, 0u);
  std::vector<std::uint32_t> result(bytes.size() / 4);
  for (std::size_t i = 0; i < bytes.size(); ++i) result[i / 4] |= std::uint32_t(bytes[i]) << 8 * (i % 4);
  return result;
}

std::vector<float> floats(const std::string& text) {
  std::vector<float> result;
  for (const std::uint32_t word : words(text)) result.push_back(std::bit_cast<float>(word));
  return result;
}

std::string base64(const std::string& bytes) {
  std::ostringstream out;
  internal::Base64_writer writer(out);
  for (const char c : bytes) writer.put(static_cast<std::uint8_t>(c));
  writer.finish();
  return out.str();
}

TEST(Base64_writer, writes_the_test_vectors_of_the_standard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64_writer, keeps_every_byte_across_its_buffer) {
  std::mt19937 random(5);
  std::string bytes(200001, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  const auto back = decoded(base64(bytes));
  EXPECT_EQ(std::string(back.begin(), back.end()), bytes);
}

TEST(Write_HTML, stores_positions_in_single_precision_relative_to_the_center) {
  const Mesh mesh = tetrahedron();
  const std::string text = page(mesh);
  EXPECT_NE(text.find("\"center\":[1000.5,1,2]"), std::string::npos);
  const std::vector<float> positions = floats(content(text, "positions"));
  ASSERT_EQ(positions.size(), 12u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(positions[3 * i], float(mesh.points[i].x() - 1000.5));
    EXPECT_EQ(positions[3 * i + 1], float(mesh.points[i].y() - 1));
    EXPECT_EQ(positions[3 * i + 2], float(mesh.points[i].z() - 2));
  }
}

TEST(Write_HTML, stores_triangles_status_and_every_column) {
  const Mesh mesh = tetrahedron();
  const Vertex_attributes attributes = some_attributes();
  const std::string text = page(mesh, attributes);
  const auto indices = words(content(text, "triangles"));
  ASSERT_EQ(indices.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(indices[i], mesh.triangles[i / 3][i % 3]);
  EXPECT_EQ(decoded(content(text, "status")), (std::vector<std::uint8_t>{0, 1, 3, 0}));

  const auto curvature = floats(content(text, "column-1"));
  ASSERT_EQ(curvature.size(), 4u);
  EXPECT_EQ(curvature[0], 0.1F);
  EXPECT_EQ(curvature[1], -2e-5F);
  EXPECT_TRUE(std::isnan(curvature[2]));
  EXPECT_EQ(curvature[3], std::numeric_limits<float>::infinity());
  const auto other = floats(content(text, "column-2"));
  EXPECT_EQ(other, (std::vector<float>{-std::numeric_limits<float>::infinity(), 0, 7, 0}));
  EXPECT_EQ(count(text, "id=\"column-"), 3u);
}

TEST(Write_HTML, names_known_quantities_as_people_do_and_others_as_they_are) {
  const std::string facts = page(tetrahedron(), some_attributes());
  EXPECT_NE(facts.find("\"name\":\"gaussian_curvature\",\"label\":\"Gaussian curvature\",\"symbol\":\"Kₑ\","
                       "\"group\":\"Euclidean\""),
            std::string::npos);
  EXPECT_NE(facts.find("\"name\":\"anything else\",\"label\":\"anything else\",\"symbol\":\"\",\"group\":\"\""),
            std::string::npos);
}

TEST(Write_HTML, the_page_knows_which_quantities_are_undefined_at_parabolic_points) {
  Vertex_attributes attributes;
  attributes.columns = {{"pick_invariant", {0, 1, 2, 3}}, {"mean_curvature", {0, 1, 2, 3}}};
  const std::string text = page(tetrahedron(), attributes);
  EXPECT_EQ(count(text, "\"isUndefinedAtParabolicPoints\":true"), 1u);
  EXPECT_EQ(count(text, "\"isUndefinedAtParabolicPoints\":false"), 1u);
  EXPECT_LT(text.find("\"isUndefinedAtParabolicPoints\":true"), text.find("\"name\":\"mean_curvature\""));
}

TEST(Write_HTML, colors_are_those_of_the_color_map) {
  const std::string text = page(tetrahedron());
  std::string diverging = "\"diverging\":[";
  for (int i = 0; i <= 256; ++i) {
    const auto color = diverging_color((i - 128) / 128.);
    std::array<char, 16> hex{};
    std::snprintf(hex.data(), hex.size(), "\"#%02x%02x%02x\"", color.red(), color.green(), color.blue());
    diverging.append(i == 0 ? "" : ",").append(hex.data());
  }
  EXPECT_NE(text.find(diverging + ']'), std::string::npos);
  EXPECT_NE(text.find("{\"word\":\"parabolic\",\"color\":\"#12a150\"}"), std::string::npos);
}

TEST(Write_HTML, a_rescaled_surface_has_a_rescaled_resolution) {
  // K_e has the dimension length^-2, K length^-3, H and J length^-3/2.
  EXPECT_DOUBLE_EQ(rounding_of_quantity("gaussian_curvature", 10), 1e-11);
  EXPECT_DOUBLE_EQ(rounding_of_quantity("affine_gaussian_curvature", 10), 1e-12);
  EXPECT_DOUBLE_EQ(rounding_of_quantity("pick_invariant", 100), 1e-12);
  EXPECT_EQ(rounding_of_quantity("anything else", 10), 0);
  EXPECT_EQ(rounding_of_quantity("k1", 0), 0);
}

TEST(Write_HTML, text_of_the_user_cannot_become_markup_or_script) {
  Vertex_attributes attributes;
  attributes.columns = {{"</script><script>alert(1)//\"\\\n", {0, 1, 2, 3}}};
  Display_options options;
  options.title = "<b>\"a\" & 'b'</b></title><script>";
  options.color = attributes.columns[0].name;
  options.description = {{"<i>", "</dl></script>&lt;"}};
  const std::string text = page(tetrahedron(), attributes, options);
  EXPECT_EQ(count(text, "<b>"), 0u);
  EXPECT_EQ(count(text, "<i>"), 0u);
  EXPECT_EQ(count(text, "alert(1)"), 3u); // name, label and color
  EXPECT_EQ(count(text, "<script"), count(page(tetrahedron(), some_attributes()), "<script") - 2);
  EXPECT_EQ(count(text, "<script"), count(text, "</script>"));
  EXPECT_NE(text.find("<title>&lt;b&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/b&gt;&lt;/title&gt;&lt;script&gt;</title>"),
            std::string::npos);
  EXPECT_NE(text.find("<dt>&lt;i&gt;</dt><dd>&lt;/dl&gt;&lt;/script&gt;&amp;lt;</dd>"), std::string::npos);
  EXPECT_NE(text.find("\\u003c/script>\\u003cscript>alert(1)//\\u0022\\u005c\\u000a"), std::string::npos);
}

TEST(Write_HTML, the_page_needs_nothing_but_itself) {
  const std::string text = page(tetrahedron(), some_attributes());
  for (const char* const part : {"http:", "https:", "//cdn", " src=", "<link", "@import", "url(", "import(", "fetch("})
    EXPECT_EQ(count(text, part), 0u) << part;
}

TEST(Write_HTML, the_page_is_one_whole_document) {
  const std::string text = page(tetrahedron(), some_attributes());
  EXPECT_EQ(text.rfind("<!DOCTYPE html>\n", 0), 0u);
  EXPECT_TRUE(text.ends_with("</html>\n"));
  for (const char* const name : {"html", "head", "body", "main", "aside", "section", "figure", "table", "dl", "select"})
    EXPECT_EQ(count(text, std::string("<") + name + ' ') + count(text, std::string("<") + name + '>'),
              count(text, std::string("</") + name + '>'))
        << name;
}

TEST(Write_HTML, every_element_the_script_looks_up_is_there_once) {
  const std::string text = page(tetrahedron(), some_attributes());
  std::size_t looked_up = 0;
  for (const std::string_view call : {"byId('", "\non('", "takeBytes('"})
    for (auto at = text.find(call); at != std::string::npos; at = text.find(call, at + 1)) {
      const auto begin = at + call.size();
      const std::string id = text.substr(begin, text.find('\'', begin) - begin);
      if (id == "column-") continue;
      EXPECT_EQ(count(text, " id=\"" + id + '"'), 1u) << id;
      ++looked_up;
    }
  EXPECT_GT(looked_up, 20u);
}

TEST(Write_HTML, a_mesh_without_attributes_and_one_without_points_are_written) {
  const std::string bare = page(tetrahedron());
  EXPECT_EQ(content(bare, "status"), "");
  EXPECT_NE(bare.find("\"columns\":[]"), std::string::npos);
  const std::string empty = page(Mesh());
  EXPECT_EQ(content(empty, "positions"), "");
  EXPECT_EQ(content(empty, "triangles"), "");
  EXPECT_NE(empty.find("\"center\":[0,0,0]"), std::string::npos);
}

TEST(Write_HTML, the_first_color_and_the_up_direction_are_passed_on) {
  Display_options options;
  options.color = "gaussian_curvature";
  options.up = {0, 1, 0};
  const std::string text = page(tetrahedron(), some_attributes(), options);
  EXPECT_NE(text.find("\"up\":[0,1,0],\"color\":\"gaussian_curvature\",\"range\":null"), std::string::npos);
  options.range = {{-0.5, 2}};
  EXPECT_NE(page(tetrahedron(), some_attributes(), options).find("\"range\":[-0.5,2]"), std::string::npos);
}

TEST(Write_HTML, misuse_is_refused) {
#ifdef CGAL_NDEBUG
  GTEST_SKIP() << "preconditions are not compiled in";
#endif
  std::ostringstream out;
  Vertex_attributes short_column;
  short_column.columns = {{"k1", {1, 2}}};
  EXPECT_THROW(write_HTML(out, tetrahedron(), short_column), CGAL::Precondition_exception);
  Vertex_attributes short_status;
  short_status.status = {Point_status::REGULAR};
  EXPECT_THROW(write_HTML(out, tetrahedron(), short_status), CGAL::Precondition_exception);
  Mesh bad_index = tetrahedron();
  bad_index.triangles[1][2] = 4;
  EXPECT_THROW(write_HTML(out, bad_index, {}), CGAL::Precondition_exception);
  Display_options options;
  options.color = "k1";
  EXPECT_THROW(write_HTML(out, tetrahedron(), {}, options), CGAL::Precondition_exception);
  options.color = "status";
  EXPECT_THROW(write_HTML(out, tetrahedron(), {}, options), CGAL::Precondition_exception);
  options = {};
  options.range = {{1, 1}};
  EXPECT_THROW(write_HTML(out, tetrahedron(), {}, options), CGAL::Precondition_exception);
  options = {};
  options.up = {0, 0, 0};
  EXPECT_THROW(write_HTML(out, tetrahedron(), {}, options), CGAL::Precondition_exception);
  EXPECT_EQ(out.str(), "");
}

} // namespace write_HTML_test
