// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_SAMPLE_VOLUME_H
#define EQUIAFFINE_TEST_SUPPORT_SAMPLE_VOLUME_H

#include <equiaffine/volume/Volume_3.h>

#include <cstddef>
#include <random>

/// f(x, y, z) at the nodes of a lattice, with white noise.
template <class Kernel, class Function>
equiaffine::Volume_3<Kernel> sample_volume(const equiaffine::Lattice_3<Kernel>& lattice, const Function& f,
                                           double deviation = 0) {
  equiaffine::Volume_3<Kernel> volume{lattice, {}};
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto [nx, ny, nz] = lattice.size();
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const auto p = lattice.point(double(i), double(j), double(k));
        volume.values.push_back(f(p.x(), p.y(), p.z()) + (deviation > 0 ? deviation * normal(random) : 0));
      }
  return volume;
}

#endif
