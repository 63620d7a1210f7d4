// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/arrow_mesh.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace equiaffine {

namespace {

/// A profile turned about an axis: places along it and multiples of the radius there.
template <std::size_t Rings>
Indexed_triangle_mesh_3<Kernel> turned(const Kernel::Point_3& base, const Kernel::Vector_3& along, double radius,
                                       const std::array<std::array<double, 2>, Rings>& profile, std::uint32_t sides) {
  const double length = std::sqrt(along.squared_length());
  Indexed_triangle_mesh_3<Kernel> mesh;
  if (!std::isfinite(length) || !(length > 0)) return mesh;
  const Kernel::Vector_3 axis = along / length;
  const bool is_steep = std::abs(axis.x()) > 0.6;
  Kernel::Vector_3 u = CGAL::cross_product(axis, is_steep ? Kernel::Vector_3(0, 1, 0) : Kernel::Vector_3(1, 0, 0));
  u = u / std::sqrt(u.squared_length());
  const Kernel::Vector_3 v = CGAL::cross_product(axis, u);
  for (const auto& [place, width] : profile)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.points.push_back(base + place * along + width * radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  for (std::uint32_t ring = 0; ring + 1 < Rings; ++ring)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = ring * sides + k, b = ring * sides + (k + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  return mesh;
}

} // namespace

Indexed_triangle_mesh_3<Kernel> arrow_mesh(const Kernel::Point_3& base, const Kernel::Vector_3& arrow, double radius) {
  // The rings are those of the shaft's ends and of the cone's foot, and the tip is a ring of radius 0, as is the base.
  constexpr std::array<std::array<double, 2>, 5> profile = {{{0, 0}, {0, 1}, {0.75, 1}, {0.75, 2.5}, {1, 0}}};
  return turned(base, arrow, radius, profile, 12);
}

Indexed_triangle_mesh_3<Kernel> rod_mesh(const Kernel::Point_3& from, const Kernel::Point_3& to, double radius) {
  constexpr std::array<std::array<double, 2>, 4> profile = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  return turned(from, to - from, radius, profile, 6);
}

} // namespace equiaffine
