// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/trust.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine {

Column_numbers::Column_numbers(const std::vector<double>& values, const std::vector<bool>& is_known,
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

Equalization Column_numbers::equalization() const {
  std::vector<Weighted_number> ranked = numbers_;
  std::erase_if(ranked, [&](const auto& each) { return std::abs(each.number) <= resolution_; });
  return Equalization(std::move(ranked));
}

Color_mapping Column_numbers::mapping(double clip_percent, const Equalization& equalization) const {
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

bool Column_numbers::shows_median(const Color_mapping& mapping) const {
  constexpr double least = 1. / 8;
  if (mapping.range.is_diverging)
    return std::max(mapping.position(mapping.range.knee), -mapping.position(-mapping.range.knee)) >= least;
  const double t = mapping.position(quantile_of_sorted(sorted_, 50));
  return std::min(t, 1 - t) >= least;
}

Column_numbers Numbers_of_mesh::operator()(const Vertex_attributes::Column& column) const {
  std::vector<double> roots;
  if (column.name == "affine_area_density") { // a fourth root, which magnifies the rounding of its radicand
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

} // namespace equiaffine
