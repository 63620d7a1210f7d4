// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H
#define EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H

#include <equiaffine/display/color_map.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <numeric>
#include <vector>

// The library defines the members that have no body here.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The numbers of a column that decide on its colors: those that are known to one digit, or all if none is. The rules
/// by which numbers get their colors are here, for pages and pictures.
class Column_numbers {
public:
  /// Numbers closer than `resolution` are equal up to rounding; `areas` weigh them; `is_known` and `errors` are
  /// empty if there are no errors.
  Column_numbers(const std::vector<double>& values, const std::vector<bool>& is_known,
                 const std::vector<double>& errors, const std::vector<double>& areas, double resolution);

  /// Ascending.
  const std::vector<double>& sorted() const { return sorted_; }

  /// The part of all numbers that are not known to one digit.
  double part_unknown() const { return part_unknown_; }

  /// The ranks of the numbers, weighted by area. Those that are zero up to rounding have none.
  Equalization equalization() const;

  /// The mapping that is used unless something else is asked for. Its scale is the first of linear, logarithmic and
  /// equalized by which the median is an eighth of the color bar or more away from where it would look like nothing:
  /// that of |value| from zero for a diverging range, else that of the values from both ends; linear if there is none.
  Color_mapping mapping(double clip_percent = default_clip_percent) const {
    return mapping(clip_percent, equalization());
  }

  /// The same, with the equalization of these numbers.
  Color_mapping mapping(double clip_percent, const Equalization& equalization) const;

private:
  bool shows_median(const Color_mapping& mapping) const;

  double resolution_, part_unknown_ = 0, error_ = 0; // the latter is the median of known numbers
  std::vector<Weighted_number> numbers_;
  std::vector<double> sorted_, magnitudes_;
};

/// The numbers of the columns of a mesh.
class Numbers_of_mesh {
public:
  template <class Kernel>
  Numbers_of_mesh(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes)
      : attributes_(attributes), areas_(vertex_areas(mesh.points, mesh.triangles)) {
    if (!(std::accumulate(areas_.begin(), areas_.end(), 0.) > 0)) areas_.assign(areas_.size(), 1.);
    CGAL::Bbox_3 box;
    for (const auto& point : mesh.points) box += point.bbox();
    if (!mesh.points.empty()) diagonal_ = std::hypot(box.x_span(), box.y_span(), box.z_span());
  }

  Column_numbers operator()(const Vertex_attributes::Column& column) const;

private:
  const Vertex_attributes& attributes_;
  std::vector<double> areas_; // 1 for every vertex if there is no area
  double diagonal_ = 0;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
