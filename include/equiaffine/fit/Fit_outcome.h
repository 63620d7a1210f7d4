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
  NO_VALUE,   ///< the fit has no derivatives beside the vertex
  NO_ZERO,    ///< there is no zero near enough
  OTHER_SIDE, ///< the fit is there, but faces another way than the mesh: it is that of another sheet, or of none
  TORN_AWAY,  ///< the zero is on another sheet than those of neighbors, or off the feature that a neighbor is on
  TURNED,     ///< a triangle would turn over
  CROSSING,   ///< a triangle would cross another one
  ON_FEATURE  ///< the vertex is on a sharp edge that is kept, which the fit makes round
};

inline constexpr std::size_t number_of_fit_outcomes = 8; ///< how many values the enumeration has

/// The names of the outcomes, in their order.
inline constexpr std::array<std::string_view, number_of_fit_outcomes> fit_outcome_names = {
    "on_fit", "no_value", "no_zero", "other_side", "torn_away", "turned", "crossing", "on_feature"};

/// The report of move_to_fit(): it counts the outcomes of the vertices of a mesh.
struct Fit_move_report {
  std::array<std::size_t, number_of_fit_outcomes> number_of = {}; ///< the number of vertices of each Fit_outcome
  double largest_move = 0;                                        ///< the distance between old and new positions
  std::size_t crossings = 0; ///< pairs of triangles that cross each other, all of which did so before the move

  /// The number of vertices of the mesh.
  std::size_t number_of_vertices() const {
    std::size_t sum = 0;
    for (const std::size_t n : number_of) sum += n;
    return sum;
  }
  /// The number of vertices on the zero set.
  std::size_t number_on_fit() const { return number_of[std::size_t(Fit_outcome::ON_FIT)]; }
};

/// The report of remesh_on_fit(). Distances are the greatest ones of vertices and of centers of triangles; infinity
/// from a mesh of triangles without area.
struct Fit_remesh_report : Fit_move_report {
  double edge_length = 0;        ///< the length of edges that was aimed at; 0 if the edges stayed what they were
  double distance_from_data = 0; ///< of the remesh from the mesh given
  double distance_of_data = 0;   ///< of the mesh given from the remesh
};

} // namespace equiaffine

#endif
