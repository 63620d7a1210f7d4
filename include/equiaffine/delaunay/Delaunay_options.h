// SPDX-License-Identifier: GPL-3.0-or-later
// The options of Delaunay meshes, and of a domain for CGAL's 3D Mesh Generation.
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_OPTIONS_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_OPTIONS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <optional>
#include <string>
#include <variant>

namespace equiaffine {

/// How the size of facets varies over a surface.
enum class Facet_sizing {
  UNIFORM,   ///< the same size everywhere
  EUCLIDEAN, ///< at most a quarter of the smaller radius of curvature
  AFFINE     ///< equal affine area: proportional to |K_e|^(-1/8), since the affine area is |K_e|^(1/4) dA
};

/// A clip domain derived from the box of a function.
enum class Clip_shape {
  BOX, ///< the box
  BALL ///< the largest ball around the center of the box that fits into it
};

/// The domain in which a surface is searched, and at whose border it is clipped.
using Clip = std::variant<Clip_shape, Clip_domain_3>;

/// The clip domain of a function with the given box.
inline Clip_domain_3 clip_domain(const Clip& clip, const CGAL::Bbox_3& box) {
  if (const auto* const domain = std::get_if<Clip_domain_3>(&clip)) return *domain;
  return std::get<Clip_shape>(clip) == Clip_shape::BALL ? Clip_domain_3::ball_in(box) : Clip_domain_3(box);
}

/// The default maximum facet radius for a function in a box: 1/50 of the diagonal of that box, or of the box of a
/// Clip_domain_3.
inline double default_radius(const Clip& clip, const CGAL::Bbox_3& box) {
  const auto* const domain = std::get_if<Clip_domain_3>(&clip);
  return internal::default_facet_radius(domain ? domain->bbox() : box);
}

} // namespace equiaffine

namespace equiaffine::internal {

inline void check_length(const std::string& field, const std::optional<double>& length) {
  check_field(!length || (std::isfinite(*length) && *length > 0), field, length.value_or(0), "is not a positive length",
              "give one, or leave it out");
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Options of delaunay_surface(). Lengths are in the units of the coordinates.
struct Delaunay_options {
  double angle = 30; ///< the minimum angle of triangles, in degrees, at most 30
  /// The maximum radius of surface Delaunay balls, a length; default_radius() by default.
  std::optional<double> radius = {};
  /// The maximum distance of a triangle's circumcenter from the center of its ball, a length; radius / 10 by default.
  std::optional<double> distance = {};
  Facet_sizing sizing = Facet_sizing::UNIFORM; ///< how the size of triangles varies
  Clip clip = Clip_shape::BOX;                 ///< where the surface is searched and clipped
  /// Whether edges follow the parabolic curves, where the affine curvatures are infinite, so that no triangle
  /// straddles such a curve.
  bool parabolic_curves = false;

  /// \throw Input_error about the field for an invalid value
  void check() const {
    internal::check_field(angle >= 0 && angle <= 30, "angle", angle, "is not between 0 and 30 degrees",
                          "give an angle in this range: above 30 degrees the refinement may not terminate");
    internal::check_length("radius", radius);
    internal::check_length("distance", distance);
  }

  /// The same options with missing lengths replaced by the defaults for a function in a box.
  Delaunay_options completed(const CGAL::Bbox_3& box) const {
    Delaunay_options result = *this;
    if (!radius) result.radius = default_radius(clip, box);
    if (!distance) result.distance = *result.radius / 10;
    return result;
  }
};

/// Options of Implicit_mesh_domain_3.
struct Mesh_domain_options {
  Clip clip = Clip_shape::BOX; ///< where the function is evaluated and the solid is clipped
  /// The maximum radius of surface Delaunay balls in the mesher's criteria, a length; default_radius() by default.
  std::optional<double> radius = {};

  /// \throw Input_error about the field for an invalid value
  void check() const { internal::check_length("radius", radius); }
};

} // namespace equiaffine

#endif
