// SPDX-License-Identifier: GPL-3.0-or-later
// What a spline asks about all samples of a volume.
#ifndef EQUIAFFINE_VOLUME_VOLUME_SURVEY_H
#define EQUIAFFINE_VOLUME_VOLUME_SURVEY_H

#include <equiaffine/volume/Cell_block.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace equiaffine {

/// The numbers of ends of lines for each degree of the polynomials by which samples are extended beyond the border.
struct Border_votes {
  std::int64_t constant = 0; ///< for 0: samples are steps
  std::int64_t lesser = 0;   ///< for the degree of the spline
  std::int64_t greater = 0;  ///< for a greater one

  /// Adds the votes of another part.
  void add(const Border_votes& other) {
    constant += other.constant;
    lesser += other.lesser;
    greater += other.greater;
  }
};

/// What a spline asks about all samples of a volume. The surveys of the parts of a volume, in any order, add up to that
/// of the whole one, bit for bit.
struct Volume_survey {
  double greatest = 0;            ///< the greatest magnitude of a sample that is finite
  bool are_floats = true;         ///< whether all samples are numbers of type float
  Border_votes border_votes = {}; ///< of the ends of lines

  /// Adds the survey of another part.
  void add(const Volume_survey& other) {
    greatest = std::max(greatest, other.greatest);
    are_floats = are_floats && other.are_floats;
    border_votes.add(other.border_votes);
  }
};

/// Says of a volume of which only a part is known (Volume_view_3::part) what belongs to that part and how the others,
/// which may be on other machines, are asked.
struct Volume_part {
  Cell_block cells; ///< the cells that belong to this part and to no other
  /// Is called once with the survey of these cells, and makes that of all parts of it: with MPI, by reductions.
  std::function<void(Volume_survey&)> reduce = [](Volume_survey&) {};
};

} // namespace equiaffine

#endif
