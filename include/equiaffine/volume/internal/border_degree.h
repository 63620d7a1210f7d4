// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BORDER_DEGREE_H
#define EQUIAFFINE_VOLUME_INTERNAL_BORDER_DEGREE_H

#include <equiaffine/Volume_view_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Spline_scheme.h>
#include <equiaffine/volume/Volume_parts_3.h>
#include <equiaffine/volume/internal/Line_part.h>
#include <equiaffine/volume/internal/bspline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// How far the polynomial of degree d through f_1 .. f_{d+1} is from f_0: the magnitude of the difference of order d + 1.
template <class FT>
FT error_of_prediction(std::span<const FT> f, int d) {
  FT sum = 0, binomial = 1; // exact: small integers
  for (int j = 0; j <= d + 1; ++j) {
    sum += (j % 2 ? -binomial : binomial) * f[std::size_t(j)];
    binomial = binomial * FT(d + 1 - j) / FT(j + 1);
  }
  return std::abs(sum);
}

/// The vote of the end of a line that has the samples f from its end on: 1 if the greater degree predicts the sample
/// there better than the lesser one, else -1; 0 if the lesser one predicts it up to the rounding of the samples it takes,
/// or if one of them is NaN.
template <class FT>
int vote_for_greater_degree(std::span<const FT> f, int lesser, int greater) {
  const FT of_lesser = error_of_prediction(f, lesser);
  const FT of_greater = error_of_prediction(f, greater);
  FT largest = 0; // the last sample alone may be nearly 0
  for (int j = 0; j <= lesser + 1; ++j) largest = std::max(largest, std::abs(f[std::size_t(j)]));
  if (!(of_lesser > 1000 * std::numeric_limits<FT>::epsilon() * largest)) return 0;
  return of_greater < of_lesser ? 1 : -1;
}

/// The degree of a spline. \throw std::invalid_argument unless it is 5, 7 or 9
inline int checked_degree(int degree) {
  check_argument(degree == 5 || degree == 7 || degree == 9,
                 "the degree of a spline is not 5, 7 or 9: choose one of these");
  return degree;
}

/// The greater degree that the polynomials may have that extend a volume beyond the border for a spline of degree n.
inline int greater_border_degree(int degree) { return std::min(degree + 2, greatest_border_degree); }

/// The sum of the votes of the ends of lines that belong to a block of cells. Time: proportional to the number of samples
/// in the n + 4 layers at the border.
template <class Kernel>
std::ptrdiff_t border_votes(const Volume_view_3<Kernel>& volume, int degree, Spline_scheme scheme,
                            const Cell_block& cells) {
  using FT = typename Kernel::FT;
  const int greater = greater_border_degree(checked_degree(degree));
  if (scheme != Spline_scheme::QUASI_INTERPOLATION || greater == degree) return 0;
  const std::array<std::size_t, 3>& size = volume.lattice().size();
  std::array<FT, std::size_t(greatest_border_degree) + 2> samples;
  const std::span f = std::span(samples).first(std::size_t(greater) + 2);
  std::ptrdiff_t votes = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (size[a] < f.size()) continue;
    const std::size_t b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2; // in the order of the memory where i is fastest
    const Line_part of_a = own_nodes_of(cells, a, size[a]), of_b = own_nodes_of(cells, b, size[b]),
                    of_c = own_nodes_of(cells, c, size[c]);
    std::array<std::size_t, 3> node;
    for (node[c] = of_c.first; node[c] < of_c.end; ++node[c])
      for (node[b] = of_b.first; node[b] < of_b.end; ++node[b]) {
        if (of_a.first == 0) {
          node[a] = 0;
          volume.copy_line(node, a, f);
          votes += vote_for_greater_degree<FT>(f, degree, greater);
        }
        if (of_a.end == size[a]) {
          node[a] = size[a] - 1;
          volume.copy_line_backwards(node, a, f);
          votes += vote_for_greater_degree<FT>(f, degree, greater);
        }
      }
  }
  return votes;
}

/// The degree of the polynomials that extend a volume beyond the border for a spline of degree n (see Line_filter): n +
/// 2, at most 9, if that degree predicts the sample at most ends of lines from its neighbors better than degree n does;
/// else n. Degree n wins for noise and for edges in a scan, which the greater degree would magnify.
inline int elected_border_degree(std::ptrdiff_t votes, int degree) {
  return votes > 0 ? greater_border_degree(degree) : degree;
}

/// The border degree of a volume in parts.
template <class Kernel>
int border_degree(const Volume_parts_3<Kernel>& volume, int degree, Spline_scheme scheme) {
  double votes = 0;
  for (const auto& [part, cells] : volume.parts) votes += double(border_votes(part, degree, scheme, cells));
  const std::vector<double> gathered = volume.gather({votes});
  return elected_border_degree(std::ptrdiff_t(std::accumulate(gathered.begin(), gathered.end(), 0.0)), degree);
}

} // namespace equiaffine::internal

#endif
