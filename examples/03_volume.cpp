// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes a level set of a function that is sampled on a grid, for example by a scanner or a simulation. Its derivatives
// are those of a spline. The surface is an ellipsoid with semi-axes 3, 2, 1, where K = 1/6 everywhere. This allows you
// to measure the errors, which decrease with the spacing of the nodes.
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = equiaffine::Sampled_function_traits_3<Kernel>;

//! [volume]
equiaffine::Volume_3<Kernel> sample(std::size_t n) {
  const equiaffine::Lattice_3<Kernel> lattice({n, n, n}, CGAL::Bbox_3(-4, -3, -2, 4, 3, 2));
  equiaffine::Volume_3<Kernel> volume{lattice, {}};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const Kernel::Point_3 p = lattice.point(double(i), double(j), double(k));
        volume.values.push_back(1 - std::exp(1 - p.x() * p.x() / 9 - p.y() * p.y() / 4 - p.z() * p.z()));
      }
  return volume;
}
//! [volume]

int main() {
  for (const std::size_t n : {32u, 64u}) {
    const Traits traits(sample(n));
    const auto surface = equiaffine::marching_cubes(traits);
    const auto attributes = equiaffine::compute_attributes(traits, surface.points,
                                                           equiaffine::select_attributes("affine_gaussian_curvature"));

    double worst = 0;
    for (const double K : attributes.columns[0].values) worst = std::max(worst, std::abs(K - 1 / 6.));
    std::printf("%zu nodes per axis: %5zu vertices, largest error of K %.4g\n", n, surface.points.size(), worst);
  }
}
