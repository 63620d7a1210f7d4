// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/displays.h"

#include "output/json_text.h"
#include "output/statistics.h"
#include "picture/draw_surface.h"
#include "system/files.h"
#include "system/front_end.h"
#include "system/kernel.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace equiaffine {

namespace {

using Mappings = std::map<std::string, Color_mapping>;

/// The JSON text in the element `facts` of the page; empty if missing.
std::string facts_of_page(std::istream& page) {
  constexpr std::size_t most = 100'000'000; // bytes before the end of that element
  const std::string begin = "<script type=\"application/json\" id=\"facts\">";
  std::string text, block(1 << 20, '\0');
  while (text.size() < most && (page.read(block.data(), std::streamsize(block.size())), page.gcount() > 0)) {
    text.append(block, 0, std::size_t(page.gcount()));
    const std::size_t first = text.find(begin), last = text.find("</script>", first);
    if (first != std::string::npos && last != std::string::npos)
      return text.substr(first + begin.size(), last - first - begin.size());
  }
  return {};
}

Color_scale scale_of(const std::string& word) {
  for (const Color_scale scale : {Color_scale::ASINH, Color_scale::EQUALIZED})
    if (word == to_string(scale)) return scale;
  return Color_scale::LINEAR;
}

/// The initial color mapping of a column of the page. Throws an exception of the JSON library if members are missing.
Color_mapping mapping_of(const Json& column, const Json& facts) {
  const auto usual =
      std::size_t(std::find(clip_steps.begin(), clip_steps.end(), default_clip_percent) - clip_steps.begin());
  const Json& ranges = column.at("ranges");
  const Json& range = ranges.at(ranges.size() == clip_steps.size() ? usual : 0);
  Color_mapping mapping = {{range.at("lower"), range.at("upper"), range.at("knee"), range.at("isDiverging")},
                           scale_of(range.at("scale")),
                           Equalization(column.at("knots").get<Equalization::Knots>())};
  if (!facts.at("range").is_null() && column.at("name") == facts.at("color")) {
    mapping.range = given_range(facts.at("range").at(0), facts.at("range").at(1));
    mapping.scale = Color_scale::LINEAR;
  }
  if (facts.at("scale") != "auto") mapping.scale = scale_of(facts.at("scale"));
  return mapping;
}

/// Whether the mapping is consistent: the page may have been edited.
bool is_valid(const Color_mapping& mapping) {
  const auto& [lower, upper, knee, is_diverging] = mapping.range;
  const auto& knots = mapping.equalization.knots();
  return lower < upper && knee > 0 && (!is_diverging || lower == -upper) &&
         std::is_sorted(knots.begin(), knots.end()) && knots[Equalization::steps] == 0;
}

Mappings mappings_of_page(const std::string& path) {
  const std::string advice = "; give a page written by this program, or a .ply";
  std::ifstream file = open_input(path);
  Mappings mappings;
  try {
    const Json facts = Json::parse(facts_of_page(file));
    for (const Json& column : facts.at("columns")) {
      if (!column.contains("ranges")) continue;
      const Color_mapping mapping = mapping_of(column, facts);
      if (!is_valid(mapping)) throw Input_error("cannot read '" + path + "': its color scales are invalid" + advice);
      mappings.emplace(column.at("name").get<std::string>(), mapping);
    }
  } catch (const Json::exception&) {
    throw Input_error("cannot read '" + path + "': it has no color scales" + advice);
  }
  return mappings;
}

Mappings mappings_of_file(const std::string& path) {
  const File_format format = file_format(path);
  if (format == File_format::HTML) return mappings_of_page(path);
  if (format != File_format::PLY)
    throw Input_error("cannot read '" + path + "': unknown extension; give a page, .html, or a mesh, .ply");
  std::ifstream file = open_input(path);
  const auto [mesh, attributes] = read_PLY<Kernel>(file, path);
  const Numbers_of_mesh numbers_of(mesh, attributes);
  Mappings mappings;
  for (const auto& column : attributes.columns) mappings.emplace(column.name, numbers_of(column).mapping());
  return mappings;
}

/// Reads the color mapping of each attribute from a page of this program, .html, or a mesh, .ply. Throws `Input_error`
/// for other files.
Mappings read_mappings(const std::string& path) {
  try {
    return mappings_of_file(path);
  } catch (const Input_error& error) {
    throw Input_error(option_text("range_of") + ": " + error.what());
  }
}

/// The maximum number of triangles of a page: with more, browsers are slow or fail.
constexpr std::size_t most_triangles_of_page = 2'000'000;

/// The mappings of the file. Throws `Input_error` if there is none for the column that is shown first.
Mappings shared_mappings(const std::string& path, const Vertex_attributes& attributes, const std::string& color) {
  auto mappings = read_mappings(path);
  const std::string shown = color.empty() ? first_shown(attributes) : color;
  if (find_column(attributes, shown) && !mappings.contains(shown))
    throw Input_error(option_text("range_of") + ": '" + path + "' has no attribute '" + shown +
                      "'; choose one of its attributes with " + option_text("color", "NAME"));
  return mappings;
}

/// Writes the page. If there are too many triangles, it shows a simplified mesh, with a note.
void write_page(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                Display_options& page) {
  if (mesh.triangles.size() <= most_triangles_of_page) return write_HTML(stream, mesh, attributes, page);
  const Displayed_mesh shown = decimate(mesh, attributes, most_triangles_of_page);
  page.description.emplace_back("Shown here", "simplified to " + std::to_string(shown.mesh.triangles.size()) +
                                                  " triangles; colors and statistics are those of the simplified mesh");
  write_HTML(stream, shown.mesh, shown.attributes, page);
}

} // namespace

