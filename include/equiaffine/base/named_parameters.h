// SPDX-License-Identifier: GPL-3.0-or-later
// Named parameters in the style of CGAL: `number_of_nodes(128).vertex_position(LINEAR)`. The types are our own, since
// CGAL's list of names is closed and differs between its versions 5 and 6.
#ifndef EQUIAFFINE_BASE_NAMED_PARAMETERS_H
#define EQUIAFFINE_BASE_NAMED_PARAMETERS_H

#include <array>
#include <cstddef>
#include <type_traits>

namespace equiaffine {

/// Where a sampler puts its vertices.
enum class Vertex_position {
  PROJECTED, ///< on the surface, to the last digits
  LINEAR     ///< where linear interpolation of the values at the ends of the grid edge vanishes, as the paper does
};

/// How the size of facets varies over a surface.
enum class Facet_sizing {
  UNIFORM,   ///< not
  EUCLIDEAN, ///< at most a quarter of the smaller radius of curvature
  AFFINE     ///< equal affine area: proportional to |K_e|^(-1/8), since the affine area is |K_e|^(1/4) dA
};

/// Ways from the 34 derivatives of f at a point to the affine structure: our own, and those of Andrade, Lewiner:
/// Affine-invariant curvature estimators for implicit surfaces, 2012, with the errata of doc/errata.md corrected. They
/// are there to compare with, being longer, slower and less accurate.
enum class Estimator {
  COMPACT,        ///< pivot and shear: affine_structure()
  TRANSFORMATION, ///< section 3: an affine map after which the formulas are short
  DIRECT,         ///< section 2: the implicit function theorem on the axis that is closest to the gradient
  DIRECT_Z        ///< section 2 on the z axis wherever the gradient points; not finite where f_z vanishes
};

namespace internal {

struct Estimator_tag {};
struct Clip_tag {};
struct Feature_curves_tag {};
struct Parabolic_features_tag {};
struct Facet_sizing_tag {};
struct Number_of_nodes_tag {};
struct Vertex_position_tag {};
struct Skip_empty_space_tag {};
struct No_parameters {};

/// One parameter and those given before it.
template <class Value, class Tag, class Base = No_parameters>
struct Named_parameters {
  Value value;
  Base base;

  /// Nodes per axis, at least 2 each.
  auto number_of_nodes(const std::array<std::size_t, 3>& n) const {
    return Named_parameters<std::array<std::size_t, 3>, Number_of_nodes_tag, Named_parameters>{n, *this};
  }
  auto number_of_nodes(std::size_t n) const { return number_of_nodes(std::array<std::size_t, 3>{n, n, n}); }

  auto vertex_position(Vertex_position position) const {
    return Named_parameters<Vertex_position, Vertex_position_tag, Named_parameters>{position, *this};
  }

  /// The sampler asks the function for bounds and evaluates it near its zero set only.
  auto skip_empty_space() const {
    return Named_parameters<std::true_type, Skip_empty_space_tag, Named_parameters>{{}, *this};
  }

  auto estimator(Estimator way) const {
    return Named_parameters<Estimator, Estimator_tag, Named_parameters>{way, *this};
  }

  /// A Clip_domain_3.
  template <class Domain>
  auto clip(const Domain& domain) const {
    return Named_parameters<Domain, Clip_tag, Named_parameters>{domain, *this};
  }

  /// A range of Polyline_3.
  template <class Polylines>
  auto feature_curves(const Polylines& curves) const {
    return Named_parameters<Polylines, Feature_curves_tag, Named_parameters>{curves, *this};
  }

  auto parabolic_features() const {
    return Named_parameters<std::true_type, Parabolic_features_tag, Named_parameters>{{}, *this};
  }

  auto facet_sizing(Facet_sizing sizing) const {
    return Named_parameters<Facet_sizing, Facet_sizing_tag, Named_parameters>{sizing, *this};
  }
};

template <class Tag, class Default>
Default get_parameter(const No_parameters&, const Default& otherwise) {
  return otherwise;
}

/// The parameter with the given tag, the last one given if there are several.
template <class Tag, class Default, class Value, class OtherTag, class Base>
Default get_parameter(const Named_parameters<Value, OtherTag, Base>& parameters, const Default& otherwise) {
  if constexpr (std::is_same_v<Tag, OtherTag>) return parameters.value;
  else return get_parameter<Tag>(parameters.base, otherwise);
}

/// Whether a parameter was given.
template <class Tag, class Parameters>
inline constexpr bool has_parameter = false;
template <class Tag, class Value, class OtherTag, class Base>
inline constexpr bool has_parameter<Tag, Named_parameters<Value, OtherTag, Base>> =
    std::is_same_v<Tag, OtherTag> || has_parameter<Tag, Base>;

} // namespace internal

namespace parameters {

/// No parameter: every default.
inline internal::No_parameters default_values() { return {}; }

/// Nodes per axis, at least 2 each; default 64.
inline auto number_of_nodes(const std::array<std::size_t, 3>& n) {
  return internal::Named_parameters<std::array<std::size_t, 3>, internal::Number_of_nodes_tag>{n, {}};
}
inline auto number_of_nodes(std::size_t n) { return number_of_nodes(std::array<std::size_t, 3>{n, n, n}); }

/// Default Vertex_position::PROJECTED.
inline auto vertex_position(Vertex_position position) {
  return internal::Named_parameters<Vertex_position, internal::Vertex_position_tag>{position, {}};
}

/// Requires bounds, see BoundedImplicitFunctionTraits_3. Not the default: whether a function written as code accepts
/// Interval cannot be asked without an error where it does not.
inline auto skip_empty_space() {
  return internal::Named_parameters<std::true_type, internal::Skip_empty_space_tag>{{}, {}};
}

/// How co-normal, affine normal and affine curvatures are computed, default Estimator::COMPACT.
inline auto estimator(Estimator way) { return internal::Named_parameters<Estimator, internal::Estimator_tag>{way, {}}; }

/// The Clip_domain_3 where the surface is looked for; default the box of the function.
template <class Domain>
auto clip(const Domain& domain) {
  return internal::Named_parameters<Domain, internal::Clip_tag>{domain, {}};
}

/// A range of Polyline_3 on the surface that the edges of the mesh follow, default none. Segments are short beside the
/// facets; the mesh has vertices of its own on them.
template <class Polylines>
auto feature_curves(const Polylines& curves) {
  return internal::Named_parameters<Polylines, internal::Feature_curves_tag>{curves, {}};
}

/// The edges of the mesh follow the parabolic curves, so that no triangle has points on both sides of one, where the
/// affine curvatures are infinite.
inline auto parabolic_features() {
  return internal::Named_parameters<std::true_type, internal::Parabolic_features_tag>{{}, {}};
}

/// Default Facet_sizing::UNIFORM.
inline auto facet_sizing(Facet_sizing sizing) {
  return internal::Named_parameters<Facet_sizing, internal::Facet_sizing_tag>{sizing, {}};
}

} // namespace parameters

} // namespace equiaffine

#endif
