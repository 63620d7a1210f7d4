// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimates.h"

#include "source/source.h"
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/function/internal/point_blocks.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

namespace {

/// The inverse of the source's transformation, and its factor of K: an affine map of determinant D divides the affine
/// curvatures K and H by |D| and by its square root.
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

/// Calls at(local, p) for the preimage p of each point; `local` is the estimator, possibly restricted to cells around
/// p.
template <class Estimator, class At>
auto at_points(const Estimator& estimator, std::span<const Kernel::Point_3> images, const Preimage& preimage,
               Progress& progress, const At& at) {
  progress.begin("estimating errors", images.size());
  std::vector<Kernel::Point_3> points;
  points.reserve(images.size());
  for (const auto& image : images) points.push_back(preimage.map(image));
  std::vector<decltype(at(estimator, points.front()))> results(points.size());
  for_each_point_block<CGAL::Parallel_if_available_tag>(
      estimator, std::span<const Kernel::Point_3>(points), 64, 0,
      [&](const Estimator& local, std::span<const std::size_t> numbers) {
        for (const std::size_t n : numbers) {
          results[n] = at(local, points[n]);
          progress.advance();
        }
      });
  return results;
}

/// Turns estimates at points of the source into those of its image. Errors of angles and Euclidean curvatures become
/// infinite, since their transformed values have no estimate.
void transform(Estimates& estimates, double factor) {
  const auto& attributes = estimate_attributes();
  for (auto& column : estimates.columns) {
    const auto attribute = std::find_if(attributes.begin(), attributes.end(),
                                        [&](const Estimate_attribute& a) { return a.name == column.name; });
    const Quantity* const quantity = find_quantity(attribute->row->name);
    const bool is_invariant = quantity && quantity->group == "Affine" && quantity->weight < -1;
    const double multiple =
        is_invariant ? std::pow(factor, -quantity->weight / 6.) : std::numeric_limits<double>::infinity();
    for (double& number : column.values) number *= multiple;
  }
}

} // namespace

Estimates estimates_of(std::span<const Fitted_structure_3<double>> structures) {
  Estimates estimates;
  for (const auto& attribute : estimate_attributes()) estimates.columns.push_back(attribute.column(structures));
  estimates.fit = statistics_of_fit(structures);
  return estimates;
}

Estimates estimates_at(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Progress& progress) {
  const Preimage preimage(options);
  Estimates estimates;
  if (source.fit) {
    estimates = estimates_of(at_points(*source.fit, points, preimage, progress,
                                       [](const Fit_traits& fit, const auto& p) { return fit.structure(p); }));
  } else if (source.errors) {
    const auto errors = at_points(*source.errors, points, preimage, progress,
                                  [](const Curvature_error_3<Kernel>& local, const auto& p) { return local(p); });
    for (const auto& attribute : estimate_attributes()) {
      if (!attribute.is_of_splines) continue;
      auto& column = estimates.columns.emplace_back(Vertex_attributes::Column{attribute.name, {}});
      for (const auto& error : errors)
        column.values.push_back(
            attribute.row->error.get(Local_structure_error_3<double>{error, 0, 0, 0, 0, 0, 0, 0, 0}));
    }
  }
  if (options.transformation) transform(estimates, preimage.factor);
  return estimates;
}

void add_estimates(const Estimates& estimates, std::span<const std::string> names, Vertex_attributes& attributes) {
  for (const std::string& name : names) {
    const auto column =
        std::find_if(estimates.columns.begin(), estimates.columns.end(), [&](const auto& c) { return c.name == name; });
    if (column != estimates.columns.end() && !find_column(attributes, name)) attributes.columns.push_back(*column);
  }
}

void add_errors(const Estimates& estimates, Vertex_attributes& attributes) {
  add_estimates(estimates, error_attributes(), attributes);
}

} // namespace equiaffine
