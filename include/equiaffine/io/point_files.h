// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes points of CGAL, with their attributes as property maps.
#ifndef EQUIAFFINE_IO_POINT_FILES_H
#define EQUIAFFINE_IO_POINT_FILES_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/columns_of_maps.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/Simple_cartesian.h>

#include <cstddef>
#include <iterator>
#include <ranges>
#include <string>
#include <vector>

namespace equiaffine::IO {

/// Adds the points of a `.ply`, `.off`, `.obj`, `.stl`, `.xyz`, or `.csv` file to a CGAL::Point_set_3 with property
/// maps for their attributes, and returns the comments of the file. The maps are NAME of double for each column NAME,
/// NAME of Vector_3 for three columns NAME_x, NAME_y, NAME_z, `normal` for nx, ny, nz, and `status` of Point_status.
/// If maps are given, they are filled instead; they are those of annotate() and annotate_by_fit() except
/// `vertex_structure_map`. A container of points with `push_back` gets only the points.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_status_map` and so on | writable property maps | none | see annotate() and annotate_by_fit() |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
///
/// \throw Input_error if the file cannot be read, or has no numbers for a map; in the latter case the points have
/// been added
template <std::ranges::forward_range Points, internal::Parameter_chain... Parameters>
std::vector<std::string> read_points(const std::string& path, Points& points, const Parameters&... given) {
  internal::check_map_file_parameters<internal::Joined_parameters<Parameters...>>();
  auto file = equiaffine::read_points<CGAL::Simple_cartesian<double>>(path);
  if (!file.attributes.status) file.attributes.status = internal::status_in_cells(file.header, file.cells);
  const auto parameters = internal::joined_parameters(given...);
  const std::size_t before = points.size();
  internal::append_points(points, file.mesh.points);
  const auto added = CGAL::make_range(std::next(std::begin(points), std::ptrdiff_t(before)), std::end(points));
  const auto comments = file.attributes.comments;
  internal::fill_maps(points, added, parameters, std::move(file.attributes), path);
  return comments;
}

/// Writes points with their attributes as `.ply` or `.csv`: the named maps of a CGAL::Point_set_3 whose values are
/// numbers or Vector_3, or the maps that are given; they are those of annotate() and annotate_by_fit() except
/// `vertex_structure_map`. The file is written completely or not at all.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `point_map` | property map | the elements, or that of the range | from elements to points |
/// | `vertex_status_map` and so on | readable property maps | none | see annotate() and annotate_by_fit() |
/// | `comments` | range of std::string | none | comments of a PLY file |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
///
/// \throw Input_error if the file cannot be written, its format is unknown, or two columns would have the same name
/// \throw std::invalid_argument if a coordinate is not finite
template <std::ranges::forward_range Points, internal::Parameter_chain... Parameters>
void write_points(const std::string& path, Points&& points, const Parameters&... given) {
  internal::check_map_file_parameters<internal::Joined_parameters<Parameters...>, internal::Point_tag,
                                      internal::Comments_tag>();
  if (!has_extension(path, ".ply") && !has_extension(path, ".csv"))
    throw Input_error("cannot write '" + path + "': points can only be written as .ply or .csv");
  const auto parameters = internal::joined_parameters(given...);
  const auto point_of = point_of_element(points, parameters);
  Indexed_polygons mesh;
  for (const auto& element : points) mesh.points.push_back(coordinates_of(point_of(element)));
  check_points(mesh.points);
  internal::write_polygon_file(path, mesh, internal::columns_of_maps(points, points, parameters));
}

} // namespace equiaffine::IO

#endif
