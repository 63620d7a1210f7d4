// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of all samples of a volume that a spline depends on: their maximum magnitude, their type, and the degree
// of the polynomials that extend them beyond the border.
#ifndef EQUIAFFINE_VOLUME_VOLUME_SURVEY_H
#define EQUIAFFINE_VOLUME_VOLUME_SURVEY_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>
#include <equiaffine/volume/internal/bspline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace equiaffine {

/// The number of ends of lines that vote for each degree of the polynomials that extend the samples beyond the
/// border.
struct Border_votes {
  std::int64_t constant = 0; ///< for degree 0: the samples are steps
  std::int64_t lesser = 0;   ///< for the degree of the spline
  std::int64_t greater = 0;  ///< for a greater degree

  /// Adds the votes of another part.
  void add(const Border_votes& other) {
    constant += other.constant;
    lesser += other.lesser;
    greater += other.greater;
  }
};

/// Properties of all samples of a volume that a spline depends on. The surveys of the parts of a volume, added in any
/// order, give that of the whole volume, bit for bit.
struct Volume_survey {
  double greatest = 0;            ///< the maximum magnitude of the finite samples
  bool are_floats = true;         ///< whether all samples are representable as float
  Border_votes border_votes = {}; ///< the votes of the ends of lines

  /// Adds the survey of another part.
  void add(const Volume_survey& other) {
    greatest = std::max(greatest, other.greatest);
    are_floats = are_floats && other.are_floats;
    border_votes.add(other.border_votes);
  }
};

/// The cells of a volume that belong to a part (Volume_view_3::part), and how its survey is combined with those of
/// the other parts, which may be in other processes.
struct Volume_part {
  Cell_block cells; ///< the cells that belong to this part and to no other
  /// Called once with the survey of these cells; replaces it by that of all parts, for example by MPI reductions.
  std::function<void(Volume_survey&)> reduce = [](Volume_survey&) {};
};

} // namespace equiaffine

