// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_GRID_ROWS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_GRID_ROWS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// A selection of the rows of nodes along i of a grid. Different threads may add rows of different planes. A row may be
/// added more than once, and is kept once if no other row of its plane is added in between.
class Grid_rows {
public:
  explicit Grid_rows(std::size_t number_of_planes) : planes_(number_of_planes) {}

  void add(std::size_t j, std::size_t k) {
    auto& plane = planes_[k];
    if (plane.empty() || plane.back() != j) plane.push_back(j);
  }

  void add(const Grid_rows& other) {
    for (std::size_t k = 0; k < planes_.size(); ++k)
      planes_[k].insert(planes_[k].end(), other.planes_[k].begin(), other.planes_[k].end());
  }

  bool is_empty() const {
    return std::all_of(planes_.begin(), planes_.end(), [](const auto& plane) { return plane.empty(); });
  }

  /// Calls visit(j, k) for every row.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t k = 0; k < planes_.size(); ++k)
      for (const std::size_t j : planes_[k]) visit(j, k);
  }

private:
  std::vector<std::vector<std::size_t>> planes_; // the j of the rows in every plane
};

} // namespace equiaffine::internal

#endif
