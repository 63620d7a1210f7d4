// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices on known surfaces, and errors of their estimated curvatures.
#ifndef EQUIAFFINE_BENCHMARK_FIT_SAMPLES_H
#define EQUIAFFINE_BENCHMARK_FIT_SAMPLES_H

#include "peers/curvature_peers.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fit_samples {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Exact = Analytic_function_traits_3<Kernel, Expression_3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Structures = std::vector<Fitted_structure_3<double>>;

struct Surface {
  std::string name, formula;
  CGAL::Bbox_3 box;
};

inline const Surface meta = {"meta",
                             "0.6 - exp(-4*((x-.45)^2+y^2+z^2)) - exp(-4*((x+.45)^2+(y-.2)^2+z^2))"
                             " - exp(-4*(x^2+(y+.35)^2+(z-.45)^2)) - exp(-4*((x-.1)^2+(y-.45)^2+(z+.35)^2))",
                             {-1.6, -1.6, -1.6, 1.6, 1.6, 1.6}};
inline const Surface blobby = {
    "blobby", "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*(x^2+y^2+z^2) + 6", {-1.2, -1.2, -1.2, 1.2, 1.2, 1.2}};
inline const Surface torus = {"torus", "(sqrt(x^2+y^2)-2)^2 + z^2 - 0.49", {-3, -3, -1, 3, 3, 1}};
inline const Surface sine = {"sine", "z - sin(3*x)*sin(2.5*y)/2", {-1.5, -1.5, -1, 1.5, 1.5, 1}};

/// Vertices on the surface, irregularly triangulated.
struct Samples {
  Exact surface;
  std::vector<Point_3> points;
  Triangles triangles;
  double edge = 0; ///< the mean length
};

/// Adapts the radius of the mesher's triangles until the number of vertices is correct within 5 %.
inline Samples sample(const Surface& s, double count) {
  const Exact exact(Expression_3(s.formula), s.box);
  double radius = 0.03;
  for (;;) {
    const auto mesh = delaunay_surface(exact, {.radius = radius, .distance = 1});
    const double vertices = double(mesh.points.size());
    if (std::abs(vertices / count - 1) > 0.05) {
      radius *= std::sqrt(vertices / count);
      continue;
    }
    Samples samples{exact, mesh.points, mesh.triangles};
    for (const auto& t : samples.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        samples.edge += std::sqrt(CGAL::squared_distance(samples.points[t[k]], samples.points[t[(k + 1) % 3]])) /
                        (3 * double(samples.triangles.size()));
    return samples;
  }
}

/// Moves points by normal deviates along each axis.
inline std::vector<Point_3> disturbed(const Samples& samples, double part_of_edge) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, part_of_edge * samples.edge);
  std::vector<Point_3> points;
  for (const auto& p : samples.points) {
    const double x = normal(random), y = normal(random), z = normal(random);
    points.emplace_back(p.x() + x, p.y() + y, p.z() + z);
  }
  return points;
}

inline double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values.at(std::size_t(part * double(values.size() - 1)));
}

template <class S>
double size_of(const S& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
}

struct Errors {
  std::vector<double> relative, at_border, inside;
  double covered = 0, trusted = 0, wrong = 0;
};

/// Errors of K relative to |K| + H^2 at points with |K_e| > 0.2. Points within a tenth of the width of `box` are near
/// the border.
inline Errors errors_of(const Samples& samples, const Structures& fits, const CGAL::Bbox_3& box, bool has_border) {
  Errors errors;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Point_3& p = samples.points[i];
    const auto truth = local_structure_at(samples.surface, p);
    if (!(std::abs(truth.euclidean.gaussian_curvature) > 0.2)) continue;
    const double error =
        std::abs(fits[i].structure.affine.gaussian_curvature - truth.affine.gaussian_curvature) / size_of(truth);
    const double known = std::isfinite(error) ? error : 1e300;
    errors.relative.push_back(known);
    const double distance = std::min({p.x() - box.xmin(), box.xmax() - p.x(), p.y() - box.ymin(), box.ymax() - p.y()});
    if (has_border) (distance < 0.1 * (box.xmax() - box.xmin()) ? errors.at_border : errors.inside).push_back(known);
    errors.covered += known * size_of(truth) <= fits[i].error.affine_gaussian_curvature;
    if (fits[i].error.affine_gaussian_curvature > 0.1 * size_of(fits[i].structure)) continue;
    ++errors.trusted;
    errors.wrong += known > 0.1;
  }
  return errors;
}

/// Median errors of H_e and K_e relative to sqrt(|K_e| + H_e^2) and to |K_e| + H_e^2, ignoring the signs of H_e.
struct Euclidean_errors {
  double mean, gaussian;
};

inline Euclidean_errors euclidean_errors(const Samples& samples, const Euclidean_curvatures& estimates) {
  std::vector<double> mean, gaussian;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const auto truth = local_structure_at(samples.surface, samples.points[i]).euclidean;
    const double size = std::abs(truth.gaussian_curvature) + truth.mean_curvature * truth.mean_curvature;
    const auto known = [](double error) { return std::isfinite(error) ? error : 1e300; };
    mean.push_back(known(std::abs(std::abs(estimates.mean[i]) - std::abs(truth.mean_curvature)) / std::sqrt(size)));
    gaussian.push_back(known(std::abs(estimates.gaussian[i] - truth.gaussian_curvature) / size));
  }
  return {quantile(mean, 0.5), quantile(gaussian, 0.5)};
}

} // namespace fit_samples

#endif
