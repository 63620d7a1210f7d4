// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/Surface_paint.h"

#include "picture/Canvas.h"
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/internal/trust.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace equiaffine {

namespace {

std::string label_of(const std::string& name, const std::string& suffix) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr) return name;
  const std::string label = std::string(quantity->label) + suffix;
  if (quantity->weight == 0) return label;
  return label + (quantity->weight % 2 == 0 ? ", length^" + std::to_string(quantity->weight / 2)
                                            : ", length^(" + std::to_string(quantity->weight) + "/2)");
}

std::string text_of_code(std::size_t code, bool shows_status) {
  if (code == number_of_point_statuses) return "no number";
  if (!shows_status && code == std::size_t(Point_status::PARABOLIC)) return parabolic_region_text;
  return std::string(to_string(static_cast<Point_status>(code)));
}

} // namespace

Light light_of(const CGAL::IO::Color& color) {
  const auto light = [](unsigned char byte) { return float(std::pow(byte / 255., 2.2)); };
  return {light(color.red()), light(color.green()), light(color.blue())};
}

Surface_paint::Surface_paint(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                             const Display_options& options, bool has_notes) {
  if (const auto* column = find_column(attributes, options.color.empty() ? first_shown(attributes) : options.color)) {
    const Parabolic_parts parabolic(mesh.triangles, attributes);
    numbers_ = parabolic.filled(column->values);
    use(*column, Numbers_of_mesh(mesh, attributes), options);
    const auto* errors = find_errors(attributes, column->name);
    if (errors != nullptr && legend_) {
      const std::vector<double> filled = parabolic.filled(errors->values);
      for (std::size_t i = 0; i < filled.size(); ++i)
        doubts_.push_back(color_doubt(numbers_[i], filled[i], legend_->mapping));
    }
    const auto* curvatures = find_column(attributes, "gaussian_curvature");
    if (curvatures != nullptr && is_undefined_at_parabolic_points(column->name))
      sides_ = parabolic.sides(curvatures->values);
    find_codes(attributes);
  } else if (attributes.status && options.color != "plain") {
    shows_status_ = true;
    for (const Point_status status : *attributes.status) codes_.push_back(static_cast<std::uint8_t>(status));
  }
  if (!has_notes)
    for (const std::string& sentence : sentences_of_doubt(attributes)) notes_.push_back({doubt_color(), sentence});
  find_notes(mesh.triangles);
}

Light Surface_paint::operator()(const std::array<std::uint32_t, 3>& triangle,
                                const std::array<double, 3>& weights) const {
  double curvature = 0; // interpolated from the corners where it is known
  for (std::size_t k = 0; k < 3 && !sides_.empty(); ++k)
    if (!std::isnan(sides_[triangle[k]])) curvature += weights[k] * sides_[triangle[k]];
  Weighted_level all, same_side;
  std::array<double, number_of_point_statuses + 1> irregular{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = triangle[k];
    const std::uint8_t code = codes_.empty() ? std::uint8_t(0) : codes_[vertex];
    if (code == 0) {
      const double level = legend_ ? levels_[vertex] : 0, doubt = doubts_.empty() ? 0 : doubts_[vertex];
      all.add(level, doubt, weights[k]);
      if (is_convex(vertex) == (curvature >= 0)) same_side.add(level, doubt, weights[k]);
    } else irregular[code] += weights[k];
  }
  if (all.weight > 0 && can_have_line(triangle)) irregular[std::size_t(Point_status::PARABOLIC)] = 0; // shown by a line
  const auto most = std::max_element(irregular.begin(), irregular.end());
  if (*most > all.weight) {
    const auto code = std::size_t(most - irregular.begin());
    return light_of(color_of_code(code));
  }
  if (!legend_) return light_of(plain_color());
  const Weighted_level& known = same_side.weight > 0 ? same_side : all;
  return color_of(known.level / known.weight, known.doubt / known.weight);
}

