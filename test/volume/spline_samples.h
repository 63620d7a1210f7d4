// SPDX-License-Identifier: GPL-3.0-or-later
// Lattices, samples there, and points where splines of the samples are tested.
#ifndef EQUIAFFINE_TEST_VOLUME_SPLINE_SAMPLES_H
#define EQUIAFFINE_TEST_VOLUME_SPLINE_SAMPLES_H

#include "support/sample_volume.h"
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace spline_samples {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using Volume_3 = equiaffine::Volume_3<Kernel>;
using Spline_function_3 = equiaffine::Spline_function_3<Kernel>;
using Jet_3 = equiaffine::Jet_3<double>;
using equiaffine::Spline_scheme;

template <class Function>
Volume_3 sample(const Lattice_3& lattice, const Function& f) {
  return sample_volume(lattice, f);
}

inline Volume_3 random_volume(const Lattice_3& lattice) {
  std::mt19937 random(1);
  return sample(lattice, [&](double, double, double) { return double(random()) / double(random.max()) - 0.5; });
}

inline Lattice_3 unit_lattice(std::size_t nx, std::size_t ny, std::size_t nz) {
  return Lattice_3({nx, ny, nz}, Point_3(0, 0, 0), {Vector_3(1, 0, 0), Vector_3(0, 1, 0), Vector_3(0, 0, 1)});
}

// A lattice that is anisotropic, rotated, a little sheared, left-handed, and away from the origin.
inline Lattice_3 skew_lattice(std::size_t nx, std::size_t ny, std::size_t nz) {
  return Lattice_3({nx, ny, nz}, Point_3(-2, 1, 3),
                   {Vector_3(0.3, 0.4, 0), Vector_3(0.8, -0.6, 0.1), Vector_3(0, 0.2, 1.2)});
}

// Points all over the lattice: corners, points of faces and edges, and of outer and inner cells.
inline std::vector<Point_3> points_of(const Lattice_3& lattice) {
  const auto coordinates = [](std::size_t n) {
    const double last = double(n - 1);
    return std::array{0.0, 0.07, 1.6, 0.43 * last, last - 0.8, last};
  };
  std::vector<Point_3> points;
  for (const double u : coordinates(lattice.size()[0]))
    for (const double v : coordinates(lattice.size()[1]))
      for (const double w : coordinates(lattice.size()[2])) points.push_back(lattice.point(u, v, w));
  return points;
}

inline bool all_nan(const Jet_3& jet) {
  return std::all_of(jet.coefficients().begin(), jet.coefficients().end(), [](double c) { return std::isnan(c); });
}

inline bool all_finite(const Jet_3& jet) {
  return std::all_of(jet.coefficients().begin(), jet.coefficients().end(), [](double c) { return std::isfinite(c); });
}

} // namespace spline_samples

#endif
