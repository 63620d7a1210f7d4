// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_PAGE_FACTS_H
#define EQUIAFFINE_IO_INTERNAL_PAGE_FACTS_H

#include <equiaffine/attributes/quantities.h>
#include <equiaffine/io/Html_options.h>
#include <equiaffine/io/color_map.h>
#include <equiaffine/io/internal/html_text.h>
#include <equiaffine/io/trust.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>

namespace equiaffine::internal {

/// The colors of a map at `size` equally spaced places of [first, 1], as a JSON array.
template <class Function>
std::string color_table(Function function, double first) {
  constexpr int size = 257; // odd: zero is one of the places
  std::string result = "[";
  for (int i = 0; i < size; ++i)
    result += (i == 0 ? "\"" : ",\"") + hexadecimal(function(first + (1 - first) * i / (size - 1))) + '"';
  return result + ']';
}

/// The names of the columns, and what the library knows about the quantities among them, as JSON.
inline void write_column_facts(std::ostream& json, const Vertex_attributes& attributes, double diagonal) {
  const char* separator = "";
  for (const auto& column : attributes.columns) {
    const Quantity* const known = find_quantity(column.name);
    json << separator << "{\"name\":" << json_string(column.name)
         << ",\"label\":" << json_string(known ? known->label : column.name)
         << ",\"symbol\":" << json_string(known ? known->symbol : "")
         << ",\"group\":" << json_string(known ? known->group : "") << ",\"weight\":" << (known ? known->weight : 0)
         << ",\"isUndefinedAtParabolicPoints\":" << (is_undefined_at_parabolic_points(column.name) ? "true" : "false")
         << ",\"order\":" << rank_of_quantity(column.name)
         << ",\"resolution\":" << rounding_of_quantity(column.name, diagonal) << '}';
    separator = ",\n";
  }
}

/// The words and colors of the statuses, as JSON.
inline void write_status_facts(std::ostream& json) {
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    const auto status = static_cast<Point_status>(i);
    json << (i == 0 ? "" : ",") << "{\"word\":" << json_string(to_string(status)) << ",\"color\":\""
         << hexadecimal(status_color(status)) << "\"}";
  }
}

/// Everything that the page has to know besides the arrays, as JSON. The columns' tolerances depend on the diagonal of
/// the bounding box.
inline std::string page_facts(const Vertex_attributes& attributes, const Html_options& options,
                              const std::array<double, 3>& center, double diagonal) {
  std::ostringstream json;
  json.imbue(std::locale::classic());
  json.precision(17);
  json << "{\"center\":[" << center[0] << ',' << center[1] << ',' << center[2] << "],\"up\":[" << options.up[0] << ','
       << options.up[1] << ',' << options.up[2]
       << "],\"color\":" << json_string(options.color.empty() ? first_shown(attributes) : options.color)
       << ",\"range\":";
  if (options.range) json << '[' << (*options.range)[0] << ',' << (*options.range)[1] << ']';
  else json << "null";
  json << ",\"clip\":" << default_clip_percent << ",\n\"columns\":[";
  write_column_facts(json, attributes, diagonal);
  json << "],\n\"doubts\":[";
  const char* separator = "";
  for (const std::string& sentence : sentences_of_doubt(attributes)) {
    json << separator << json_string(sentence);
    separator = ",";
  }
  json << "],\n\"statuses\":[";
  write_status_facts(json);
  json << "],\n\"plain\":\"" << hexadecimal(plain_color()) << "\",\"undefined\":\"" << hexadecimal(undefined_color())
       << "\",\"doubt\":\"" << hexadecimal(doubt_color()) << "\",\n\"diverging\":" << color_table(diverging_color, -1)
       << ",\n\"sequential\":" << color_table(sequential_color, 0) << '}';
  return json.str();
}

} // namespace equiaffine::internal

#endif
