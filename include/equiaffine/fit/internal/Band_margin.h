// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_BAND_MARGIN_H
#define EQUIAFFINE_FIT_INTERNAL_BAND_MARGIN_H

namespace equiaffine::internal {

/// The margin of a band holds points up to a height, and lets them be farther across the higher they are, as above a
/// crease.
struct Band_margin {
  double height = 0, slope = 0;
};

} // namespace equiaffine::internal

#endif
