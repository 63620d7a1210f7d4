// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/page_text.h"
#include "display/viewer_files.h"
#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace equiaffine::internal {

namespace {

/// Writes an array as an element of the page with its bytes in base64, which `put_all(writer)` writes.
template <class PutAll>
void write_data_block(std::ostream& out, const std::string& id, PutAll put_all) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">";
  Base64_writer writer(out);
  put_all(writer);
  writer.finish();
  out << "</script>\n";
}

/// Writes all arrays: positions relative to the center, triangles, status, parts (`Parabolic_part`, empty if no
/// vertex is parabolic), and one array per column.
void write_data(std::ostream& out, const Page_surface& surface, const Vertex_attributes& attributes,
                const Parabolic_parts& parabolic) {
  write_data_block(out, "positions", [&](Base64_writer& writer) {
    for (const auto& position : surface.positions)
      for (const float coordinate : position) writer.put_little_endian(bit_cast<std::uint32_t>(coordinate));
  });
  write_data_block(out, "triangles", [&](Base64_writer& writer) {
    for (const auto& triangle : surface.triangles)
      for (const std::uint32_t index : triangle) writer.put_little_endian(index);
  });
  write_data_block(out, "status", [&](Base64_writer& writer) {
    if (!attributes.status) return;
    for (const Point_status status : *attributes.status) writer.put(static_cast<std::uint8_t>(status));
  });
  write_data_block(out, "parts", [&](Base64_writer& writer) {
    for (const Parabolic_part part : parabolic.parts()) writer.put(static_cast<std::uint8_t>(part));
  });
  for (std::size_t i = 0; i < attributes.columns.size(); ++i)
    write_data_block(out, "column-" + std::to_string(i), [&](Base64_writer& writer) {
      for (const double value : attributes.columns[i].values)
        writer.put_little_endian(bit_cast<std::uint32_t>(nearest_float(value)));
    });
}

/// Writes the style, the elements, and the description of the surface.
void write_head_and_panel(std::ostream& out, const Display_options& options) {
  const std::string title = html_escaped(options.title);
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" << title << "</title>\n"
      << "<style>" << viewer_style << "</style>\n</head>\n<body>\n"
      << viewer_stage << "<aside id=\"panel\">\n<h1>" << title << "</h1>\n"
      << viewer_controls << (options.description.empty() ? "" : "<h2>Surface</h2>\n") << "<dl id=\"description\">\n";
  for (const auto& [name, text] : options.description)
    out << "<dt>" << html_escaped(name) << "</dt><dd>" << html_escaped(text) << "</dd>\n";
  out << "</dl>\n</aside>\n";
}

} // namespace

bool is_offered(const std::string& color, const Vertex_attributes& attributes) {
  return color.empty() || color == "plain" || (color == "status" && attributes.status) ||
         std::any_of(attributes.columns.begin(), attributes.columns.end(),
                     [&](const auto& column) { return column.name == color; });
}

void write_page(std::ostream& out, const Page_surface& surface, const Vertex_attributes& attributes,
                const Display_options& options) {
  const Parabolic_parts parabolic(surface.triangles, attributes);
  write_head_and_panel(out, options);
  out << "<script type=\"application/json\" id=\"facts\">"
      << page_facts(surface.numbers, attributes, options, surface.center, parabolic) << "</script>\n";
  write_data(out, surface, attributes, parabolic);
  out << "<script>\n'use strict';\n(() => {";
  for (const std::string_view part : viewer_script) out << part;
  out << "})();\n</script>\n</body>\n</html>\n";
}

} // namespace equiaffine::internal
