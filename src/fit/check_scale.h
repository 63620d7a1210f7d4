// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_CHECK_SCALE_H
#define EQUIAFFINE_SRC_FIT_CHECK_SCALE_H

#include "fit/Fit_choices_3.h"
#include "fit/Normalization_3.h"
#include <equiaffine/base/internal/random_subset.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace equiaffine::internal {

/// The diagonal of the box of the points in their own coordinates.
inline double diagonal_of_data(const Normalized_data& normalized) {
  const Eigen::Matrix3d inverse = normalized.normalization.matrix.inverse();
  Eigen::AlignedBox3d box;
  for (const auto& p : normalized.data.points) box.extend(inverse * p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Whether at half of the sample centers the ball of the scale has the points that a polynomial needs.
inline bool has_enough_points(const Data_points_3& data, const std::vector<Data_points_3::Index>& centers,
                              const Fit_choices_3& choices) {
  const Way_to_fit& way = choices.at(Eigen::Vector3d::Zero())->way;
  const std::array degree = {way.degree};
  const auto enough = std::count_if(centers.begin(), centers.end(), [&](auto i) {
    return greatest_degree(way.family, degree, connected_ball(data, i, way.radius).size()) > 0;
  });
  return 2 * std::size_t(enough) >= centers.size();
}

/// Refuses a scale beyond a third of the size of the data, and one below what has enough points at most of them.
inline void check_scale(const Normalized_data& normalized, Fit_choices_3 choices) {
  const Data_points_3& data = normalized.data;
  const Way_to_fit way = choices.at(Eigen::Vector3d::Zero())->way;
  if (greatest_degree(way.family, std::array{way.degree}, data.size()) == 0) return; // nothing is known then
  const double unit = normalized.normalization.scale(), scale = *choices.scale() / unit;
  const double diagonal = diagonal_of_data(normalized);
  const double unit_of_third_digit = std::pow(10, std::floor(std::log10(diagonal)) - 3);
  const auto text = [](const auto&... words) {
    std::ostringstream stream;
    stream.precision(3);
    (stream << ... << words);
    return stream.str();
  };
  if (scale > diagonal / 3)
    throw std::invalid_argument(text("the scale ", scale, " is more than a third of the size ", diagonal,
                                     " of the data; give at most ",
                                     std::floor(diagonal / 3 / unit_of_third_digit) * unit_of_third_digit));
  constexpr std::size_t most_centers = 200;
  const auto centers = random_subset<Data_points_3::Index>(data.size(), std::min(data.size(), most_centers), 3);
  double least = scale;
  for (; !has_enough_points(data, centers, choices) && least < diagonal; least *= 1.1)
    choices.set_scale(1.1 * least * unit);
  if (least != scale && least < diagonal / 3)
    throw std::invalid_argument(text("within the scale ", scale, " most points have fewer others than a polynomial ",
                                     "needs; give at least ",
                                     std::ceil(least / unit_of_third_digit) * unit_of_third_digit));
}

} // namespace equiaffine::internal

#endif
