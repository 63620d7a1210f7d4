// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_SAMPLE_ON_LATTICE_H
#define EQUIAFFINE_FUNCTION_SAMPLE_ON_LATTICE_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace equiaffine {

/// The values of a function at the nodes of a lattice; NaN where it is undefined. `on_progress(n)` is called after
/// every n nodes, from any thread. CGAL::Sequential_tag and CGAL::Parallel_tag yield the same values, bit for bit.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Progress>
Volume_3<Kernel_of<Traits>> sample_on_lattice(const Traits& traits, const Lattice_3<Kernel_of<Traits>>& lattice,
                                              const Progress& on_progress) {
  using FT = typename Traits::FT;
  const Batch_function_traits_3<Traits> batch(traits);
  const std::size_t nx = lattice.size()[0], ny = lattice.size()[1], nz = lattice.size()[2];
  Volume_3<Kernel_of<Traits>> volume{lattice, std::vector<FT>(lattice.number_of_nodes())};
  parallel_for<ConcurrencyTag>(0, ny * nz, [&](std::size_t row) {
    std::vector<typename Traits::Point_3> points;
    points.reserve(nx);
    for (std::size_t i = 0; i < nx; ++i)
      points.push_back(lattice.point(FT(double(i)), FT(double(row % ny)), FT(double(row / ny))));
    batch.values(points, std::span(volume.values).subspan(row * nx, nx));
    on_progress(nx);
  });
  return volume;
}

/// The same without progress reports.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
Volume_3<Kernel_of<Traits>> sample_on_lattice(const Traits& traits, const Lattice_3<Kernel_of<Traits>>& lattice) {
  return sample_on_lattice<ConcurrencyTag>(traits, lattice, [](std::size_t) {});
}

/// The values of any thread-safe functor `FT operator()(Point_3) const`. Pass the volume to Sampled_function_traits_3
/// to obtain a function with derivatives.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Function, class Kernel>
Volume_3<Kernel> sample_on_lattice(const Function& f, const Lattice_3<Kernel>& lattice) requires(
    !ImplicitFunctionTraits_3<Function> &&
    std::is_invocable_r_v<typename Kernel::FT, const Function&, const typename Kernel::Point_3&>) {
  using FT = typename Kernel::FT;
  const std::size_t nx = lattice.size()[0], ny = lattice.size()[1], nz = lattice.size()[2];
  Volume_3<Kernel> volume{lattice, std::vector<FT>(lattice.number_of_nodes())};
  parallel_for<ConcurrencyTag>(0, ny * nz, [&](std::size_t row) {
    for (std::size_t i = 0; i < nx; ++i)
      volume.values[row * nx + i] = f(lattice.point(FT(double(i)), FT(double(row % ny)), FT(double(row / ny))));
  });
  return volume;
}

} // namespace equiaffine

#endif
