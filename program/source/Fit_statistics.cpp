// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/Fit_statistics.h"

#include "source/source.h"
#include <equiaffine/base/internal/quantile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

using Structures = std::span<const Fitted_structure_3<double>>;

/// The least, median and greatest of the numbers of structures that have one.
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

using Structure = Fitted_structure_3<double>;

template <class Condition>
double part(Structures structures, const Condition& condition) {
  if (structures.empty()) return 0;
  return double(std::count_if(structures.begin(), structures.end(), condition)) / double(structures.size());
}

bool is_doubtful(const Structure& s) {
  return s.structure.status == Point_status::REGULAR &&
         !error_table<double>[0].is_known(s.structure, s.error, error_bounds.back());
}

bool is_noise(const Structure& s) {
  return !(s.noise.affine_gaussian_curvature <= s.error.affine_gaussian_curvature / 2);
}

struct Words {
  std::string_view attribute, label, symbol;
};

constexpr std::array<Words, 5> curvature_words = {
    {{"affine_gaussian_curvature", "affine Gaussian curvature", "K"},
     {"affine_mean_curvature", "affine mean curvature", "H"},
     {"pick_invariant", "Pick invariant", "J"},
     {"affine_normal", "affine normal", "affine normal"},
     {"affine_area_density", "affine area density", "affine area density"}}};

} // namespace

const Fit_statistics::Parts& Fit_statistics::known_of(std::string_view attribute) const {
  std::size_t row = 0;
  while (error_table<double>[row].attribute != attribute) ++row;
  return known[row];
}

Known_quantity first_known(const Fit_statistics& fit) {
  for (const auto& [attribute, label, symbol] : curvature_words)
    if (fit.known_of(attribute).back() >= 0.5) return {label, fit.known_of(attribute)};
  return {curvature_words[0].label, fit.known[0]};
}

std::string table_of_known(const Fit_statistics& fit) {
  std::ostringstream text;
  for (const auto& [attribute, label, symbol] : curvature_words) {
    const auto& [to_10, to_20, to_50] = fit.known_of(attribute);
    text << (text.str().empty() ? "" : ", ") << symbol << ' ' << std::lround(100 * to_20) << " / "
         << std::lround(100 * to_50);
  }
  text << "; K as a part of |K| + H^2, H of its root";
  return text.str();
}

Fit_statistics statistics_of(Structures structures) {
  Fit_statistics statistics;
  for (const auto& s : structures)
    if (s.is_at_scale) statistics.scale = s.scale;
  statistics.scales = spread(structures, [](const auto& s) { return s.scale; });
  statistics.noise = spread(structures, [](const auto& s) { return s.deviation; })[1];
  for (std::size_t row = 0; row < statistics.known.size(); ++row)
    for (std::size_t n = 0; n < error_bounds.size(); ++n)
      statistics.known[row][n] = part(structures, [&](const Structure& s) {
        return error_table<double>[row].is_known(s.structure, s.error, error_bounds[n]);
      });
  statistics.parabolic =
      part(structures, [](const Structure& s) { return s.structure.status == Point_status::PARABOLIC; });
  statistics.without_fit =
      part(structures, [](const Structure& s) { return s.structure.status == Point_status::OUTSIDE; });
  statistics.doubtful_by_noise = part(structures, [](const Structure& s) { return is_doubtful(s) && is_noise(s); });
  statistics.doubtful_by_detail = part(structures, [](const Structure& s) { return is_doubtful(s) && !is_noise(s); });
  return statistics;
}

Close_sheets close_sheets(const Fit_traits& fit, const Source_options& options) {
  constexpr double steps_between_sheets = 1.5;
  const Lattice_3<Kernel> lattice(options.resolution.value_or(default_resolution(options.kind)), fit.bbox());
  double step = 0;
  for (const auto& s : lattice.steps()) step = std::max(step, std::sqrt(s.squared_length()));
  std::vector<double> distances = fit.distances_of_sheets(step);
  if (distances.empty()) return {0, std::numeric_limits<double>::quiet_NaN(), 0};
  const std::size_t count = distances.size();
  const double tenth = nth_smallest(std::move(distances), count / 10);
  const CGAL::Bbox_3 box = fit.bbox();
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  return {count, tenth, std::size_t(std::min(1e9, steps_between_sheets * longest / tenth)) + 2};
}

} // namespace equiaffine
