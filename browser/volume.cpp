// SPDX-License-Identifier: GPL-3.0-or-later
// Level sets of a volume, whose spline stays until the next volume comes.
#include "sample.h"
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/Sampled_function_traits_3.h>
#include <equiaffine/Volume_3.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace {

std::vector<double> values;
std::optional<equiaffine::Sampled_function_traits_3<Kernel>> spline;

} // namespace

/// Makes place for the values of a volume, i fastest.
EXPORTED double* eq_values(int nodes) {
  spline.reset();
  try {
    values.assign(std::size_t(nodes), 0);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return values.data();
}

/// Takes the values as those of a lattice of nx, ny, nz nodes; `placing` is its origin and its three steps. Smoothing is a
/// scale in steps, 0 for none.
EXPORTED int eq_volume(int nx, int ny, int nz, const double* placing, double smoothing) {
  return outcome_of([&] {
    const auto vector = [&](int k) { return Kernel::Vector_3(placing[3 * k], placing[3 * k + 1], placing[3 * k + 2]); };
    const equiaffine::Lattice_3<Kernel> lattice({std::size_t(nx), std::size_t(ny), std::size_t(nz)},
                                                CGAL::ORIGIN + vector(0), {vector(1), vector(2), vector(3)});
    spline.emplace(equiaffine::Volume_3<Kernel>{lattice, std::exchange(values, {})},
                   equiaffine::Spline_parameters{.smoothing = smoothing}, CGAL::Sequential_tag());
  });
}

/// Meshes a level set of the volume on its own lattice.
EXPORTED int eq_level_set(double level, const char* attributes) {
  return outcome_of([&] {
    surface = {};
    if (!spline) throw equiaffine::Input_error("there is no volume yet");
    sample(equiaffine::Level_set_traits_3(*spline, level), attributes);
  });
}
