// SPDX-License-Identifier: GPL-3.0-or-later
// The closed list of named parameters: a new one is one function here, and its tag in named_parameters.h. Functions
// that take them have tables of types, defaults and meanings.
#ifndef EQUIAFFINE_BASE_INTERNAL_NAMED_PARAMETER_LIST_H
#define EQUIAFFINE_BASE_INTERNAL_NAMED_PARAMETER_LIST_H

/// Defines the function of a writable property map.
#define EQUIAFFINE_VERTEX_MAP(NAME, TAG, CONST, GIVEN)                                                                 \
  template <class Map>                                                                                                 \
  auto NAME(const Map& map) CONST {                                                                                    \
    return internal::add_parameter<internal::TAG>(map, GIVEN);                                                         \
  }

/// Defines one function per named parameter. A free function begins a chain of parameters, a member continues one:
/// `GIVEN` is the chain before, and `CONST` is `const` for members and nothing for free functions.
#define EQUIAFFINE_NAMED_PARAMETERS(CONST, GIVEN)                                                                      \
  /** Nodes per axis. */                                                                                               \
  inline auto number_of_nodes(const std::array<std::size_t, 3>& n) CONST {                                             \
    return internal::add_parameter<internal::Number_of_nodes_tag>(n, GIVEN);                                           \
  }                                                                                                                    \
  /** The same number of nodes along each axis. */                                                                     \
  template <class Number>                                                                                              \
  auto number_of_nodes(Number number) CONST {                                                                          \
    const auto n = internal::count_of<std::size_t>(number);                                                            \
    return number_of_nodes(std::array<std::size_t, 3>{n, n, n});                                                       \
  }                                                                                                                    \
                                                                                                                       \
  /** A Vertex_position. */                                                                                            \
  template <class Position>                                                                                            \
  auto vertex_position(Position position) CONST {                                                                      \
    return internal::add_parameter<internal::Vertex_position_tag>(position, GIVEN);                                    \
  }                                                                                                                    \
                                                                                                                       \
  /** The sampler asks the function for bounds, and evaluates it near its zero set only. */                            \
  inline auto skip_empty_space() CONST {                                                                               \
    return internal::add_parameter<internal::Skip_empty_space_tag>(std::true_type(), GIVEN);                           \
  }                                                                                                                    \
                                                                                                                       \
  /** How many planes of nodes a slab has. */                                                                          \
  template <class Number>                                                                                              \
  auto planes_per_slab(Number n) CONST {                                                                               \
    return internal::add_parameter<internal::Planes_per_slab_tag>(internal::count_of<std::size_t>(n), GIVEN);          \
  }                                                                                                                    \
                                                                                                                       \
  /** A Cell_block, whose part of the mesh is wanted. */                                                               \
  template <class Block>                                                                                               \
  auto cell_block(const Block& cells) CONST {                                                                          \
    return internal::add_parameter<internal::Cell_block_tag>(cells, GIVEN);                                            \
  }                                                                                                                    \
                                                                                                                       \
  /** A Cell_block where the function is known. */                                                                     \
  template <class Block>                                                                                               \
  auto known_cells(const Block& cells) CONST {                                                                         \
    return internal::add_parameter<internal::Known_cells_tag>(cells, GIVEN);                                           \
  }                                                                                                                    \
                                                                                                                       \
  /** The Clip_domain_3 where the surface is looked for. */                                                            \
  template <class Domain>                                                                                              \
  auto clip(const Domain& domain) CONST {                                                                              \
    return internal::add_parameter<internal::Clip_tag>(domain, GIVEN);                                                 \
  }                                                                                                                    \
                                                                                                                       \
  /** A range of Polyline_3 on the surface that the edges of the mesh follow. */                                       \
  template <class Polylines>                                                                                           \
  auto feature_curves(const Polylines& curves) CONST {                                                                 \
    return internal::add_parameter<internal::Feature_curves_tag>(curves, GIVEN);                                       \
  }                                                                                                                    \
                                                                                                                       \
  /** The edges of the mesh follow the parabolic curves. */                                                            \
  inline auto parabolic_features() CONST {                                                                             \
    return internal::add_parameter<internal::Parabolic_features_tag>(std::true_type(), GIVEN);                         \
  }                                                                                                                    \
                                                                                                                       \
  /** A Facet_sizing. */                                                                                               \
  template <class Sizing>                                                                                              \
  auto facet_sizing(Sizing sizing) CONST {                                                                             \
    return internal::add_parameter<internal::Facet_sizing_tag>(sizing, GIVEN);                                         \
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
  /** A property map from the elements of a range to the normals of the surface there. */                              \
  template <class Map>                                                                                                 \
  auto normal_map(const Map& map) CONST {                                                                              \
    return internal::add_parameter<internal::Normal_tag>(map, GIVEN);                                                  \
  }                                                                                                                    \
                                                                                                                       \
  /** A Normal_orientation: whether the given normals all point to the same side. */                                   \
  template <class Orientation>                                                                                         \
  auto normal_orientation(Orientation orientation) CONST {                                                             \
    return internal::add_parameter<internal::Normal_orientation_tag>(orientation, GIVEN);                              \
  }                                                                                                                    \
                                                                                                                       \
  /** The standard deviation of points from the surface, a length; without a value it is estimated. */                 \
  inline auto noise(std::optional<double> deviation) CONST {                                                           \
    return internal::add_parameter<internal::Noise_tag>(deviation, GIVEN);                                             \
  }                                                                                                                    \
                                                                                                                       \
  /** The scale of curvatures, a length; 0 for the surface's own curvature, without a value the data choose. */        \
  inline auto scale(std::optional<double> radius) CONST {                                                              \
    return internal::add_parameter<internal::Scale_tag>(radius, GIVEN);                                                \
  }                                                                                                                    \
                                                                                                                       \
  /** The degree of polynomials that are fitted: 4, 5, 6, 8 or 10; without a value the data choose. */                 \
  inline auto degree(std::optional<int> n) CONST { return internal::add_parameter<internal::Degree_tag>(n, GIVEN); }   \
                                                                                                                       \
  /** An Orientation_of_level_set: whether normals are those of the data or the opposite ones. */                      \
  template <class Orientation>                                                                                         \
  auto orientation(Orientation side) CONST {                                                                           \
    return internal::add_parameter<internal::Orientation_tag>(side, GIVEN);                                            \
  }                                                                                                                    \
                                                                                                                       \
  /** A Map_kind: among which maps one is sought. */                                                                   \
  template <class Kind>                                                                                                \
  auto map_kind(Kind kind) CONST {                                                                                     \
    return internal::add_parameter<internal::Map_kind_tag>(kind, GIVEN);                                               \
  }                                                                                                                    \
                                                                                                                       \
  /** Whether maps with a negative determinant are allowed. */                                                         \
  inline auto reflections(bool are_allowed) CONST {                                                                    \
    return internal::add_parameter<internal::Reflections_tag>(are_allowed, GIVEN);                                     \
  }                                                                                                                    \
                                                                                                                       \
  /** How many maps are sought, at most. */                                                                            \
  template <class Number>                                                                                              \
  auto number_of_maps(Number n) CONST {                                                                                \
    return internal::add_parameter<internal::Number_of_maps_tag>(internal::count_of<std::size_t>(n), GIVEN);           \
  }                                                                                                                    \
                                                                                                                       \
  /** The part of the points of one of two surfaces, at least, that has to lie on the other. */                        \
  inline auto least_overlap(double part) CONST {                                                                       \
    return internal::add_parameter<internal::Least_overlap_tag>(part, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** A pair of functions, of the source and of the target, on which maps are refined and judged. */                   \
  template <class Functions>                                                                                           \
  auto refined_functions(const Functions& source_and_target) CONST {                                                   \
    return internal::add_parameter<internal::Refined_functions_tag>(source_and_target, GIVEN);                         \
  }                                                                                                                    \
                                                                                                                       \
  /** How far a map may move points from a surface, a part of its size. */                                             \
  inline auto tolerance(double part) CONST { return internal::add_parameter<internal::Tolerance_tag>(part, GIVEN); }   \
                                                                                                                       \
  /** Whether all rotations are searched even where affine frames of a few points decide. */                           \
  inline auto complete(bool is_wanted) CONST {                                                                         \
    return internal::add_parameter<internal::Complete_tag>(is_wanted, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** The length of the edges of a remesh; without a value it is the mean one of those given. */                       \
  inline auto target_edge_length(std::optional<double> length) CONST {                                                 \
    return internal::add_parameter<internal::Target_edge_length_tag>(length, GIVEN);                                   \
  }                                                                                                                    \
                                                                                                                       \
  /** How often edges are split, collapsed and flipped and vertices relaxed. */                                        \
  template <class Number>                                                                                              \
  auto number_of_iterations(Number n) CONST {                                                                          \
    return internal::add_parameter<internal::Number_of_iterations_tag>(internal::count_of<unsigned>(n), GIVEN);        \
  }                                                                                                                    \
                                                                                                                       \
  /** A writable property map from the edges of a mesh to bool: the edges that a remesh keeps. */                      \
  template <class Map>                                                                                                 \
  auto edge_is_constrained_map(const Map& map) CONST {                                                                 \
    return internal::add_parameter<internal::Edge_is_constrained_tag>(map, GIVEN);                                     \
  }                                                                                                                    \
                                                                                                                       \
  /** The angle of creases between the normals of two faces, in degrees; without a value there are none. */            \
  inline auto feature_angle(std::optional<double> degrees) CONST {                                                     \
    return internal::add_parameter<internal::Feature_angle_tag>(degrees, GIVEN);                                       \
  }                                                                                                                    \
                                                                                                                       \
  /** A writable property map from the vertices of a mesh to Fit_outcome. */                                           \
  template <class Map>                                                                                                 \
  auto vertex_outcome_map(const Map& map) CONST {                                                                      \
    return internal::add_parameter<internal::Vertex_outcome_tag>(map, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** A property map from the vertices of a mesh to normals there, which fits read. */                                 \
  template <class Map>                                                                                                 \
  auto vertex_normal_map(const Map& map) CONST {                                                                       \
    return internal::add_parameter<internal::Vertex_normal_tag>(map, GIVEN);                                           \
  }                                                                                                                    \
                                                                                                                       \
  /** Another name of `scale`, as CGAL calls it, where 0 or less asks for the surface's own curvature. */              \
  inline auto ball_radius(double radius) CONST {                                                                       \
    return internal::add_parameter<internal::Ball_radius_tag>(radius, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** A kernel; nothing depends on it, since coordinates are doubles. */                                               \
  template <class Traits>                                                                                              \
  auto geom_traits(const Traits& traits) CONST {                                                                       \
    return internal::add_parameter<internal::Geom_traits_tag>(traits, GIVEN);                                          \
  }                                                                                                                    \
                                                                                                                       \
  /** Lines of text, a range of std::string, that a file keeps beside the numbers. */                                  \
  template <class Lines>                                                                                               \
  auto comments(const Lines& lines) CONST {                                                                            \
    return internal::add_parameter<internal::Comments_tag>(lines, GIVEN);                                              \
  }                                                                                                                    \
                                                                                                                       \
  /** Whether to print; this library never does. */                                                                    \
  inline auto verbose(bool is_wanted) CONST {                                                                          \
    return internal::add_parameter<internal::Verbose_tag>(is_wanted, GIVEN);                                           \
  }                                                                                                                    \
                                                                                                                       \
  /** Property map of Point_status, which is read, too: a vertex that is UNCONVERGED stays so. */                      \
  EQUIAFFINE_VERTEX_MAP(vertex_status_map, Vertex_status_tag, CONST, GIVEN)                                            \
  /** Writable property map of the Local_structure_3, or with fits the Fitted_structure_3. */                          \
  EQUIAFFINE_VERTEX_MAP(vertex_structure_map, Vertex_structure_tag, CONST, GIVEN)                                      \
  /** Writable property map of the unit normal n; `vertex_normal_map` is read. */                                      \
  EQUIAFFINE_VERTEX_MAP(vertex_unit_normal_map, Vertex_unit_normal_tag, CONST, GIVEN)                                  \
  /** Writable property map of the Euclidean mean curvature with the sign of CGAL: -H_e. */                            \
  EQUIAFFINE_VERTEX_MAP(vertex_mean_curvature_map, Vertex_mean_curvature_tag, CONST, GIVEN)                            \
  /** Writable property map of the Euclidean Gaussian curvature K_e. */                                                \
  EQUIAFFINE_VERTEX_MAP(vertex_Gaussian_curvature_map, Vertex_Gaussian_curvature_tag, CONST, GIVEN)                    \
  /** Writable property map of CGAL's Principal_curvatures_and_directions, with the sign of CGAL. */                   \
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
  /** Writable property map of the affine metric, a std::array of xx xy xz yy yz zz. */                                \
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
