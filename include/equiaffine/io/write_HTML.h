// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_WRITE_HTML_H
#define EQUIAFFINE_IO_WRITE_HTML_H

#include <equiaffine/attributes/quantities.h>
#include <equiaffine/io/color_map.h>
#include <equiaffine/io/internal/base64.h>
#include <equiaffine/io/internal/viewer_control.h>
#include <equiaffine/io/internal/viewer_data.h>
#include <equiaffine/io/internal/viewer_graphics.h>
#include <equiaffine/io/internal/viewer_page.h>
#include <equiaffine/io/internal/viewer_panel.h>
#include <equiaffine/io/internal/viewer_scene.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine {

/// What the page says and shows first. All text is UTF-8.
struct Html_options {
  std::string title = "Equi-affine curvatures";
  /// The attribute shown first, or `status`, or `plain`; empty: the first quantity of the library that is there.
  std::string color = {};
  /// Shown as a table: what the surface is and how it was made.
  std::vector<std::pair<std::string, std::string>> description = {};
  /// The direction that is up in the first view and around which dragging turns.
  std::array<double, 3> up = {0, 0, 1};
};

namespace internal {

inline std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '&': result += "&amp;"; break;
    case '<': result += "&lt;"; break;
    case '>': result += "&gt;"; break;
    case '"': result += "&quot;"; break;
    case '\'': result += "&#39;"; break;
    default: result += c;
    }
  }
  return result;
}

/// A JSON string that may also stand inside a `<script>` element.
inline std::string json_string(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || c == '"' || c == '\\' || c == '<')
      result += {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 15]};
    else result += c;
  }
  return result + '"';
}

inline std::string hexadecimal(const CGAL::IO::Color& color) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "#";
  for (const unsigned byte : {color.red(), color.green(), color.blue()})
    result += {digits[byte >> 4], digits[byte & 15]};
  return result;
}

/// The nearest float, an infinity where there is none.
inline std::uint32_t float_bits(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (std::abs(value) > largest) value = std::copysign(std::numeric_limits<double>::infinity(), value);
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

/// Writes one data block of the page: `put_all` gets the encoder.
template <class PutAll>
void write_data_block(std::ostream& out, const std::string& id, PutAll put_all) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">";
  Base64_writer writer(out);
  put_all(writer);
  writer.finish();
  out << "</script>\n";
}

/// A function's colours at `size` equally spaced places of [first, 1].
template <class Function>
std::string color_table(Function function, double first) {
  constexpr int size = 257; // odd: zero is one of the places
  std::string result = "[";
  for (int i = 0; i < size; ++i)
    result += (i == 0 ? "\"" : ",\"") + hexadecimal(function(first + (1 - first) * i / (size - 1))) + '"';
  return result + ']';
}

/// Everything the page has to know besides the arrays, as JSON.
inline std::string page_facts(const Vertex_attributes& attributes, const Html_options& options,
                              const std::array<double, 3>& center, double diagonal) {
  std::ostringstream json;
  json.imbue(std::locale::classic());
  json.precision(17);
  json << "{\"center\":[" << center[0] << ',' << center[1] << ',' << center[2] << "],\"up\":[" << options.up[0] << ','
       << options.up[1] << ',' << options.up[2] << "],\"color\":" << json_string(options.color)
       << ",\"clip\":" << default_clip_percent << ",\n\"columns\":[";
  const char* separator = "";
  for (const auto& column : attributes.columns) {
    const Quantity* const known = find_quantity(column.name);
    json << separator << "{\"name\":" << json_string(column.name)
         << ",\"label\":" << json_string(known ? known->label : column.name)
         << ",\"symbol\":" << json_string(known ? known->symbol : "")
         << ",\"group\":" << json_string(known ? known->group : "") << ",\"weight\":" << (known ? known->weight : 0)
         << ",\"order\":" << (known ? known - quantities.data() : std::ptrdiff_t(quantities.size()))
         << ",\"resolution\":" << resolution(column.name, diagonal) << '}';
    separator = ",\n";
  }
  json << "],\n\"statuses\":[";
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    const auto status = static_cast<Point_status>(i);
    json << (i == 0 ? "" : ",") << "{\"word\":" << json_string(to_string(status)) << ",\"color\":\""
         << hexadecimal(status_color(status)) << "\"}";
  }
  json << "],\n\"plain\":\"" << hexadecimal(plain_color()) << "\",\"undefined\":\"" << hexadecimal(undefined_color())
       << "\",\n\"diverging\":" << color_table(diverging_color, -1)
       << ",\n\"sequential\":" << color_table(sequential_color, 0) << '}';
  return json.str();
}

