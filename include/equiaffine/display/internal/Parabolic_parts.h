// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_PARABOLIC_PARTS_H
#define EQUIAFFINE_DISPLAY_INTERNAL_PARABOLIC_PARTS_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstdint>
#include <vector>

// The members without a body are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// How pictures treat a vertex, depending on its status.
enum class Parabolic_part : std::uint8_t {
  NONE,  ///< it is not parabolic, or lies on a curve of zero Gaussian curvature
  SPOT,  ///< one of a few parabolic vertices amid regular ones, with interpolated numbers
  REGION ///< a corner of a triangle of parabolic vertices, which is painted as such
};

/// The legend of parabolic regions in pictures.
inline constexpr const char* parabolic_region_text = "parabolic region: Gaussian curvature zero within its error";

/// The parts of a surface where affine quantities are undefined because the Gaussian curvature is zero, or zero
/// within its estimated error. For a formula these are curves. For a scan they are regions, and single vertices where
/// noise happens to cancel. Marking each of these vertices would only show noise, so they get the mean of their
/// neighbors.
class Parabolic_parts {
public:
  using Triangle = std::array<std::uint32_t, 3>;

  Parabolic_parts(const std::vector<Triangle>& triangles, const Vertex_attributes& attributes);

  /// The part of each vertex; empty if no vertex is parabolic.
  const std::vector<Parabolic_part>& parts() const { return parts_; }

  /// The vertices in spots, ascending.
  const std::vector<std::uint32_t>& spots() const { return spots_; }

  /// Returns the numbers, with missing ones in spots interpolated from their neighbors.
  std::vector<double> filled(std::vector<double> numbers) const;

  /// Returns the Gaussian curvatures with the sign of the side to which pictures assign each vertex: zero on curves,
  /// that of the neighbors in spots, NaN in regions and where it is unknown.
  std::vector<double> sides(std::vector<double> curvatures) const;

private:
  void find_parts(const std::vector<Triangle>& triangles, const std::vector<Point_status>& status);

  unsigned kind_of(std::uint32_t regular) const;

  std::vector<bool> is_parabolic_;
  std::vector<double> curvatures_; // empty if the attributes do not include them
  std::vector<Parabolic_part> parts_;
  std::vector<std::uint32_t> spots_;
  std::vector<Triangle> triangles_of_spots_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
