// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_PATCH_COVER_3_H
#define EQUIAFFINE_SRC_FIT_PATCH_COVER_3_H

#include "fit/Curvature_fit_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/random_subset.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Fits at centers so dense that every point has one near by.
struct Patch_cover_3 {
  using Index = Data_points_3::Index;
  static constexpr Index none = std::numeric_limits<Index>::max();

  std::vector<Index> centers;
  std::vector<std::optional<Curvature_fit_3>> fits; ///< one for each center, if there is one
  std::vector<Index> nearest; ///< for each point the position of its center in `centers`, or `none` without a fit
};

/// Chooses centers in random order, unless another is nearer than `part` of the radius of its fit, and fits there.
inline Patch_cover_3 patch_cover(bool in_threads, const Data_points_3& data, const Fit_choices_3& choices, Fit_use use,
                                 double part) {
  using Index = Data_points_3::Index;
  Patch_cover_3 cover;
  cover.nearest.assign(data.size(), Patch_cover_3::none);
  std::vector<double> squares(data.size(), std::numeric_limits<double>::infinity());
  std::vector<std::optional<Fit_choice>> choice(data.size());
  parallel_for(
      in_threads, 0, data.size(), [&](std::size_t i) { choice[i] = choices.at(data.points[i]); }, 256);

  for (const Index i : random_subset<Index>(data.size(), data.size(), 2)) {
    if (!choice[i] || cover.nearest[i] != Patch_cover_3::none) continue;
    for (const Index j : connected_ball(data, i, part * choices.radius(choice[i]->way, i))) {
      const double square = (data.points[j] - data.points[i]).squaredNorm();
      if (!(square < squares[j])) continue;
      squares[j] = square;
      cover.nearest[j] = Index(cover.centers.size());
    }
    cover.centers.push_back(i);
  }
  cover.fits.resize(cover.centers.size());
  parallel_for(in_threads, 0, cover.centers.size(), [&](std::size_t k) {
    cover.fits[k] = curvature_fit(data, cover.centers[k], *choice[cover.centers[k]], choices, use);
  });
  return cover;
}

} // namespace equiaffine::internal

#endif