Light Surface_paint::color_of(double level, double doubt) const {
  const double place = std::clamp(level, 0., 1.) * double(table_.size() - 1);
  const auto below = std::min(std::size_t(place), table_.size() - 2);
  Light light;
  for (std::size_t n = 0; n < 3; ++n)
    light[n] = table_[below][n] + float(place - double(below)) * (table_[below + 1][n] - table_[below][n]);
  const float gray = 0.2126F * light[0] + 0.7152F * light[1] + 0.0722F * light[2];
  for (float& channel : light) channel += float(doubt) * (gray - channel);
  return light;
}

CGAL::IO::Color Surface_paint::color_of_code(std::size_t code) const {
  if (!shows_status_ && code == std::size_t(Point_status::PARABOLIC)) return parabolic_region_color();
  return code < number_of_point_statuses ? status_color(static_cast<Point_status>(code)) : undefined_color();
}

/// A status is shown only where there is no number.
void Surface_paint::find_codes(const Vertex_attributes& attributes) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const auto status = attributes.status ? std::uint8_t((*attributes.status)[i]) : std::uint8_t(0);
    codes_.push_back(std::isfinite(numbers_[i]) ? std::uint8_t(0) : status == 0 ? no_number : status);
  }
}

/// Whether the Gaussian curvature is known at all corners, so that a line shows its zeros.
bool Surface_paint::can_have_line(const Triangle& triangle) const {
  return !sides_.empty() && std::none_of(triangle.begin(), triangle.end(),
                                         [&](std::uint32_t vertex) { return std::isnan(sides_[vertex]); });
}

void Surface_paint::find_notes(std::span<const Triangle> triangles) {
  bool has_line = false;
  std::array<bool, no_number + 1> is_seen{};
  for (const Triangle& triangle : triangles) {
    has_line = has_line || (!sides_.empty() && changes_sign(sides_, triangle));
    if (codes_.empty()) continue;
    const auto has_code = [&](Point_status status) {
      return std::any_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t vertex) { return codes_[vertex] == std::uint8_t(status); });
    };
    const bool is_line_only = has_code(Point_status::REGULAR) && can_have_line(triangle);
    for (const std::uint32_t vertex : triangle)
      if (codes_[vertex] != std::uint8_t(Point_status::PARABOLIC) || !is_line_only) is_seen[codes_[vertex]] = true;
  }
  if (has_line) notes_.push_back({status_color(Point_status::PARABOLIC), "parabolic curve: no number there"});
  if (!doubts_.empty()) notes_.push_back({doubt_color(), "grayer where the estimated error is larger"});
  for (std::size_t code = legend_ ? 1 : 0; code < is_seen.size(); ++code)
    if (is_seen[code]) notes_.push_back({color_of_code(code), text_of_code(code, shows_status_)});
}

void Surface_paint::use(const Vertex_attributes::Column& column, const Numbers_of_mesh& numbers_of,
                        const Display_options& options) {
  if (std::none_of(numbers_.begin(), numbers_.end(), [](double number) { return std::isfinite(number); })) return;
  const auto given = options.mappings.find(column.name);
  Color_mapping mapping = given != options.mappings.end() ? given->second : numbers_of(column).mapping();
  if (options.range) {
    mapping.range = given_range((*options.range)[0], (*options.range)[1]);
    mapping.scale = Color_scale::LINEAR;
  }
  if (options.colors) mapping.scale = *options.colors;
  const std::string scale = mapping.scale == Color_scale::LINEAR ? "" : ", " + std::string(to_string(mapping.scale));
  legend_ = {label_of(column.name, options.label_suffix) + scale, mapping};
  for (const double number : numbers_) {
    const double t = std::isfinite(number) ? mapping.position(number) : 0;
    levels_.push_back(mapping.range.is_diverging ? (t + 1) / 2 : t);
  }
  constexpr int entries = 257;
  for (int i = 0; i < entries; ++i) {
    const double t = double(i) / (entries - 1);
    table_.push_back(light_of(mapping.range.is_diverging ? diverging_color(2 * t - 1) : sequential_color(t)));
  }
}

} // namespace equiaffine
