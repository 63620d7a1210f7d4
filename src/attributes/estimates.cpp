// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimates.h"

#include "source/source.h"
#include <equiaffine/base/parallel_for.h>
#include <equiaffine/io/trust.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace equiaffine {

namespace {

constexpr std::array<std::string_view, 4> names_of_estimates = {error_attributes[0], error_attributes[1],
                                                                noise_attributes[0], noise_attributes[1]};

/// The way back from points to those of the source before its transformation, and the factor of K on the way there:
/// under an affine map of determinant D the affine curvatures K and H are divided by |D| and its root.
struct Preimage {
  CGAL::Aff_transformation_3<Kernel> map = CGAL::Aff_transformation_3<Kernel>(CGAL::IDENTITY);
  double factor = 1;

  explicit Preimage(const Source_options& options) {
    if (!options.transformation) return;
    map = options.transformation->inverse();
    factor = std::abs(CGAL::determinant(map.m(0, 0), map.m(0, 1), map.m(0, 2), map.m(1, 0), map.m(1, 1), map.m(1, 2),
                                        map.m(2, 0), map.m(2, 1), map.m(2, 2)));
  }
};

template <class At>
auto at_points(std::span<const Kernel::Point_3> points, Progress& progress, const At& at) {
  progress.begin("estimating errors", points.size());
  std::vector<decltype(at(points.front()))> results(points.size());
  parallel_for<CGAL::Parallel_if_available_tag>(
      0, points.size(),
      [&](std::size_t i) {
        results[i] = at(points[i]);
        progress.advance();
      },
      64);
  return results;
}

} // namespace

Estimates estimates_of(std::span<const Fitted_structure_3<double>> structures) {
  Estimates estimates;
  for (const auto& s : structures) {
    const std::array<double, 4> numbers = {s.error.gaussian_curvature, s.error.mean_curvature,
                                           s.noise.gaussian_curvature, s.noise.mean_curvature};
    for (std::size_t n = 0; n < numbers.size(); ++n) estimates.columns[n].push_back(numbers[n]);
  }
  estimates.fit = statistics_of(structures);
  return estimates;
}

Estimates estimates_at(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Progress& progress) {
  const Preimage preimage(options);
  Estimates estimates;
  if (source.fit) {
    estimates = estimates_of(
        at_points(points, progress, [&](const auto& p) { return source.fit->structure(preimage.map(p)); }));
  } else if (source.errors) {
    for (const auto& error :
         at_points(points, progress, [&](const auto& p) { return (*source.errors)(preimage.map(p)); })) {
      estimates.columns[0].push_back(error.gaussian_curvature);
      estimates.columns[1].push_back(error.mean_curvature);
    }
  }
  for (std::size_t n = 0; n < estimates.columns.size(); ++n)
    for (double& number : estimates.columns[n]) number *= n % 2 == 0 ? preimage.factor : std::sqrt(preimage.factor);
  return estimates;
}

void add_estimates(const Estimates& estimates, std::span<const std::string> names, Vertex_attributes& attributes) {
  for (const std::string& name : names) {
    const auto place = std::find(names_of_estimates.begin(), names_of_estimates.end(), name);
    const auto& numbers = estimates.columns[std::size_t(place - names_of_estimates.begin())];
    if (!numbers.empty() && !find_column(attributes, name)) attributes.columns.push_back({name, numbers});
  }
}

void add_errors(const Estimates& estimates, Vertex_attributes& attributes) {
  const std::array<std::string, 2> names = {std::string(error_attributes[0]), std::string(error_attributes[1])};
  add_estimates(estimates, names, attributes);
}

Vertex_attributes attributes_of(std::span<const Fitted_structure_3<double>> structures,
                                const Attribute_selection& selection) {
  Vertex_attributes result;
  for (const Attribute& attribute : selection.columns) {
    auto& column = result.columns.emplace_back(Vertex_attributes::Column{std::string(attribute.name), {}});
    for (const auto& s : structures) column.values.push_back(attribute.get(s.structure));
  }
  if (!selection.has_status) return result;
  result.status.emplace();
  for (const auto& s : structures) result.status->push_back(s.structure.status);
  return result;
}

} // namespace equiaffine
