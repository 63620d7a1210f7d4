// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_POLYGON_SOUP_H
#define EQUIAFFINE_PROGRAM_SOURCE_POLYGON_SOUP_H

#include "system/kernel.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace equiaffine {

/// Points, and polygons of positions in them. A file may hold positions of points that it does not have.
struct Polygon_soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// Throws `Input_error`: "cannot read the mesh 'path': reason; advice".
[[noreturn]] void fail_to_read_mesh(const std::string& path, const std::string& reason, const std::string& advice);

/// Reads an OBJ or STL file through CGAL, whose readers may crash on a damaged file. Throws `Input_error` for what they
/// do not understand.
Polygon_soup read_foreign_soup(const std::string& path);

/// Returns what `make` makes of a file in a child process, where it may crash. Throws `Input_error` if it does.
Polygon_soup make_in_child(const std::string& path, const std::function<Polygon_soup()>& make);

} // namespace equiaffine

#endif
