// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/error_columns.h"

#include "source/source.h"
#include <equiaffine/base/parallel_for.h>

#include <cmath>
#include <string>
#include <vector>

namespace equiaffine {

void add_error_columns(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Vertex_attributes& attributes) {
  if (!source.errors) return;
  std::array<std::vector<double>, 2> values;
  for (auto& column : values) column.resize(points.size());
  // Under an affine map of determinant D the affine curvatures are divided by |D| and its root, and so are errors.
  CGAL::Aff_transformation_3<Kernel> to_source(CGAL::IDENTITY);
  double factor = 1;
  if (options.transformation) {
    to_source = options.transformation->inverse();
    factor = std::abs(CGAL::determinant(to_source.m(0, 0), to_source.m(0, 1), to_source.m(0, 2), to_source.m(1, 0),
                                        to_source.m(1, 1), to_source.m(1, 2), to_source.m(2, 0), to_source.m(2, 1),
                                        to_source.m(2, 2)));
  }
  parallel_for<CGAL::Parallel_if_available_tag>(
      0, points.size(),
      [&](std::size_t i) {
        const auto error = (*source.errors)(to_source(points[i]));
        values[0][i] = factor * error.gaussian_curvature;
        values[1][i] = std::sqrt(factor) * error.mean_curvature;
      },
      64);
  for (std::size_t n = 0; n < values.size(); ++n)
    attributes.columns.push_back({std::string(error_attributes[n]), std::move(values[n])});
}

} // namespace equiaffine
