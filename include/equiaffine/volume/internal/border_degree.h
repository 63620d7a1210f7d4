// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BORDER_DEGREE_H
#define EQUIAFFINE_VOLUME_INTERNAL_BORDER_DEGREE_H

#include <equiaffine/volume/Spline_scheme.h>
#include <equiaffine/volume/internal/bspline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// What the polynomial of degree d through f_1 .. f_{d+1} errs at f_0: the difference of order d + 1.
template <class FT>
FT error_of_prediction(const FT* samples, std::ptrdiff_t stride, int d) {
  FT sum = 0, binomial = 1; // exact: small integers
  for (int j = 0; j <= d + 1; ++j) {
    sum += (j % 2 ? -binomial : binomial) * samples[j * stride];
    binomial = binomial * FT(d + 1 - j) / FT(j + 1);
  }
  return std::abs(sum);
}

/// The degree of the polynomials that extend size[0] x size[1] x size[2] samples beyond the border for a spline of
/// degree n (see Line_filter): the greater of the two where it predicts the ends of most lines better from the samples
/// next to them than the lesser one does. It does not for noise, nor for edges of a scan, and magnifies both more.
/// Lines that are polynomials up to rounding say nothing. Time: that of a border of n + 4 samples.
template <class FT>
int border_degree(const std::vector<FT>& samples, const std::array<std::size_t, 3>& size, int degree,
                  Spline_scheme scheme) {
  const int greater = std::min(degree + 2, greatest_border_degree);
  if (scheme != Spline_scheme::QUASI_INTERPOLATION || greater == degree) return degree;
  std::ptrdiff_t votes = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (size[a] < std::size_t(greater) + 2) continue;
    const std::array<std::size_t, 3> strides = {1, size[0], size[0] * size[1]};
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    const auto stride = std::ptrdiff_t(strides[a]);
    for (std::size_t k = 0; k < size[c]; ++k)
      for (std::size_t j = 0; j < size[b]; ++j) {
        const FT* const begin = samples.data() + k * strides[c] + j * strides[b];
        const FT* const last = begin + (size[a] - 1) * strides[a];
        for (const auto& [end, step] : {std::pair(begin, stride), std::pair(last, -stride)}) {
          const FT of_lesser = error_of_prediction(end, step, degree);
          const FT of_greater = error_of_prediction(end, step, greater);
          if (of_lesser > 1000 * std::numeric_limits<FT>::epsilon() * std::abs(*end))
            votes += of_greater < of_lesser ? 1 : -1;
        }
      }
  }
  return votes > 0 ? greater : degree;
}

} // namespace equiaffine::internal

#endif
