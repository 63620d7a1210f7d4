// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_PLY_ELEMENTS_H
#define EQUIAFFINE_IO_INTERNAL_PLY_ELEMENTS_H

#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/Ply_header.h>
#include <equiaffine/io/internal/Ply_numbers.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The elements of a PLY file become points with columns, and triangles.
namespace equiaffine::internal {

/// The use of each property of a vertex.
struct Ply_vertex_layout {
  std::array<std::optional<std::size_t>, 3> coordinates; ///< which properties are x, y and z
  std::vector<std::optional<std::size_t>> columns; ///< the column of each property; coordinates and lists have none
  bool has_status = false;                         ///< whether a property is `uchar status`
};

/// Finds the coordinates and appends an empty column to `attributes` for each other property that is a number.
inline Ply_vertex_layout lay_out_vertices(const Ply_element& element, Vertex_attributes& attributes) {
  Ply_vertex_layout layout;
  layout.columns.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Ply_property& property = element.properties[i];
    if (property.count_type) continue;
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis != std::string_view::npos) {
      layout.coordinates[axis] = i;
      continue;
    }
    layout.columns[i] = attributes.columns.size();
    attributes.columns.push_back({property.name, {}});
    layout.has_status = layout.has_status || (property.name == "status" && property.type == Ply_type::UINT8);
  }
  return layout;
}

/// Turns a column `status` into the status of the points, unless some of its numbers are no status.
inline void extract_status(Vertex_attributes& attributes) {
  const auto column = std::find_if(attributes.columns.begin(), attributes.columns.end(),
                                   [](const auto& c) { return c.name == "status"; });
  if (column == attributes.columns.end()) return;
  std::vector<Point_status> status;
  status.reserve(column->values.size());
  for (const double value : column->values) {
    if (!(value >= 0 && value < double(number_of_point_statuses))) return;
    status.push_back(static_cast<Point_status>(value));
  }
  attributes.status = std::move(status);
  attributes.columns.erase(column);
}

template <class Kernel>
void read_vertices(Ply_numbers& numbers, const Ply_element& element, Annotated_mesh_3<Kernel>& result) {
  if (element.count > std::numeric_limits<std::uint32_t>::max()) numbers.fail("it has too many points", "split it");
  auto& columns = result.attributes.columns;
  const Ply_vertex_layout layout = lay_out_vertices(element, result.attributes);
  const auto& [x, y, z] = layout.coordinates;
  if (!x || !y || !z) numbers.fail("its vertices have no x, y and z", "write them to the file");

  for (auto& column : columns) column.values.reserve(element.count);
  result.mesh.points.reserve(element.count);
  std::vector<double> row(element.properties.size()), list;
  for (std::size_t v = 0; v < element.count; ++v) {
    Progress_observer::step();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (element.properties[i].count_type) numbers.next_list(element.properties[i], list);
      else row[i] = numbers.next(element.properties[i].type);
      if (layout.columns[i]) columns[*layout.columns[i]].values.push_back(row[i]);
    }
    result.mesh.points.emplace_back(row[*x], row[*y], row[*z]);
  }
  if (layout.has_status) extract_status(result.attributes);
}

/// Calls `add_face(mesh, face)` for each face, a vector of positions of points. Precondition: the points have been read.
template <class Kernel, class Add_face>
void read_faces(Ply_numbers& numbers, const Ply_element& element, Indexed_triangle_mesh_3<Kernel>& mesh,
                const Add_face& add_face) {
  std::vector<double> list;
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < element.count; ++f) {
    Progress_observer::step();
    for (const Ply_property& property : element.properties) {
      if (!property.count_type) {
        numbers.next(property.type);
        continue;
      }
      numbers.next_list(property, list);
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      face.clear();
      for (const double index : list) {
        if (!(index >= 0 && index < double(mesh.points.size()) && index == std::floor(index)))
          numbers.fail("face " + std::to_string(f) + " has a vertex that does not exist", "correct the file");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      add_face(mesh, face);
    }
  }
}

/// Reads the elements in the order of the header. Those that are neither vertices nor faces are left out.
template <class Kernel, class Add_face>
Annotated_mesh_3<Kernel> read_elements(Ply_numbers& numbers, const std::vector<Ply_element>& elements,
                                       const Add_face& add_face) {
  Annotated_mesh_3<Kernel> result;
  bool has_vertices = false;
  for (const Ply_element& element : elements) {
    if (element.properties.empty() && element.name != "vertex") continue; // of which there may be any number
    numbers.check_length(element);
    if (element.name == "vertex") {
      read_vertices(numbers, element, result);
      has_vertices = true;
    } else if (element.name == "face") read_faces(numbers, element, result.mesh, add_face);
    else numbers.skip(element);
  }
  if (!has_vertices) numbers.fail("it has no vertices", "check the path");
  return result;
}

/// Reads PLY, and calls `add_face(mesh, face)` for each face.
template <class Kernel, class Add_face>
Annotated_mesh_3<Kernel> read_PLY_with(std::istream& stream, const std::string& name, const Add_face& add_face) {
  const std::string text = read_all(stream);
  std::string_view rest = text;
  const Ply_header header = Ply_header_parser(rest, name).parse();
  Ply_numbers numbers(rest, header.encoding, name);
  Annotated_mesh_3<Kernel> result = read_elements<Kernel>(numbers, header.elements, add_face);
  result.attributes.comments = header.comments;
  return result;
}

} // namespace equiaffine::internal

#endif
