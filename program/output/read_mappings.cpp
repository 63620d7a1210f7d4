// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/read_mappings.h"

#include "output/json_text.h"
#include "system/file_format.h"
#include "system/kernel.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_PLY.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <istream>

namespace equiaffine {

namespace {

using Mappings = std::map<std::string, Color_mapping>;

/// The JSON text in the element `facts` of the page; empty if there is none.
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

/// What the page shows first of that column. Throws an exception of the JSON library if it is no column of ours.
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

/// Whether the numbers are such as a page of ours has, which may have been edited.
bool is_valid(const Color_mapping& mapping) {
  const auto& [lower, upper, knee, is_diverging] = mapping.range;
  const auto& knots = mapping.equalization.knots();
  return lower < upper && knee > 0 && (!is_diverging || lower == -upper) &&
         std::is_sorted(knots.begin(), knots.end()) && knots[Equalization::steps] == 0;
}

Mappings mappings_of_page(const std::string& path) {
  const std::string advice = "; give a page that this program has written, or a .ply";
  std::ifstream file = open_input(path);
  Mappings mappings;
  try {
    const Json facts = Json::parse(facts_of_page(file));
    for (const Json& column : facts.at("columns")) {
      if (!column.contains("ranges")) continue;
      const Color_mapping mapping = mapping_of(column, facts);
      if (!is_valid(mapping)) throw Input_error("cannot read '" + path + "': its colors are damaged" + advice);
      mappings.emplace(column.at("name").get<std::string>(), mapping);
    }
  } catch (const Json::exception&) {
    throw Input_error("cannot read '" + path + "': it has no ranges of colors" + advice);
  }
  return mappings;
}

Mappings mappings_of_file(const std::string& path) {
  const File_format format = file_format(path);
  if (format == File_format::HTML) return mappings_of_page(path);
  if (format != File_format::PLY)
    throw Input_error("cannot read '" + path + "': it is neither a page, .html, nor a mesh, .ply");
  std::ifstream file = open_input(path);
  const auto [mesh, attributes] = read_PLY<Kernel>(file, path);
  const Numbers_of_mesh numbers_of(mesh, attributes);
  Mappings mappings;
  for (const auto& column : attributes.columns) mappings.emplace(column.name, numbers_of(column).mapping());
  return mappings;
}

} // namespace

Mappings read_mappings(const std::string& path) {
  try {
    return mappings_of_file(path);
  } catch (const Input_error& error) {
    throw Input_error(std::string("--range-of: ") + error.what());
  }
}

} // namespace equiaffine
