// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a page besides its arrays: the labels of its columns, the mappings from numbers to colors, and the
// colors.
#include "display/page_text.h"
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

namespace {

/// Writes null for a number that is not finite, because JSON cannot represent it.
void write_number(std::ostream& json, double number) {
  if (std::isfinite(number)) json << number;
  else json << "null";
}

template <class Range>
void write_numbers(std::ostream& json, const Range& numbers) {
  const char* separator = "[";
  for (const double number : numbers) {
    json << separator;
    write_number(json, number);
    separator = ",";
  }
  json << (separator[0] == '[' ? "[]" : "]");
}

/// Writes the range for each clip step, with the scale that suits it, or a single range if the mapping is given.
void write_mapping(std::ostream& json, const Column_numbers& numbers, const Color_mapping* given) {
  const Equalization equalization = given ? given->equalization : numbers.equalization();
  const auto write_range = [&](const Color_mapping& mapping) {
    const auto& [lower, upper, knee, is_diverging] = mapping.range;
    json << "{\"lower\":" << lower << ",\"upper\":" << upper << ",\"knee\":" << knee
         << ",\"isDiverging\":" << (is_diverging ? "true" : "false") << ",\"scale\":\"" << to_string(mapping.scale)
         << "\"}";
  };
  json << ",\"ranges\":[";
  if (given) write_range(*given);
  else
    for (const double& percent : clip_steps) {
      json << (&percent == clip_steps.data() ? "" : ",");
      write_range(numbers.mapping(percent, equalization));
    }
  json << "],\"knots\":";
  write_numbers(json, equalization.knots());
}

/// The error of the column's number that is nearest to the given one.
double error_nearest(double number, const Vertex_attributes::Column& column, const Vertex_attributes::Column& errors) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < column.values.size(); ++i)
    if (const double distance = std::abs(column.values[i] - number); distance < least) {
      nearest = i;
      least = distance;
    }
  return errors.values.empty() ? NAN : errors.values[nearest];
}

/// Writes the minimum, median, and maximum of the known numbers, each with its error if there is one, and the
/// fraction of unknown numbers.
void write_statistics(std::ostream& json, const Vertex_attributes::Column& column,
                      const Vertex_attributes::Column* errors, const Column_numbers& numbers) {
  json << ",\"unknown\":" << numbers.part_unknown() << ",\"statistics\":[";
  for (const double percent : {0., 50., 100.}) {
    const auto& sorted = numbers.sorted();
    const double number = sorted.empty() ? NAN : quantile_of_sorted(sorted, percent);
    const double error = errors == nullptr ? NAN : error_nearest(number, column, *errors);
    json << (percent == 0 ? "" : ",");
    write_numbers(json, std::array{number, error});
  }
  json << ']';
}

/// Whether a column is a quantity of its own, not a component of a vector or of the metric.
bool is_quantity(const std::string& name, const Vertex_attributes& attributes) {
  if (name.starts_with("metric_") && name.size() == 9) return false;
  const char axis = name.empty() ? ' ' : name.back();
  const std::string stem = name.substr(0, name.empty() ? 0 : name.size() - 1);
  if ((axis != 'x' && axis != 'y' && axis != 'z') || (stem != "n" && (!stem.ends_with('_') || stem.size() == 1)))
    return true;
  constexpr std::string_view axes = "xyz";
  return std::any_of(axes.begin(), axes.end(),
                     [&](char other) { return find_column(attributes, stem + other) == nullptr; });
}

/// Writes the numbers of the vertices in spots.
void write_spots(std::ostream& json, const std::vector<double>& numbers, const Parabolic_parts& parabolic) {
  std::vector<double> spots;
  for (const std::uint32_t vertex : parabolic.spots()) spots.push_back(numbers[vertex]);
  write_numbers(json, spots);
}

/// Writes the names of the columns, the library's data on the quantities among them, and the mappings to colors.
void write_column_facts(std::ostream& json, const Vertex_attributes& attributes, const Display_options& options,
                        const Numbers_of_mesh& numbers_of, const Parabolic_parts& parabolic) {
  const char* separator = "";
  for (const auto& column : attributes.columns) {
    const Quantity* const known = find_quantity(column.name);
    json << separator << "{\"name\":" << json_string(column.name)
         << ",\"label\":" << json_string(known ? known->label : column.name)
         << ",\"symbol\":" << json_string(known ? std::string(known->symbol) + options.label_suffix : "")
         << ",\"group\":" << json_string(known ? known->group : "") << ",\"weight\":" << (known ? known->weight : 0)
         << ",\"meaning\":" << json_string(known ? known->meaning : "")
         << ",\"isUndefinedAtParabolicPoints\":" << (is_undefined_at_parabolic_points(column.name) ? "true" : "false")
         << ",\"order\":" << rank_of_quantity(column.name);
    if (is_quantity(column.name, attributes) || column.name == options.color) {
      const auto* errors = find_errors(attributes, column.name);
      const auto given = options.mappings.find(column.name);
      const Column_numbers numbers = numbers_of(column);
      write_mapping(json, numbers, given == options.mappings.end() ? nullptr : &given->second);
      write_statistics(json, column, errors, numbers);
      json << ",\"spots\":";
      write_spots(json, parabolic.filled(column.values), parabolic);
    }
    json << '}';
    separator = ",\n";
  }
}

/// The colors of a map at `size` equally spaced positions in [first, 1], as a JSON array.
template <class Function>
std::string color_table(Function function, double first) {
  constexpr int size = 257; // odd, so that zero is one of the positions
  std::string result = "[";
  for (int i = 0; i < size; ++i)
    result += (i == 0 ? "\"" : ",\"") + hexadecimal(function(first + (1 - first) * i / (size - 1))) + '"';
  return result + ']';
}

/// Writes the words and colors of the statuses as JSON.
void write_status_facts(std::ostream& json) {
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    const auto status = static_cast<Point_status>(i);
    json << (i == 0 ? "" : ",") << "{\"word\":" << json_string(to_string(status)) << ",\"color\":\""
         << hexadecimal(status_color(status)) << "\"}";
  }
}

} // namespace

std::string page_facts(const Numbers_of_mesh& numbers, const Vertex_attributes& attributes, const Display_options& options,
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
  json << ",\"scale\":\"" << (options.colors ? to_string(*options.colors) : "auto")
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
