// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/html_text.h"
#include "display/page_columns.h"
#include <equiaffine/display/Html_options.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/internal/page.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The colors of a map at `size` equally spaced places of [first, 1], as a JSON array.
template <class Function>
std::string color_table(Function function, double first) {
  constexpr int size = 257; // odd: zero is one of the places
  std::string result = "[";
  for (int i = 0; i < size; ++i)
    result += (i == 0 ? "\"" : ",\"") + hexadecimal(function(first + (1 - first) * i / (size - 1))) + '"';
  return result + ']';
}

/// The words and colors of the statuses, as JSON.
void write_status_facts(std::ostream& json) {
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    const auto status = static_cast<Point_status>(i);
    json << (i == 0 ? "" : ",") << "{\"word\":" << json_string(to_string(status)) << ",\"color\":\""
         << hexadecimal(status_color(status)) << "\"}";
  }
}

} // namespace

std::string page_facts(const Numbers_of_mesh& numbers, const Vertex_attributes& attributes, const Html_options& options,
                       const std::array<double, 3>& center, const Parabolic_parts& parabolic) {
  std::ostringstream json;
  json.imbue(std::locale::classic());
  json.precision(17);
  json << "{\"center\":";
  write_numbers(json, center);
  json << ",\"up\":";
  write_numbers(json, options.up);
  json << ",\"color\":" << json_string(options.color.empty() ? first_shown(attributes) : options.color)
       << ",\"range\":";
  if (options.range) write_numbers(json, *options.range);
  else json << "null";
  json << ",\"scale\":\"" << (options.scale ? to_string(*options.scale) : "auto")
       << "\",\"clip\":" << default_clip_percent << ",\"clipSteps\":";
  write_numbers(json, clip_steps);
  json << ",\n\"columns\":[";
  write_column_facts(json, attributes, options, numbers, parabolic);
  json << "],\n\"spotSides\":";
  const auto* curvatures = find_column(attributes, "gaussian_curvature");
  write_spots(json, curvatures ? parabolic.sides(curvatures->values) : std::vector<double>(parabolic.parts().size()),
              parabolic);
  json << ",\n\"doubts\":[";
  const char* separator = "";
  for (const std::string& sentence : sentences_of_doubt(attributes)) {
    json << separator << json_string(sentence);
    separator = ",";
  }
  json << "],\n\"statuses\":[";
  write_status_facts(json);
  json << "],\n\"plain\":\"" << hexadecimal(plain_color()) << "\",\"undefined\":\"" << hexadecimal(undefined_color())
       << "\",\"doubt\":\"" << hexadecimal(doubt_color()) << "\",\"region\":\"" << hexadecimal(parabolic_region_color())
       << "\",\"regionText\":" << json_string(parabolic_region_text)
       << ",\n\"diverging\":" << color_table(diverging_color, -1)
       << ",\n\"sequential\":" << color_table(sequential_color, 0) << '}';
  return json.str();
}

} // namespace equiaffine::internal