std::string number_text(double number, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

std::string page_title(const std::string& path, const std::string& otherwise) {
  return path == "-" ? otherwise : std::filesystem::path(path).stem().string();
}

void check_display_outputs(const Display_request& options) {
  if (options.html) check_format(*options.html, File_format::HTML, "a page", ".html");
  if (options.range_of) read_mappings(*options.range_of); // throws errors before the work
  if (!options.png) return;
#ifndef EQUIAFFINE_WITH_VTK
  throw Input_error("cannot write '" + *options.png + "': this equiaffine was built without VTK; use " +
                    by_front_end("--html", "a path with .html"));
#endif
  if (options.png != "-" && file_format(*options.png) != File_format::PNG)
    throw Input_error("cannot write '" + *options.png + "': the extension does not belong to a PNG file; use .png");
}

void write_displays(Outputs& outputs, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                    const Display_request& options, const Surface_texts& texts,
                    [[maybe_unused]] const std::vector<Polyline_3<Kernel>>& curves) {
  Display_options shown = options;
  if (options.guesses_up) shown.up = natural_up(mesh.points);
  if (options.range_of) shown.mappings = shared_mappings(*options.range_of, attributes, options.color);
  shown.label_suffix = texts.label_suffix;
  if (Output_file* const file = outputs.find(Output_kind::PAGE)) {
    Display_options page = shown;
    page.title = texts.title;
    page.description = texts.description;
    if (attributes.columns.empty() && !attributes.status) page.color = "plain";
    write_page(file->stream(), mesh, attributes, page);
  }
#ifdef EQUIAFFINE_WITH_VTK
  if (Output_file* const file = outputs.find(Output_kind::PICTURE)) {
    write_PNG(file->stream(), draw_surface(mesh, attributes, shown, texts.notes, curves));
  }
#endif
}

namespace {

constexpr const char *scale_label = "Scale", *own_scale = "none: curvatures of the surface itself",
                     *noise_label = "Noise", *parabolic_label = "Parabolic",
                     *known_label = "% of vertices with errors below 20 / 50 %", *errors_label = "Errors";
constexpr std::array<std::string_view, 4> labels = {scale_label, noise_label, parabolic_label, known_label};
constexpr std::size_t longest_value = 200;
constexpr std::string_view begin_of_comment = "fit ", end_of_label = ": ";

bool has_errors(const Vertex_attributes& attributes) {
  return std::any_of(attributes.columns.begin(), attributes.columns.end(),
                     [](const auto& column) { return column.name.ends_with("_error"); });
}

} // namespace

Description description_of(const Fit_statistics& fit) {
  Description rows = {{scale_label, fit.scale ? number_text(*fit.scale, 3) : own_scale},
                      {noise_label, number_text(fit.noise, 2)}};
  if (const auto percent = std::lround(100 * fit.parabolic); percent > 0)
    rows.emplace_back(parabolic_label, std::to_string(percent) + " % of the vertices");
  rows.emplace_back(known_label, table_of_errors(fit));
  return rows;
}

std::vector<std::string> comments_of(const Fit_statistics& statistics) {
  if (!std::isfinite(statistics.noise)) return {}; // nothing was fitted
  const Description fit = description_of(statistics);
  std::vector<std::string> comments;
  for (const auto& [label, value] : fit)
    comments.push_back((std::string(begin_of_comment) + label).append(end_of_label) + value);
  return comments;
}

Description description_of_fit(const Vertex_attributes& attributes) {
  Description fit;
  for (const std::string_view comment : attributes.comments) {
    const std::size_t colon = comment.find(end_of_label);
    if (!comment.starts_with(begin_of_comment) || colon == std::string_view::npos) continue;
    const std::string_view label = comment.substr(begin_of_comment.size(), colon - begin_of_comment.size());
    const std::string_view value = comment.substr(colon + end_of_label.size());
    const bool is_known = std::find(labels.begin(), labels.end(), label) != labels.end();
    const bool is_new = std::none_of(fit.begin(), fit.end(), [&](const auto& row) { return row.first == label; });
    if (is_known && is_new && value.size() < longest_value) fit.emplace_back(label, value);
  }
  if (!fit.empty() && !has_errors(attributes))
    fit.emplace_back(errors_label,
                     "missing: the file has no columns NAME_error, so that colors do not show uncertainty");
  return fit;
}

std::string label_suffix(const Description& fit) {
  for (const auto& [label, value] : fit)
    if (label == scale_label && std::strtod(value.c_str(), nullptr) > 0) return " at scale " + value;
  return {};
}

std::vector<Surface_note> notes_of(const Description& fit) {
  std::string text;
  for (const auto& [label, value] : fit)
    if (label != scale_label) text += (text.empty() ? "" : "; ") + label + ": " + value;
  if (text.empty()) return {};
  return {{std::nullopt, text}};
}

} // namespace equiaffine
