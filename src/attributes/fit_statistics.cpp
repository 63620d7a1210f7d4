// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/geometry/Point_status.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

namespace {

using Structure = Fitted_structure_3<double>;
using Structures = std::span<const Structure>;

/// The minimum, median, and maximum of a number over the structures that have it.
template <class Get>
std::array<double, 3> spread(Structures structures, Get get) {
  std::vector<double> numbers;
  for (const auto& s : structures)
    if (std::isfinite(get(s))) numbers.push_back(get(s));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return {nan, nan, nan};
  std::sort(numbers.begin(), numbers.end());
  return {numbers.front(), numbers[numbers.size() / 2], numbers.back()};
}

template <class Condition>
double part(Structures structures, const Condition& condition) {
  if (structures.empty()) return 0;
  return double(std::count_if(structures.begin(), structures.end(), condition)) / double(structures.size());
}

bool is_doubtful(const Structure& s) {
  return s.structure.status == Point_status::REGULAR &&
         !find_row("affine_gaussian_curvature")
              ->error.is_known(s.structure, s.error, Fit_statistics::error_bounds.back());
}

bool is_noise(const Structure& s) {
  return !(s.noise.affine_gaussian_curvature <= s.error.affine_gaussian_curvature / 2);
}

} // namespace

Vertex_attributes::Column Estimate_attribute::column(Structures structures) const {
  Vertex_attributes::Column result = {name, {}};
  result.values.reserve(structures.size());
  for (const auto& s : structures)
    result.values.push_back(row->error.get(kind == Estimate_kind::ERROR   ? s.error
                                           : kind == Estimate_kind::NOISE ? s.noise
                                                                          : s.detail));
  return result;
}

const std::vector<Estimate_attribute>& estimate_attributes() {
  static const std::vector<Estimate_attribute> attributes = [] {
    constexpr std::size_t of_splines = 2; // the affine curvatures, which have all kinds of errors
    std::vector<Estimate_attribute> result;
    const auto add = [&](Estimate_kind kind, const std::string& suffix, std::size_t count) {
      for (std::size_t n = 0; n < count; ++n)
        result.push_back({std::string(rows_with_error[n]->name) + suffix, kind, rows_with_error[n],
                          kind == Estimate_kind::ERROR && n < of_splines});
    };
    add(Estimate_kind::ERROR, "_error", rows_with_error.size());
    add(Estimate_kind::NOISE, "_noise", of_splines);
    add(Estimate_kind::DETAIL, "_detail", of_splines);
    return result;
  }();
  return attributes;
}

Vertex_attributes attributes_of_fit(Structures structures, const Attribute_selection& selection,
                                    std::span<const double> areas) {
  Vertex_attributes result;
  for (const Attribute& attribute : selection.columns)
    result.columns.push_back({std::string(attribute.name), std::vector<double>(structures.size())});
  for (std::size_t i = 0; i < structures.size(); ++i) {
    Attribute_sample<double> sample(structures[i].structure);
    if (!areas.empty()) sample.vertex_area = areas[i];
    for (std::size_t c = 0; c < selection.columns.size(); ++c)
      result.columns[c].values[i] = selection.columns[c].get(sample);
  }
  if (!selection.has_status) return result;
  result.status.emplace();
  for (const auto& s : structures) result.status->push_back(s.structure.status);
  return result;
}

Fit_statistics statistics_of_fit(Structures structures) {
  Fit_statistics statistics;
  for (const auto& s : structures)
    if (s.is_at_scale) statistics.scale = s.scale;
  statistics.scales = spread(structures, [](const auto& s) { return s.scale; });
  statistics.noise = spread(structures, [](const auto& s) { return s.deviation; })[1];
  for (std::size_t row = 0; row < statistics.known.size(); ++row)
    for (std::size_t n = 0; n < Fit_statistics::error_bounds.size(); ++n)
      statistics.known[row][n] = part(structures, [&](const Structure& s) {
        return rows_with_error[row]->error.is_known(s.structure, s.error, Fit_statistics::error_bounds[n]);
      });
  statistics.parabolic =
      part(structures, [](const Structure& s) { return s.structure.status == Point_status::PARABOLIC; });
  statistics.without_fit =
      part(structures, [](const Structure& s) { return s.structure.status == Point_status::OUTSIDE; });
  statistics.doubtful_by_noise = part(structures, [](const Structure& s) { return is_doubtful(s) && is_noise(s); });
  statistics.doubtful_by_detail = part(structures, [](const Structure& s) { return is_doubtful(s) && !is_noise(s); });
  return statistics;
}

std::string_view first_known(const Fit_statistics& fit) {
  for (const std::string_view quantity : affine_quantities)
    if (fit.known_of(quantity).back() >= 0.5) return quantity;
  return affine_quantities.front();
}

std::vector<Doubt_of_points> doubts_of(const Fit_statistics& fit, bool has_affine_curvatures) {
  constexpr double least = 0.1; // fraction of points where K is unknown
  std::vector<Doubt_of_points> doubts = {{Fit_doubt::WITHOUT_FIT, fit.without_fit}};
  double unknown = fit.without_fit;
  if (has_affine_curvatures) {
    doubts.push_back({Fit_doubt::NOISE, fit.doubtful_by_noise});
    doubts.push_back({Fit_doubt::DETAIL, fit.doubtful_by_detail});
    unknown += fit.doubtful_by_noise + fit.doubtful_by_detail;
  }
  if (!(unknown > fit.known_of("affine_gaussian_curvature").back())) return {};
  std::erase_if(doubts, [&](const Doubt_of_points& doubt) { return !(doubt.part > least * unknown); });
  return doubts;
}

} // namespace equiaffine
