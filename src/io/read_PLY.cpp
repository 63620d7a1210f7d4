// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a PLY file become points with columns, and faces.
#include "io/Ply_header.h"
#include "io/Ply_numbers.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/internal/mesh_readers.h>
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

namespace equiaffine::internal {

namespace {

/// The use of each property of a vertex.
struct Ply_vertex_layout {
  std::array<std::optional<std::size_t>, 3> coordinates; ///< which properties are x, y and z
  std::vector<std::optional<std::size_t>> columns; ///< the column of each property; coordinates and lists have none
  bool has_status = false;                         ///< whether a property is `uchar status`
};

/// Finds the coordinates and appends an empty column to `attributes` for each other property that is a number.
Ply_vertex_layout lay_out_vertices(const Ply_element& element, Vertex_attributes& attributes) {
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
void extract_status(Vertex_attributes& attributes) {
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

void read_vertices(Ply_numbers& numbers, const Ply_element& element, const Mesh_receiver& receiver,
                   Vertex_attributes& attributes) {
  if (element.count > std::numeric_limits<std::uint32_t>::max()) numbers.fail("it has too many points", "split it");
  auto& columns = attributes.columns;
  const Ply_vertex_layout layout = lay_out_vertices(element, attributes);
  const auto& [x, y, z] = layout.coordinates;
  if (!x || !y || !z) numbers.fail("its vertices have no x, y and z", "write them to the file");

  for (auto& column : columns) column.values.reserve(element.count);
  receiver.reserve(element.count, 0);
  std::vector<double> row(element.properties.size()), list;
  for (std::size_t v = 0; v < element.count; ++v) {
    Progress_observer::step();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (element.properties[i].count_type) numbers.next_list(element.properties[i], list);
      else row[i] = numbers.next(element.properties[i].type);
      if (layout.columns[i]) columns[*layout.columns[i]].values.push_back(row[i]);
    }
    receiver.add_point(row[*x], row[*y], row[*z]);
  }
  if (layout.has_status) extract_status(attributes);
}

/// Reads faces between so many points.
void read_faces(Ply_numbers& numbers, const Ply_element& element, std::size_t points, const Mesh_receiver& receiver) {
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
        if (!(index >= 0 && index < double(points) && index == std::floor(index)))
          numbers.fail("face " + std::to_string(f) + " has a vertex that does not exist", "correct the file");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      receiver.add_face(face);
    }
  }
}

/// Reads the elements in the order of the header. Those that are neither vertices nor faces are left out.
Vertex_attributes read_elements(Ply_numbers& numbers, const std::vector<Ply_element>& elements,
                                const Mesh_receiver& receiver) {
  Vertex_attributes attributes;
  std::optional<std::size_t> points;
  for (const Ply_element& element : elements) {
    if (element.properties.empty() && element.name != "vertex") continue; // of which there may be any number
    numbers.check_length(element);
    if (element.name == "vertex") {
      read_vertices(numbers, element, receiver, attributes);
      points = element.count;
    } else if (element.name == "face") read_faces(numbers, element, points.value_or(0), receiver);
    else numbers.skip(element);
  }
  if (!points) numbers.fail("it has no vertices", "check the path");
  return attributes;
}

} // namespace

Vertex_attributes read_PLY_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  std::string_view rest = text;
  const Ply_header header = Ply_header_parser(rest, name).parse();
  Ply_numbers numbers(rest, header.encoding, name);
  Vertex_attributes attributes = read_elements(numbers, header.elements, receiver);
  attributes.comments = header.comments;
  return attributes;
}

} // namespace equiaffine::internal
