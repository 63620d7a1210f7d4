// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_VOLUME_SURVEY_H
#define EQUIAFFINE_VOLUME_VOLUME_SURVEY_H

#include <equiaffine/volume/Cell_block.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace equiaffine {

/// What a spline asks about all samples of a volume. The surveys of the parts of a volume, in any order, add up to that
/// of the whole one, bit for bit.
struct Volume_survey {
  double greatest = 0;           ///< the greatest magnitude of a sample that is finite
  bool are_floats = true;        ///< whether all samples are numbers of type float
  std::int64_t border_votes = 0; ///< at the ends of lines, more than 0 for the greater degree of extension

  /// Adds the survey of another part.
  void add(const Volume_survey& other) {
    greatest = std::max(greatest, other.greatest);
    are_floats = are_floats && other.are_floats;
    border_votes += other.border_votes;
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
