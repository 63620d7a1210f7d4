// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_FACET_SIZING_H
#define EQUIAFFINE_DELAUNAY_FACET_SIZING_H

namespace equiaffine {

/// How the size of facets varies over a surface.
enum class Facet_sizing {
  UNIFORM,   ///< the same size everywhere
  EUCLIDEAN, ///< at most a quarter of the smaller radius of curvature
  AFFINE     ///< equal affine area: proportional to |K_e|^(-1/8), since the affine area is |K_e|^(1/4) dA
};

} // namespace equiaffine

#endif
