// SPDX-License-Identifier: GPL-3.0-or-later
// Converts functions to fields of CGAL's package Isosurfacing_3 (CGAL 6.1 and later), and its fields on a grid to
// volumes. No header of that package is needed.
#ifndef EQUIAFFINE_FUNCTION_ISOSURFACING_FIELDS_H
#define EQUIAFFINE_FUNCTION_ISOSURFACING_FIELDS_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace equiaffine {

/// The values of f at points of any kernel, for a CGAL::Isosurfacing::Value_function_3.
template <ImplicitFunctionTraits_3 Traits>
class Value_of_function_3 {
public:
  explicit Value_of_function_3(Traits traits) : traits_(std::move(traits)) {} ///< copies the model

  /// f(p), in double.
  template <class Point_3>
  double operator()(const Point_3& p) const {
    const typename Traits::FT value = traits_.value(convert_point<Kernel_of<Traits>>(p));
    return CGAL::to_double(value);
  }

private:
  Traits traits_;
};

/// The normalized gradient of f, for a CGAL::Isosurfacing::Gradient_function_3. It is zero where f has no gradient.
template <ImplicitFunctionTraits_3 Traits>
class Gradient_of_function_3 {
public:
  explicit Gradient_of_function_3(Traits traits) : traits_(std::move(traits)) {} ///< copies the model

  /// The unit vector along the gradient of f at p, or the zero vector.
  template <class Point_3>
  auto operator()(const Point_3& p) const {
    using Vector_3 = typename CGAL::Kernel_traits<Point_3>::Kernel::Vector_3;
    const auto jet = first_order(traits_, convert_point<Kernel_of<Traits>>(p));
    const auto& c = jet.coefficients();
    const double x = CGAL::to_double(c[1]), y = CGAL::to_double(c[2]), z = CGAL::to_double(c[3]);
    const double length = std::hypot(x, y, z);
    return std::isnormal(length) ? Vector_3(x / length, y / length, z / length) : Vector_3(0, 0, 0);
  }

private:
  Traits traits_;
};

/// A model of CGAL's IsosurfacingEdgeIntersectionOracle_3 that computes the intersection of an edge and the surface to
/// rounding accuracy; CGAL's own models interpolate or bisect. Dual Contouring uses it; Marching Cubes of CGAL 6.2
/// interpolates.
template <ImplicitFunctionTraits_3 Traits>
class Edge_intersection_of_function_3 {
public:
  explicit Edge_intersection_of_function_3(Traits traits) : traits_(std::move(traits)) {} ///< copies the model

  /// Returns whether the surface f = isovalue intersects the segment p0 p1, according to the values at its ends, and
  /// sets p to the intersection or to a jump of f across the isovalue. Returns false at poles.
  template <class Point_3, class FT, class Domain>
  bool operator()(const Point_3& p0, const Point_3& p1, const FT& value0, const FT& value1, const Domain&,
                  const FT& isovalue, Point_3& p) const {
    const double from = CGAL::to_double(value0 - isovalue), to = CGAL::to_double(value1 - isovalue);
    if (std::isnan(from) || std::isnan(to) || (from <= 0) == (to <= 0)) return false;
    using Kernel = Kernel_of<Traits>;
    const Level_set_traits_3<Traits> level_set(traits_, isovalue);
    const auto zero = intersect_segment(level_set, convert_point<Kernel>(p0), convert_point<Kernel>(p1), from, to);
    if (zero.is_at_pole) return false;
    p = Point_3(zero.point.x(), zero.point.y(), zero.point.z());
    return true;
  }

private:
  Traits traits_;
};

/// The values of a field of CGAL's Isosurfacing_3 at the nodes of its CGAL::Isosurfacing::Cartesian_grid_3. Pass the
/// volume to Sampled_function_traits_3 to obtain a function with derivatives.
template <class Field, class Grid>
Volume_3<CGAL::Simple_cartesian<double>> sampled_field(const Field& field, const Grid& grid) {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto& step = grid.spacing();
  const double dx = CGAL::to_double(step.x()), dy = CGAL::to_double(step.y()), dz = CGAL::to_double(step.z());
  const Lattice_3<Kernel> lattice({grid.xdim(), grid.ydim(), grid.zdim()}, convert_point<Kernel>(grid.span().min()),
                                  {Kernel::Vector_3(dx, 0, 0), Kernel::Vector_3(0, dy, 0), Kernel::Vector_3(0, 0, dz)});
  Volume_3<Kernel> volume{lattice, {}};
  volume.values.reserve(lattice.number_of_nodes());
  for (std::size_t k = 0; k < grid.zdim(); ++k)
    for (std::size_t j = 0; j < grid.ydim(); ++j)
      for (std::size_t i = 0; i < grid.xdim(); ++i) {
        if constexpr (requires { field(i, j, k); }) volume.values.push_back(CGAL::to_double(field(i, j, k)));
        else volume.values.push_back(CGAL::to_double(field(grid.point(i, j, k))));
      }
  return volume;
}

} // namespace equiaffine

#endif
