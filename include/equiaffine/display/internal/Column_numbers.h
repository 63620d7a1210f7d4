// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H
#define EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H

#include <equiaffine/display/color_map.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <numeric>
#include <vector>

// The members without a body are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The numbers of a column that determine its colors: those that are known to one digit, or all if there are none.
/// This class has the rules that assign colors to numbers, for pages and pictures.
class Column_numbers {
public:
  /// Numbers closer than `resolution` are equal up to rounding. `areas` are their weights. `is_known` and `errors`
  /// are empty if there are no errors.
  Column_numbers(const std::vector<double>& values, const std::vector<bool>& is_known,
                 const std::vector<double>& errors, const std::vector<double>& areas, double resolution);

  /// The numbers in ascending order.
  const std::vector<double>& sorted() const { return sorted_; }

  /// The fraction of all numbers that are not known to one digit.
  double part_unknown() const { return part_unknown_; }

  /// The ranks of the numbers, weighted by area, except those that are zero up to rounding.
  Equalization equalization() const;

  /// The default mapping. Its scale is the first of linear, logarithmic, and equalized for which the median is
  /// visible: at least an eighth of the color bar away from zero (the median of |value|) for a diverging range, or
  /// from both ends (the median of the values) otherwise. It is linear if there is none.
  Color_mapping mapping(double clip_percent = default_clip_percent) const {
    return mapping(clip_percent, equalization());
  }

  /// The same with a given equalization of these numbers.
  Color_mapping mapping(double clip_percent, const Equalization& equalization) const;

private:
  bool shows_median(const Color_mapping& mapping) const;

  double resolution_, part_unknown_ = 0, error_ = 0; // error_ is the median error of the known numbers
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
