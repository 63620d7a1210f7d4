// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of known curvatures that is not a polynomial of low degree, and samples of it.
#ifndef EQUIAFFINE_TEST_SUPPORT_FIT_DATA_H
#define EQUIAFFINE_TEST_SUPPORT_FIT_DATA_H

#include "support/formulas.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace equiaffine::test {

using Fit_kernel = CGAL::Simple_cartesian<double>;
using Fit_mesh = CGAL::Surface_mesh<Fit_kernel::Point_3>;

/// 0.6 = the sum of exp(-4 |p - c|^2) over four centers.
inline auto metaballs() {
  return formula("0.6-exp(-4*((x-.45)^2+y^2+z^2))-exp(-4*((x+.45)^2+(y-.2)^2+z^2))"
                 "-exp(-4*(x^2+(y+.35)^2+(z-.45)^2))-exp(-4*((x-.1)^2+(y-.45)^2+(z+.35)^2))",
                 CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
}

/// The vertices lie on the surface exactly; `nodes` is the number of nodes of the grid along an axis.
inline Fit_mesh metaballs_mesh(std::size_t nodes) {
  return to_surface_mesh(surface_of(metaballs(), {.resolution = nodes}));
}

inline std::vector<Fit_kernel::Point_3> points_of(const Fit_mesh& mesh) {
  return std::vector<Fit_kernel::Point_3>(mesh.points().begin(), mesh.points().end());
}

/// Moves every point in space by a normal deviate of the given standard deviation along each axis.
inline void add_noise(Fit_mesh& mesh, double deviation) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const auto v : mesh.vertices()) {
    const double x = deviation * normal(random), y = deviation * normal(random), z = deviation * normal(random);
    mesh.point(v) = mesh.point(v) + Fit_kernel::Vector_3(x, y, z);
  }
}

inline double mean_edge(const Fit_mesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / double(mesh.number_of_edges());
}

/// The errors of K relative to |K| + H^2, at points where the Gaussian curvature is not small.
struct Fit_errors {
  std::vector<double> relative;
  std::size_t covered = 0, trusted = 0, trusted_but_wrong = 0, without_fit = 0;

  double quantile(double part) const {
    std::vector<double> sorted = relative;
    std::sort(sorted.begin(), sorted.end());
    return sorted.at(std::size_t(part * double(sorted.size() - 1)));
  }
  double part_covered() const { return double(covered) / double(relative.size()); }
};

/// Compares structures at noisy points with those of the surface at the `exact` points.
inline Fit_errors errors_of_fit(const std::vector<Fitted_structure_3<double>>& structures,
                                std::span<const Fit_kernel::Point_3> exact) {
  Fit_errors errors;
  const auto traits = metaballs();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto truth = local_structure_at(traits, exact[i]);
    if (!(std::abs(truth.euclidean.gaussian_curvature) > 0.2)) continue;
    const auto& fit = structures[i];
    if (fit.structure.status != Point_status::REGULAR) {
      ++errors.without_fit;
      continue;
    }
    const auto size = [](const auto& s) {
      return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
    };
    const double error = std::abs(fit.structure.affine.gaussian_curvature - truth.affine.gaussian_curvature);
    errors.relative.push_back(error / size(truth));
    errors.covered += error <= fit.error.affine_gaussian_curvature;
    if (fit.error.affine_gaussian_curvature > 0.1 * size(fit.structure)) continue;
    ++errors.trusted;
    errors.trusted_but_wrong += error > 0.1 * size(truth);
  }
  return errors;
}

/// The fraction of vertices at which numbers differ by at most the errors.
template <class Difference, class Error>
double part_within(std::size_t count, const Difference& difference, const Error& error) {
  double within = 0, all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(difference(i))) continue;
    ++all;
    within += difference(i) <= error(i);
  }
  return within / all;
}

} // namespace equiaffine::test

#endif
