// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of all searches for maps, and the conversion of their results to another kernel. The parameters of
// search functions in the library contain no Eigen types, because the library renames the namespace of Eigen.
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H

#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/determinant.h>
#include <Eigen/Core>

#include <vector>

namespace equiaffine::internal {

using Kernel_of_searches = Any_function_3::Kernel;

/// The coordinates of a range of CGAL's points, as doubles.
template <class Points>
std::vector<Eigen::Vector3d> vectors_of(const Points& points) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : points) result.push_back(coordinates_of(p));
  return result;
}

/// The largest condition number of the linear part of a map between surfaces. With it, rounding of coordinates to
/// 1e-16 causes errors of 1e-12, as large as those of maps between formulas anyway.
inline constexpr double greatest_condition = 1e4;

/// A map is accepted if the expected number of equally good accidental maps is below ten to this power.
inline constexpr double accepted_log10 = -6;

inline double determinant_of(const Kernel_of_searches::Aff_transformation_3& map) {
  return CGAL::determinant(map.m(0, 0), map.m(0, 1), map.m(0, 2), map.m(1, 0), map.m(1, 1), map.m(1, 2), map.m(2, 0),
                           map.m(2, 1), map.m(2, 2));
}

/// Converts the result of a search to another kernel.
template <class Kernel>
typename Kernel::Aff_transformation_3 in_kernel(const Kernel_of_searches::Aff_transformation_3& map) {
  const auto m = [&](int i, int j) { return typename Kernel::FT(map.m(i, j)); };
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2), m(2, 3)};
}

} // namespace equiaffine::internal

#endif