template <class Kernel>
void write_data(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const std::array<double, 3>& center) {
  write_data_block(out, "positions", [&](Base64_writer& writer) {
    for (const auto& point : mesh.points)
      for (int i = 0; i < 3; ++i)
        writer.put_little_endian(float_bits(CGAL::to_double(point[i]) - center[static_cast<std::size_t>(i)]));
  });
  write_data_block(out, "triangles", [&](Base64_writer& writer) {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) writer.put_little_endian(index);
  });
  write_data_block(out, "status", [&](Base64_writer& writer) {
    if (!attributes.status) return;
    for (const Point_status status : *attributes.status) writer.put(static_cast<std::uint8_t>(status));
  });
  for (std::size_t i = 0; i < attributes.columns.size(); ++i)
    write_data_block(out, "column-" + std::to_string(i), [&](Base64_writer& writer) {
      for (const double value : attributes.columns[i].values) writer.put_little_endian(float_bits(value));
    });
}

template <class Kernel>
bool is_consistent(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes) {
  const std::size_t size = mesh.points.size();
  return attributes.has_length(size) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
           return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) { return index < size; });
         });
}

inline bool is_offered(const std::string& color, const Vertex_attributes& attributes) {
  return color.empty() || color == "plain" || (color == "status" && attributes.status) ||
         std::any_of(attributes.columns.begin(), attributes.columns.end(),
                     [&](const auto& column) { return column.name == color; });
}

} // namespace internal

/// Writes one self-contained web page (WebGL 2, no network) that shows the surface coloured by any of its attributes.
/// Numbers are stored in single precision, positions relative to the centre of the bounding box; a million vertices
/// with twenty attributes make 156 MB. A fragment such as `#color=pick_invariant&view=1,0,0` chooses what is shown
/// first; the page's help lists its keys.
/// \pre every column and the status, if there is one, are as long as `points`, triangles index `points`,
/// `options.color` names an attribute or is `status` (when there is one), `plain` or empty, `options.up` is not zero
template <class Kernel>
void write_HTML(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Html_options& options = {}) {
  CGAL_precondition(internal::is_consistent(mesh, attributes));
  CGAL_precondition(internal::is_offered(options.color, attributes));
  CGAL_precondition(options.up[0] != 0 || options.up[1] != 0 || options.up[2] != 0);
  std::array<double, 3> center = {0, 0, 0};
  double diagonal = 0;
  if (!mesh.points.empty()) {
    CGAL::Bbox_3 box;
    for (const auto& point : mesh.points) box += point.bbox();
    center = {box.xmin() + (box.xmax() - box.xmin()) / 2, box.ymin() + (box.ymax() - box.ymin()) / 2,
              box.zmin() + (box.zmax() - box.zmin()) / 2};
    diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  }
  const std::string title = internal::html_escaped(options.title);
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" << title << "</title>\n"
      << "<style>" << internal::viewer_style << "</style>\n</head>\n<body>\n"
      << internal::viewer_stage << "<aside id=\"panel\">\n<h1>" << title << "</h1>\n"
      << internal::viewer_controls << (options.description.empty() ? "" : "<h2>Surface</h2>\n")
      << "<dl id=\"description\">\n";
  for (const auto& [name, text] : options.description)
    out << "<dt>" << internal::html_escaped(name) << "</dt><dd>" << internal::html_escaped(text) << "</dd>\n";
  out << "</dl>\n</aside>\n<script type=\"application/json\" id=\"facts\">"
      << internal::page_facts(attributes, options, center, diagonal) << "</script>\n";
  internal::write_data(out, mesh, attributes, center);
  out << "<script>\n'use strict';\n(() => {" << internal::viewer_data << internal::viewer_graphics
      << internal::viewer_scene << internal::viewer_panel << internal::viewer_control << "})();\n"
      << "</script>\n</body>\n</html>\n";
}

} // namespace equiaffine

#endif
