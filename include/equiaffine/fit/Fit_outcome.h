// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_FIT_OUTCOME_H
#define EQUIAFFINE_FIT_FIT_OUTCOME_H

#include <array>
#include <cstddef>
#include <string_view>

namespace equiaffine {

/// Whether a vertex was moved onto the zero set of a fit, and if not, why.
enum class Fit_outcome : unsigned char {
  ON_FIT,     ///< the vertex lies on the zero set
  NO_VALUE,   ///< the fit has no derivatives near the vertex
  NO_ZERO,    ///< there is no zero close enough
  OTHER_SIDE, ///< the normals of fit and mesh disagree: the zero belongs to another sheet, or to none
  TORN_AWAY,  ///< the zero is on a different sheet than those of neighbors, or off the feature of a neighbor
  TURNED,     ///< a triangle would flip
  CROSSING,   ///< a triangle would intersect another one
  ON_FEATURE  ///< the vertex is on a sharp edge that is kept, which the fit would round off
};

inline constexpr std::size_t number_of_fit_outcomes = 8; ///< number of enumerators

/// The names of the outcomes, in the order of the enumeration.
inline constexpr std::array<std::string_view, number_of_fit_outcomes> fit_outcome_names = {
    "on_fit", "no_value", "no_zero", "other_side", "torn_away", "turned", "crossing", "on_feature"};

/// Report of move_to_fit(): the number of vertices with each outcome.
struct Fit_move_report {
  std::array<std::size_t, number_of_fit_outcomes> number_of = {}; ///< number of vertices for each Fit_outcome
  double largest_move = 0;                                        ///< largest distance of a vertex from its old position
  std::size_t crossings = 0; ///< pairs of intersecting triangles; all of them intersected before the move

  /// Returns the number of vertices of the mesh.
  std::size_t number_of_vertices() const {
    std::size_t sum = 0;
    for (const std::size_t n : number_of) sum += n;
    return sum;
  }
  /// Returns the number of vertices on the zero set.
  std::size_t number_on_fit() const { return number_of[std::size_t(Fit_outcome::ON_FIT)]; }
};

/// Report of remesh_on_fit(). Distances are maxima over vertices and triangle centers; they are infinite if a mesh
/// has no triangle with an area.
struct Fit_remesh_report : Fit_move_report {
  double edge_length = 0;        ///< target length of the edges; 0 if the given triangles were kept
  double distance_from_data = 0; ///< from the remesh to the given mesh
  double distance_of_data = 0;   ///< from the given mesh to the remesh
};

} // namespace equiaffine

#endif
