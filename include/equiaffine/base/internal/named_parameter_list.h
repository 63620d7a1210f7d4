// SPDX-License-Identifier: GPL-3.0-or-later
// All named parameters. To add one, add a function here and its tag in named_parameters.h. The functions that take them
// document types, defaults and meanings.
#ifndef EQUIAFFINE_BASE_INTERNAL_NAMED_PARAMETER_LIST_H
#define EQUIAFFINE_BASE_INTERNAL_NAMED_PARAMETER_LIST_H

/// Defines the function of a writable property map.
#define EQUIAFFINE_VERTEX_MAP(NAME, TAG, CONST, GIVEN)                                                                 \
  template <class Map>                                                                                                 \
  auto NAME(const Map& map) CONST {                                                                                    \
    return internal::add_parameter<internal::TAG>(map, GIVEN);                                                         \
  }

/// Defines one function per named parameter. A free function starts a chain of parameters, a member extends one:
/// `GIVEN` is the chain so far, and `CONST` is `const` for members and empty for free functions.
#define EQUIAFFINE_NAMED_PARAMETERS(CONST, GIVEN)                                                                      \
  /** A range of Polyline_3 on the surface, which become edges of the mesh. */                                         \
  template <class Polylines>                                                                                           \
  auto feature_curves(const Polylines& curves) CONST {                                                                 \
    return internal::add_parameter<internal::Feature_curves_tag>(curves, GIVEN);                                       \
  }                                                                                                                    \
                                                                                                                       \
  /** A property map from the vertices of a mesh to their points. */                                                   \
  template <class Map>                                                                                                 \
  auto vertex_point_map(const Map& map) CONST {                                                                        \
    return internal::add_parameter<internal::Vertex_point_tag>(map, GIVEN);                                            \
  }                                                                                                                    \
                                                                                                                       \
  /** A property map from the elements of a range to their points. */                                                  \
  template <class Map>                                                                                                 \
  auto point_map(const Map& map) CONST {                                                                               \
    return internal::add_parameter<internal::Point_tag>(map, GIVEN);                                                   \
  }                                                                                                                    \
                                                                                                                       \
  /** A property map from the elements of a range to normals of the surface. */                                        \
  template <class Map>                                                                                                 \
  auto normal_map(const Map& map) CONST {                                                                              \
    return internal::add_parameter<internal::Normal_tag>(map, GIVEN);                                                  \
  }                                                                                                                    \
                                                                                                                       \
  /** A writable property map from the edges of a mesh to bool: edges to preserve in remeshing. */                     \
  template <class Map>                                                                                                 \
  auto edge_is_constrained_map(const Map& map) CONST {                                                                 \
    return internal::add_parameter<internal::Edge_is_constrained_tag>(map, GIVEN);                                     \
  }                                                                                                                    \
                                                                                                                       \
  /** A writable property map from the vertices of a mesh to Fit_outcome. */                                           \
  template <class Map>                                                                                                 \
  auto vertex_outcome_map(const Map& map) CONST {                                                                      \
    return internal::add_parameter<internal::Vertex_outcome_tag>(map, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** A property map from the vertices of a mesh to normals, an input of fits. */                                      \
  template <class Map>                                                                                                 \
  auto vertex_normal_map(const Map& map) CONST {                                                                       \
    return internal::add_parameter<internal::Vertex_normal_tag>(map, GIVEN);                                           \
  }                                                                                                                    \
                                                                                                                       \
  /** Accepted for compatibility with CGAL; ignored. */                                                                \
  template <class Traits>                                                                                              \
  auto geom_traits(const Traits& traits) CONST {                                                                       \
    return internal::add_parameter<internal::Geom_traits_tag>(traits, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** Comments to store in a file, a range of std::string. */                                                          \
  template <class Lines>                                                                                               \
  auto comments(const Lines& lines) CONST {                                                                            \
    return internal::add_parameter<internal::Comments_tag>(lines, GIVEN);                                              \
  }                                                                                                                    \
                                                                                                                       \
  /** Accepted for compatibility with CGAL; ignored. */                                                                \
  inline auto verbose(bool is_wanted) CONST {                                                                          \
    return internal::add_parameter<internal::Verbose_tag>(is_wanted, GIVEN);                                           \
  }                                                                                                                    \
                                                                                                                       \
  /** In/out property map of Point_status: UNCONVERGED vertices keep that status. */                                   \
  EQUIAFFINE_VERTEX_MAP(vertex_status_map, Vertex_status_tag, CONST, GIVEN)                                            \
  /** Writable property map of Local_structure_3, or of Fitted_structure_3 for fits. */                                \
  EQUIAFFINE_VERTEX_MAP(vertex_structure_map, Vertex_structure_tag, CONST, GIVEN)                                      \
  /** Writable property map of the unit normal n (`vertex_normal_map` is an input). */                                 \
  EQUIAFFINE_VERTEX_MAP(vertex_unit_normal_map, Vertex_unit_normal_tag, CONST, GIVEN)                                  \
  /** Writable property map of the Euclidean mean curvature in CGAL's sign convention: -H_e. */                        \
  EQUIAFFINE_VERTEX_MAP(vertex_mean_curvature_map, Vertex_mean_curvature_tag, CONST, GIVEN)                            \
  /** Writable property map of the Euclidean Gaussian curvature K_e. */                                                \
  EQUIAFFINE_VERTEX_MAP(vertex_Gaussian_curvature_map, Vertex_Gaussian_curvature_tag, CONST, GIVEN)                    \
  /** Writable property map of CGAL's Principal_curvatures_and_directions, in CGAL's sign. */                          \
  EQUIAFFINE_VERTEX_MAP(vertex_principal_curvatures_and_directions_map, Vertex_principal_curvatures_tag, CONST, GIVEN) \
  /** Writable property map of the affine mean curvature H. */                                                         \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_mean_curvature_map, Vertex_affine_mean_curvature_tag, CONST, GIVEN)              \
  /** Writable property map of the affine Gaussian curvature K. */                                                     \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_Gaussian_curvature_map, Vertex_affine_Gaussian_curvature_tag, CONST, GIVEN)      \
  /** Writable property map of the affine normal xi. */                                                                \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_normal_map, Vertex_affine_normal_tag, CONST, GIVEN)                              \
  /** Writable property map of the affine co-normal nu. */                                                             \
  EQUIAFFINE_VERTEX_MAP(vertex_conormal_map, Vertex_conormal_tag, CONST, GIVEN)                                        \
  /** Writable property map of the Pick invariant J. */                                                                \
  EQUIAFFINE_VERTEX_MAP(vertex_pick_invariant_map, Vertex_pick_invariant_tag, CONST, GIVEN)                            \
  /** Writable property map of the affine metric, a std::array xx xy xz yy yz zz. */                                   \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_metric_map, Vertex_affine_metric_tag, CONST, GIVEN)                              \
  /** Writable property map of the affine area per Euclidean area. */                                                  \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_area_density_map, Vertex_affine_area_density_tag, CONST, GIVEN)                  \
  /** Writable property map of the estimated error of H. */                                                            \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_mean_curvature_error_map, Vertex_affine_mean_curvature_error_tag, CONST, GIVEN)  \
  /** Writable property map of the estimated error of K. */                                                            \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_Gaussian_curvature_error_map, Vertex_affine_Gaussian_curvature_error_tag, CONST, \
                        GIVEN)                                                                                         \
  /** Writable property map of the estimated error of xi, an angle in degrees. */                                      \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_normal_error_map, Vertex_affine_normal_error_tag, CONST, GIVEN)                  \
  /** Writable property map of the estimated error of nu, an angle in degrees. */                                      \
  EQUIAFFINE_VERTEX_MAP(vertex_conormal_error_map, Vertex_conormal_error_tag, CONST, GIVEN)                            \
  /** Writable property map of the estimated error of J. */                                                            \
  EQUIAFFINE_VERTEX_MAP(vertex_pick_invariant_error_map, Vertex_pick_invariant_error_tag, CONST, GIVEN)                \
  /** Writable property map of the estimated error of the affine area density. */                                      \
  EQUIAFFINE_VERTEX_MAP(vertex_affine_area_density_error_map, Vertex_affine_area_density_error_tag, CONST, GIVEN)      \
  /** Writable property map of the estimated error of H_e. */                                                          \
  EQUIAFFINE_VERTEX_MAP(vertex_mean_curvature_error_map, Vertex_mean_curvature_error_tag, CONST, GIVEN)                \
  /** Writable property map of the estimated error of K_e. */                                                          \
  EQUIAFFINE_VERTEX_MAP(vertex_Gaussian_curvature_error_map, Vertex_Gaussian_curvature_error_tag, CONST, GIVEN)        \
  /** Writable property map of the estimated error of n, an angle in degrees. */                                       \
  EQUIAFFINE_VERTEX_MAP(vertex_unit_normal_error_map, Vertex_unit_normal_error_tag, CONST, GIVEN)

#endif
