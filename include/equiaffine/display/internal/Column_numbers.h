// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H
#define EQUIAFFINE_DISPLAY_INTERNAL_COLUMN_NUMBERS_H

#include <equiaffine/attributes/internal/quantities.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/Color_mapping.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine {

/// A third of the area of the triangles around each vertex; 1 for every vertex if there is no area.
template <class Kernel>
std::vector<double> vertex_areas(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.);
  double total = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto& p = mesh.points[triangle[0]];
    const auto normal = cross_product(mesh.points[triangle[1]] - p, mesh.points[triangle[2]] - p);
    const double share = std::sqrt(CGAL::to_double(normal.squared_length())) / 6;
    for (const std::uint32_t vertex : triangle) areas[vertex] += share;
    total += share;
  }
  if (!(total > 0)) areas.assign(areas.size(), 1.);
  return areas;
}

/// The numbers of a column that decide on its colors: those that are known to one digit, or all if none is. The rules
/// by which numbers get their colors are here, for pages and pictures.
class Column_numbers {
public:
  /// Numbers closer than `resolution` are equal up to rounding; `areas` are those of `vertex_areas`; `is_known` and `errors`
  /// are empty if there are no errors.
  Column_numbers(const std::vector<double>& values, const std::vector<bool>& is_known,
                 const std::vector<double>& errors, const std::vector<double>& areas, double resolution)
      : resolution_(resolution) {
    std::vector<Weighted_number> all, known;
    std::vector<double> of_known;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double value = values[i];
      if (!std::isfinite(value)) continue;
      all.push_back({value, areas[i]});
      if (is_known.empty() || !is_known[i]) continue;
      known.push_back(all.back());
      of_known.push_back(errors[i]);
    }
    if (!of_known.empty()) error_ = median_of(std::move(of_known));
    part_unknown_ = is_known.empty() || all.empty() ? 0 : 1 - double(known.size()) / double(all.size());
    numbers_ = known.empty() ? std::move(all) : std::move(known);
    std::sort(numbers_.begin(), numbers_.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    for (const auto& [number, weight] : numbers_) sorted_.push_back(number);
    magnitudes_ = sorted_magnitudes(sorted_);
  }

  /// Ascending.
  const std::vector<double>& sorted() const { return sorted_; }

  /// The part of all numbers that are not known to one digit.
  double part_unknown() const { return part_unknown_; }

  /// The ranks of the numbers, weighted by area. Those that are zero up to rounding have none.
  Equalization equalization() const {
    std::vector<Weighted_number> ranked = numbers_;
    std::erase_if(ranked, [&](const auto& each) { return std::abs(each.number) <= resolution_; });
    return Equalization(std::move(ranked));
  }

  /// The mapping that is used unless something else is asked for. Its scale is the first of linear, logarithmic and
  /// equalized by which the median is an eighth of the color bar or more away from where it would look like nothing:
  /// that of |value| from zero for a diverging range, else that of the values from both ends; linear if there is none.
  Color_mapping mapping(double clip_percent = default_clip_percent) const {
    return mapping(clip_percent, equalization());
  }

  /// The same, with the equalization of these numbers.
  Color_mapping mapping(double clip_percent, const Equalization& equalization) const {
    Color_mapping result = {
        color_range_of_sorted(sorted_, magnitudes_, clip_percent, resolution_, error_), {}, equalization};
    if (sorted_.empty()) return result;
    for (const Color_scale scale : {Color_scale::LINEAR, Color_scale::ASINH, Color_scale::EQUALIZED}) {
      result.scale = scale;
      if (shows_median(result)) return result;
    }
    result.scale = Color_scale::LINEAR;
    return result;
  }

private:
  bool shows_median(const Color_mapping& mapping) const {
    constexpr double least = 1. / 8;
    if (mapping.range.is_diverging)
      return std::max(mapping.position(mapping.range.knee), -mapping.position(-mapping.range.knee)) >= least;
    const double t = mapping.position(quantile_of_sorted(sorted_, 50));
    return std::min(t, 1 - t) >= least;
  }

  double resolution_, part_unknown_ = 0, error_ = 0; // the latter is the median of known numbers
  std::vector<Weighted_number> numbers_;
  std::vector<double> sorted_, magnitudes_;
};

/// The numbers of the columns of a mesh.
class Numbers_of_mesh {
public:
  template <class Kernel>
  Numbers_of_mesh(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes)
      : attributes_(attributes), areas_(vertex_areas(mesh)) {
    CGAL::Bbox_3 box;
    for (const auto& point : mesh.points) box += point.bbox();
    if (!mesh.points.empty()) diagonal_ = std::hypot(box.x_span(), box.y_span(), box.z_span());
  }

  Column_numbers operator()(const Vertex_attributes::Column& column) const {
    std::vector<double> roots;
    if (column.name == "affine_area_density") { // a fourth root, which makes much of the rounding of its radicand
      const double rounding = rounding_of_quantity("gaussian_curvature", diagonal_);
      for (const double value : column.values) roots.push_back(value * value * value * value <= rounding ? 0 : value);
    }
    std::vector<bool> known;
    const auto* const errors = find_errors(attributes_, column.name);
    if (errors) {
      const std::vector<double> sizes = sizes_of_numbers(column, attributes_);
      for (std::size_t i = 0; i < sizes.size(); ++i) known.push_back(is_known(sizes[i], errors->values[i]));
    }
    return {roots.empty() ? column.values : roots, known, errors ? errors->values : std::vector<double>(), areas_,
            rounding_of_quantity(column.name, diagonal_)};
  }

private:
  const Vertex_attributes& attributes_;
  std::vector<double> areas_;
  double diagonal_ = 0;
};

} // namespace equiaffine

#endif
