// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/nodes_to_measure.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Volume_options.h>

#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

namespace {

using Spline = Spline_function_3<Kernel_of_samples>;

/// Calls f(node, sample) for all nodes of a volume.
template <class F>
void for_each_node(const Volume_view& volume, const F& f) {
  const auto [nx, ny, nz] = volume.lattice().size();
  std::vector<double> row(nx);
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      volume.copy_line({0, j, k}, 0, row);
      for (std::size_t i = 0; i < nx; ++i) f(std::array{i, j, k}, row[i]);
    }
}

/// Whether a spline keeps fewer than nine tenths of the rarer samples of a mask on their side of the level, judged by
/// a subset of them.
bool erases_mask(const Spline& spline, const Volume_view& mask, double level) {
  constexpr std::size_t enough = 1000;
  std::array<std::size_t, 2> sizes{};
  for_each_node(mask, [&](const auto&, double sample) { ++sizes[sample > level]; });
  const bool is_above = sizes[1] < sizes[0];
  const std::size_t step = 1 + sizes[is_above] / enough;
  std::size_t seen = 0, tried = 0, kept = 0;
  for_each_node(mask, [&](const std::array<std::size_t, 3>& node, double sample) {
    if ((sample > level) != is_above || seen++ % step != 0) return;
    ++tried;
    kept += (spline.value(mask.lattice().point(double(node[0]), double(node[1]), double(node[2]))) > level) == is_above;
  });
  return 10 * kept < 9 * tried;
}

Spline spline_with(double smoothing, bool in_threads, const Volume_view& volume, Volume_options options) {
  options.smoothing = smoothing;
  return on_threads_if(in_threads, [&] { return Spline(volume, options, CGAL::Parallel_if_available_tag()); });
}

} // namespace

Smoothing_decision decided_smoothing(bool in_threads, const Volume_view& volume, const Volume_options& options) {
  const auto parts = Volume_parts::of(volume);
  Smoothing_decision decision;
  decision.noise = noise_of_samples(in_threads, parts, options.level);
  decision.distinct_values = few_values_of_samples(parts);
  decision.is_chosen = !options.smoothing;
  double& smoothing = decision.smoothing;
  smoothing = options.smoothing ? *options.smoothing : smoothing_of_samples(in_threads, parts, decision.noise, options);
  while (decision.is_chosen && decision.distinct_values && options.level && smoothing > 0 &&
         erases_mask(spline_with(smoothing, in_threads, volume, options), volume, *options.level))
    smoothing = smaller_scale_to_choose(smoothing);
  return decision;
}

} // namespace equiaffine::internal
