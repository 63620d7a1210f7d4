// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a web page that shows a surface, colored by its attributes.
#ifndef EQUIAFFINE_DISPLAY_WRITE_HTML_H
#define EQUIAFFINE_DISPLAY_WRITE_HTML_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/display/Display_options.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// The nearest float; infinity beyond the largest one.
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

/// Whether the lengths of columns and status match the points, and all triangles have existing vertices.
template <class Kernel>
bool is_consistent(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes) {
  const std::size_t size = mesh.points.size();
  return attributes.has_length(size) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
           return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) { return index < size; });
         });
}

/// The data of a mesh that a page shows, independent of the kernel.
struct Page_surface {
  template <class Kernel>
  Page_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes)
      : center(center_of(mesh.points)), triangles(mesh.triangles), numbers(mesh, attributes) {
    positions.reserve(mesh.points.size());
    for (const auto& point : mesh.points) {
      const auto relative = [&](int i) {
        return nearest_float(CGAL::to_double(point[i]) - center[static_cast<std::size_t>(i)]);
      };
      positions.push_back({relative(0), relative(1), relative(2)});
    }
  }

  std::array<double, 3> center;
  std::vector<std::array<float, 3>> positions; ///< relative to the center
  const std::vector<std::array<std::uint32_t, 3>>& triangles;
  Numbers_of_mesh numbers;
};

// These functions are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Whether the page can show the attribute `Display_options::color`.
bool is_offered(const std::string& color, const Vertex_attributes& attributes);

/// All data of the page besides the arrays, as JSON.
std::string page_facts(const Numbers_of_mesh& numbers, const Vertex_attributes& attributes, const Display_options& options,
                       const std::array<double, 3>& center, const Parabolic_parts& parabolic);

/// The page of `write_HTML`: its elements, the data and arrays of the surface, and the script that draws it.
void write_page(std::ostream& out, const Page_surface& surface, const Vertex_attributes& attributes,
                const Display_options& options);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine::internal

namespace equiaffine {

/// Writes one self-contained web page (WebGL 2, no network) that shows the surface colored by any of its attributes.
/// Numbers are stored in single precision, and positions relative to the center of the bounding box; a million
/// vertices with twenty attributes take 156 MB. A URL fragment such as `#color=pick_invariant&view=1,0,0` selects
/// what is shown first; the page's help lists its keys. If a column NAME_error has estimates of the errors of NAME,
/// colors and digits show the accuracy.
/// \pre the lengths of all columns and of the status, if any, match `points`, triangles index `points`,
/// `options.color` is an attribute, `status` (if there is one), `plain`, or empty, `options.range` is ascending, and
/// `options.up` is not zero
template <class Kernel>
void write_HTML(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Display_options& options = {}) {
  CGAL_precondition(internal::is_consistent(mesh, attributes));
  CGAL_precondition(internal::is_offered(options.color, attributes));
  CGAL_precondition(!options.range || (*options.range)[0] < (*options.range)[1]);
  CGAL_precondition(options.up[0] != 0 || options.up[1] != 0 || options.up[2] != 0);
  internal::write_page(out, internal::Page_surface(mesh, attributes), attributes, options);
}

} // namespace equiaffine

#endif
