// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REQUESTS_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REQUESTS_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/Map_kind.h>

#include <cstddef>
#include <optional>

namespace equiaffine::internal {

/// How many pairs are made, and of what points: of the `neighbors` nearest in invariants, the `best` of each point.
struct Candidate_limits {
  std::size_t neighbors, best;
  double greatest_mismatch; ///< of gradients, whose mismatch is 1 at most
};

/// The greatest condition of the linear part of a map between surfaces. With it, the rounding of coordinates to 1e-16 makes
/// errors of 1e-12, as large as those that maps between formulas have anyway.
inline constexpr double greatest_condition = 1e4;

/// The thresholds of the search for maps by affine frames. `benchmark_registration 84 thresholds` shows what most of them
/// are good for, with one of them halved or doubled at a time.
struct Frame_thresholds {
  // The points of the source with the greatest weights are tried first: certainty * min(quality, greatest_quality) *
  // (least_rarity + rarity) * exp(-loss_by_disagreement * disagreement) / (1 + loss_by_condition * condition) * slope.
  double greatest_quality = 0.15;
  double least_rarity = 0.05;
  double loss_by_disagreement = 3;
  double loss_by_condition = 0.002;

  // A pair costs mismatch + cost_of_rest * rest + cost_of_step * step. The step, in spacings, leads along the target to
  // where the invariants agree best, and the rest is how much they still differ there.
  double cost_of_rest = 0.3;
  double cost_of_step = 0.1;
  double longest_step = 3; ///< in spacings
  Candidate_limits usual = {24, 3, 0.6};
  Candidate_limits wrong_structure = {48, 8, 0.9}; ///< where no map was found by the usual ones

  // A counterpart costs residual / accidental_residual + mismatch / accidental_mismatch.
  double accidental_residual = 0.1;
  double accidental_mismatch = 0.3;
  double longest_way = 6; ///< from the candidate, in spacings

  // The order and the end of the search.
  std::size_t most_points_to_try = 512, points_per_batch = 32, pairs_at_once = 8, most_hypotheses = 2000;
  /// So many hypotheses more are tried after a map that moves only a part of the source to within the noise: the surface
  /// may be nearly symmetric, and another map fit better.
  std::size_t more_hypotheses = 60;

  // A hypothesis has to reach these logarithms of the chance that it is an accident.
  std::size_t probes_at_first = 150; ///< by which a hypothesis is judged before it is refined
  double greatest_first_tolerance = 0.03;
  double first_log10 = -1.5;  ///< hypotheses that are no better are not refined
  double second_log10 = -4;   ///< those that are no better after a few steps are given up
  double accepted_log10 = -6; ///< a map that is better is no accident

  /// The tolerance of surfaces without noise is that of splines through samples. Smooth surfaces that have nothing in
  /// common can be moved onto each other to within 1e-2 of their size, and large parts of them to within 1e-3 or less.
  double exact_tolerance = 1e-5, greatest_tolerance = 3e-3, rounding = 1e-8;
};

/// The named parameters of every search for maps.
struct Map_request {
  Map_kind kind = Map_kind::AFFINE;
  bool allows_reflections = true;
  std::optional<double> tolerance = {}; ///< a part of a size; if there is none, the data tell
};

template <class Parameters, class... OtherTags>
constexpr void check_map_parameters() {
  check_parameters<Parameters, Map_kind_tag, Reflections_tag, Tolerance_tag, Geom_traits_tag, Verbose_tag,
                   OtherTags...>();
}

template <class Parameters>
Map_request map_request(const Parameters& parameters) {
  Map_request request;
  request.kind = get_parameter<Map_kind_tag>(parameters, request.kind);
  request.allows_reflections = get_parameter<Reflections_tag>(parameters, request.allows_reflections);
  if constexpr (has_parameter<Tolerance_tag, Parameters>)
    request.tolerance = given_parameter<Tolerance_tag>(parameters);
  check_argument(!request.tolerance || (*request.tolerance > 0 && *request.tolerance < 0.1),
                 "the tolerance of maps is a part of a size, from 0 to 0.1");
  return request;
}

/// The named parameters of register_surfaces, and thresholds that benchmarks vary. The tolerance is beside the size of
/// the target.
struct Registration_request : Map_request {
  std::size_t number_of_maps = 1;
  double least_overlap = 0.05;
  Frame_thresholds thresholds = {};
};

template <class Parameters, class... OtherTags>
constexpr void check_registration_parameters() {
  check_map_parameters<Parameters, Number_of_maps_tag, Least_overlap_tag, OtherTags...>();
}

template <class Parameters>
Registration_request registration_request(const Parameters& parameters) {
  Registration_request request = {map_request(parameters)};
  request.number_of_maps = get_parameter<Number_of_maps_tag>(parameters, request.number_of_maps);
  request.least_overlap = get_parameter<Least_overlap_tag>(parameters, request.least_overlap);
  check_argument(request.number_of_maps > 0, "the number of maps to find is at least 1");
  check_argument(request.least_overlap >= 0 && request.least_overlap <= 1,
                 "the least overlap is a part of a surface, from 0 to 1");
  return request;
}

/// The default tolerance of symmetries of a function, a part of its size.
constexpr double default_tolerance = 1e-8;

/// The named parameters of affine_symmetries() of a function.
struct Symmetry_request : Map_request {
  bool is_complete = false; ///< whether all rotations are searched where frames have decided, too
};

template <class Parameters>
Symmetry_request symmetry_request(const Parameters& parameters) {
  return {map_request(parameters), get_parameter<Complete_tag>(parameters, false)};
}

} // namespace equiaffine::internal

#endif