namespace equiaffine::internal {

/// How far the polynomial of degree d through f_1 .. f_{d+1} is from f_0: the magnitude of the difference of
/// order d + 1.
template <class FT>
FT error_of_prediction(std::span<const FT> f, int d) {
  FT sum = 0, binomial = 1; // small integers: exact
  for (int j = 0; j <= d + 1; ++j) {
    sum += (j % 2 ? -binomial : binomial) * f[std::size_t(j)];
    binomial = binomial * FT(d + 1 - j) / FT(j + 1);
  }
  return std::abs(sum);
}

/// Adds the vote of the end of a line with the samples f, counted from that end. It is for constants if most samples,
/// but not all, equal their neighbor: they are steps. Otherwise it is for the degree that predicts the first sample
/// better; a line that is too short for the greater degree votes for the lesser one. There is no vote if the lesser
/// degree predicts the sample up to rounding, or if a sample is NaN.
template <class FT>
void add_vote(std::span<const FT> f, int lesser, int greater, Border_votes& votes) {
  const FT of_lesser = error_of_prediction(f, lesser);
  const FT of_greater = f.size() < std::size_t(greater) + 2 ? of_lesser : error_of_prediction(f, greater);
  FT largest = 0; // over all samples, because the first one may be nearly 0
  std::size_t equals = 0;
  for (std::size_t j = 0; j <= std::size_t(lesser) + 1; ++j) {
    largest = std::max(largest, std::abs(f[j]));
    equals += j > 0 && f[j] == f[j - 1];
  }
  if (!(of_lesser > 1000 * std::numeric_limits<FT>::epsilon() * largest)) return;
  if (2 * equals > std::size_t(lesser) + 1) ++votes.constant;
  else if (of_greater < of_lesser) ++votes.greater;
  else ++votes.lesser;
}

/// For a spline of degree n, the greater of the two degrees of polynomials that may extend a volume beyond the
/// border.
inline int greater_border_degree(int degree) { return std::min(degree + 2, greatest_border_degree); }

/// The votes of the ends of lines that belong to a block of cells, where all samples for a vote are known. The time
/// is proportional to the number of samples in the n + 4 layers at the border. \throw Input_error for bad options
/// \pre the samples of the block are known
template <class Kernel>
Border_votes border_votes(const Volume_view_3<Kernel>& volume, const Volume_options& options, const Cell_block& cells) {
  using FT = typename Kernel::FT;
  options.check();
  const int degree = options.spline_degree, greater = greater_border_degree(degree);
  Border_votes votes;
  if (options.spline_scheme != Spline_scheme::QUASI_INTERPOLATION) return votes;
  const std::array<std::size_t, 3>& size = volume.lattice().size();
  std::array<FT, std::size_t(greatest_border_degree) + 2> samples;
  for (std::size_t a = 0; a < 3; ++a) {
    if (size[a] < std::size_t(degree) + 2) continue;
    const std::span f = std::span(samples).first(std::min(size[a], std::size_t(greater) + 2));
    const std::size_t b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2; // in memory order if i is fastest
    const Line_part of_a = own_nodes_of(cells, a, size[a]), of_b = own_nodes_of(cells, b, size[b]),
                    of_c = own_nodes_of(cells, c, size[c]), known = nodes_of(volume.cells(), a);
    const bool has_first = of_a.first == 0 && f.size() <= known.end;
    const bool has_last = of_a.end == size[a] && known.first + f.size() <= size[a];
    std::array<std::size_t, 3> node;
    for (node[c] = of_c.first; node[c] < of_c.end; ++node[c])
      for (node[b] = of_b.first; node[b] < of_b.end; ++node[b]) {
        if (has_first) {
          node[a] = 0;
          volume.copy_line(node, a, f);
          add_vote<FT>(f, degree, greater, votes);
        }
        if (has_last) {
          node[a] = size[a] - 1;
          volume.copy_line_backwards(node, a, f);
          add_vote<FT>(f, degree, greater, votes);
        }
      }
  }
  return votes;
}

/// For a spline of degree n, the degree with the most votes for the polynomials that extend a volume beyond the
/// border (see Line_filter). Steps, for example of a mask, are extended by constants: polynomials through them would
/// rise beyond the border and move a surface that is a few samples away. Noise and edges in a scan vote for degree n,
/// because degree n + 2 would magnify them.
inline int elected_border_degree(const Border_votes& votes, int degree) {
  if (votes.constant > std::max(votes.lesser, votes.greater)) return 0;
  return votes.greater > votes.lesser ? greater_border_degree(degree) : degree;
}

/// The border degree of a volume in parts.
template <class Kernel>
int border_degree(const Volume_parts_3<Kernel>& volume, int degree, Spline_scheme scheme) {
  Border_votes votes;
  for (const auto& [part, cells] : volume.parts)
    votes.add(border_votes(part, {.spline_scheme = scheme, .spline_degree = degree}, cells));
  const std::vector<double> gathered =
      volume.gather({double(votes.constant), double(votes.lesser), double(votes.greater)});
  Border_votes of_all;
  for (std::size_t n = 0; n < gathered.size(); n += 3)
    of_all.add({std::int64_t(gathered[n]), std::int64_t(gathered[n + 1]), std::int64_t(gathered[n + 2])});
  return elected_border_degree(of_all, degree);
}

/// The survey of the unsmoothed samples that belong to a block of cells, for a spline with the degree and scheme of
/// the options. \throw std::invalid_argument unless the samples of these cells are known
template <class ConcurrencyTag, class Kernel>
Volume_survey volume_survey(const Volume_view_3<Kernel>& volume, const Volume_options& options,
                            const Cell_block& cells) {
  using FT = typename Kernel::FT;
  check_argument(clamped(cells, volume.cells()) == cells,
                 "some samples of a part of a volume are unknown: provide all samples at the nodes of its cells");
  constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once;
  const auto& size = volume.lattice().size();
  const auto own = [&](std::size_t a) { return own_nodes_of(cells, a, size[a]); };
  const Line_part i = own(0), j = own(1), k = own(2);
  std::vector<Volume_survey> of_planes((k.size() + planes_at_once - 1) / planes_at_once);
  parallel_for<ConcurrencyTag>(0, of_planes.size(), [&](std::size_t n) {
    const std::size_t first = k.first + n * planes_at_once, planes = std::min(planes_at_once, k.end - first);
    std::vector<FT> samples(i.size() * planes);
    Volume_survey survey;
    for (std::size_t row = j.first; row < j.end; ++row) {
      volume.copy_block({i.first, row, first}, {i.size(), 1, planes}, samples);
      for (const FT& x : samples) {
        if (!std::isfinite(x)) continue;
        survey.greatest = std::max(survey.greatest, double(std::abs(x)));
        survey.are_floats = survey.are_floats && x == FT(float(x));
      }
    }
    of_planes[n] = survey;
  });
  Volume_survey survey;
  for (const Volume_survey& of_some : of_planes) survey.add(of_some);
  survey.border_votes = border_votes(volume, options, cells);
  return survey;
}

} // namespace equiaffine::internal

#endif
