// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_HTML_PAGE_H
#define EQUIAFFINE_DISPLAY_INTERNAL_HTML_PAGE_H

#include <equiaffine/display/Html_options.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/internal/html_text.h>
#include <equiaffine/display/internal/page_arrays.h>
#include <equiaffine/display/internal/page_facts.h>
#include <equiaffine/display/internal/viewer_files.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace equiaffine::internal {

/// Whether columns and status are as long as the points, and all triangles have vertices that exist.
template <class Kernel>
bool is_consistent(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes) {
  const std::size_t size = mesh.points.size();
  return attributes.has_length(size) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
           return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) { return index < size; });
         });
}

/// Whether the page can show what `Html_options::color` names.
inline bool is_offered(const std::string& color, const Vertex_attributes& attributes) {
  return color.empty() || color == "plain" || (color == "status" && attributes.status) ||
         std::any_of(attributes.columns.begin(), attributes.columns.end(),
                     [&](const auto& column) { return column.name == color; });
}

/// The style, the elements and the description of the surface.
inline void write_head_and_panel(std::ostream& out, const Html_options& options) {
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

/// The page of `write_HTML`: its elements, the facts and arrays of the surface, and the script that draws it.
template <class Kernel>
void write_page(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Html_options& options) {
  const std::array<double, 3> center = center_of(mesh.points);
  const Parabolic_parts parabolic(mesh.triangles, attributes);
  write_head_and_panel(out, options);
  out << "<script type=\"application/json\" id=\"facts\">" << page_facts(mesh, attributes, options, center, parabolic)
      << "</script>\n";
  write_data(out, mesh, attributes, center, parabolic);
  out << "<script>\n'use strict';\n(() => {";
  for (const std::string_view part : viewer_script) out << part;
  out << "})();\n</script>\n</body>\n</html>\n";
}

} // namespace equiaffine::internal

#endif
