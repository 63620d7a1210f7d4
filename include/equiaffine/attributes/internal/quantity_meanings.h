// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_QUANTITY_MEANINGS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_QUANTITY_MEANINGS_H

#include <string_view>

/// \file
/// These sentences tell people what a quantity is, and what red (positive) and blue (negative) mean.

namespace equiaffine::meanings {

inline constexpr std::string_view k1 =
    "The greater principal curvature. Red where the surface bends towards its normals in some direction, blue where "
    "it bends away from them in all.";
inline constexpr std::string_view k2 =
    "The lesser principal curvature. Blue where the surface bends away from its normals in some direction, red "
    "where it bends towards them in all.";
inline constexpr std::string_view gaussian_curvature =
    "The product of the principal curvatures. Red where the surface is rounded like a ball, blue where it is a "
    "saddle, white where it can be unrolled.";
inline constexpr std::string_view mean_curvature =
    "The mean of the principal curvatures. Blue where the surface bulges to the side of its normals, red where it "
    "is hollow there.";
inline constexpr std::string_view affine_gaussian_curvature =
    "How affine normals spread, the same after affine maps of determinant 1. Red where they turn as on an "
    "ellipsoid, blue where they turn to opposite sides, white as on a paraboloid.";
inline constexpr std::string_view affine_mean_curvature =
    "The mean of the affine principal curvatures. For normals that point out of the shape: blue as on an ellipsoid, "
    "white as on a paraboloid, red as on a hyperboloid of two sheets.";
inline constexpr std::string_view pick_invariant =
    "How far the surface is from a quadric, where it is white. Blue where it bulges to the side of its normals, red "
    "where it is hollow there, either on saddles.";
inline constexpr std::string_view affine_normal_angle =
    "How far the affine normal leans from the Euclidean one, in degrees: 0 as on a sphere. Darker is more.";
inline constexpr std::string_view affine_area_density =
    "The affine area per Euclidean area, the fourth root of the size of the Gaussian curvature. Darker is more "
    "curved, in both directions; pale where the surface can be unrolled.";
inline constexpr std::string_view affine_k1 =
    "The greater eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view affine_k2 =
    "The lesser eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view quadric_defect =
    "How far the surface is from the quadric that touches it best, zero on quadrics and nowhere else. Darker is "
    "farther.";
inline constexpr std::string_view shape_index =
    "The form regardless of size. Blue for a dome on the side of the normals, white for a saddle, red for a bowl.";
inline constexpr std::string_view curvedness = "How strongly the surface is curved, whatever its form. Darker is more.";
inline constexpr std::string_view affine_frame_scale =
    "The size of the affine curvatures taken together, which the affine frame has for its unit. Darker is more.";
inline constexpr std::string_view affine_frame_quality = "How well the affine frame is determined. Darker is better.";

} // namespace equiaffine::meanings

#endif
