// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_PAGE_ARRAYS_H
#define EQUIAFFINE_DISPLAY_INTERNAL_PAGE_ARRAYS_H

#include <equiaffine/base/internal/bit_cast.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/internal/base64.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// The nearest float; an infinity beyond the largest.
inline float nearest_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (std::abs(value) > largest) value = std::copysign(std::numeric_limits<double>::infinity(), value);
  return static_cast<float>(value);
}

/// The center of the bounding box of points, to which the positions of a page are relative.
template <class Point_3>
std::array<double, 3> center_of(const std::vector<Point_3>& points) {
  if (points.empty()) return {0, 0, 0};
  CGAL::Bbox_3 box;
  for (const Point_3& point : points) box += point.bbox();
  return {box.xmin() + (box.xmax() - box.xmin()) / 2, box.ymin() + (box.ymax() - box.ymin()) / 2,
          box.zmin() + (box.zmax() - box.zmin()) / 2};
}

/// Writes an array as an element of the page that holds its bytes in base64: `put_all(writer)` puts them.
template <class PutAll>
void write_data_block(std::ostream& out, const std::string& id, PutAll put_all) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">";
  Base64_writer writer(out);
  put_all(writer);
  writer.finish();
  out << "</script>\n";
}

/// Writes all arrays: positions relative to `center`, triangles, status, parts (`Parabolic_part`, empty if no vertex is
/// parabolic), and one per column.
template <class Kernel>
void write_data(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const std::array<double, 3>& center, const Parabolic_parts& parabolic) {
  write_data_block(out, "positions", [&](Base64_writer& writer) {
    for (const auto& point : mesh.points)
      for (int i = 0; i < 3; ++i)
        writer.put_little_endian(
            bit_cast<std::uint32_t>(nearest_float(CGAL::to_double(point[i]) - center[static_cast<std::size_t>(i)])));
  });
  write_data_block(out, "triangles", [&](Base64_writer& writer) {
    for (const auto& triangle : mesh.triangles)
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

} // namespace equiaffine::internal

#endif
