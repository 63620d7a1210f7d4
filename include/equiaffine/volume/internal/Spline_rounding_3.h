// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_ROUNDING_3_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_ROUNDING_3_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/Line_functionals.h>
#include <equiaffine/volume/internal/Line_part.h>
#include <equiaffine/volume/internal/border_degree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine {

/// The survey of the samples that belong to a block of cells, before they are smoothed. The spline has that degree and
/// scheme. \throw std::invalid_argument unless samples are known in all of these cells
template <class ConcurrencyTag, class Kernel>
Volume_survey volume_survey(const Volume_view_3<Kernel>& volume, const Spline_parameters& parameters,
                            const Cell_block& cells) {
  using FT = typename Kernel::FT;
  check_argument(
      clamped(cells, volume.cells()) == cells,
      "fewer samples of a volume are known than belong to a part of it: let more be known, see cells_to_know()");
  constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once;
  const auto& size = volume.lattice().size();
  const auto own = [&](std::size_t a) { return internal::own_nodes_of(cells, a, size[a]); };
  const internal::Line_part i = own(0), j = own(1), k = own(2);
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
  survey.border_votes = internal::border_votes(volume, parameters, cells);
  return survey;
}

/// Estimates from above how far rounding may change the second derivatives of a spline: two roundings of every term, as
/// if all samples were as large as the largest one, and one of the samples to float if all are floats. The latter, which
/// is the greater one by far, is that of samples as large as the coefficients of the cell unless they were smoothed.
template <class Kernel>
class Spline_rounding_3 {
public:
  using FT = typename Kernel::FT;
  using Spline = Spline_function_3<Kernel>;
  using Cell = std::array<std::size_t, 3>;

  /// `smoothing` is the scale by which the samples of the spline have been smoothed, `samples` says what they were
  /// before.
  Spline_rounding_3(const Spline& spline, const FT& smoothing, const Volume_survey& samples)
      : to_lattice_(spline.to_lattice()),
        rounding_of_terms_(2 * std::numeric_limits<FT>::epsilon() * FT(samples.greatest)),
        rounding_of_samples_(samples.are_floats ? FT(std::numeric_limits<float>::epsilon()) / 2 : FT(0)),
        greatest_sample_(FT(samples.greatest)), is_local_(samples.are_floats && !(smoothing > FT(0))) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t nodes = spline.lattice().size()[a];
      if (nodes <= std::size_t(spline.degree())) return;
      const internal::Line_functionals<FT> line(nodes,
                                                {spline.degree(), spline.scheme(), spline.border_degree(), smoothing});
      gains_[a] = {line.kinds(), [&](std::size_t kind) { return gains(line, kind); }};
    }
    inside_ = errors({gains_[0].inner_kind(), gains_[1].inner_kind(), gains_[2].inner_kind()});
  }

  /// The largest error of a second derivative in the coordinates of space, in the middle of a cell of the spline.
  FT operator()(const Spline& spline, const Cell& cell) const {
    Errors e = inside_;
    for (std::size_t a = 0; a < 3; ++a)
      if (gains_[a].kind(cell[a]) != gains_[a].inner_kind()) {
        e = errors(cell);
        break;
      }
    constexpr FT margin(2); // coefficients are less than the samples where these oscillate
    const FT greatest =
        is_local_ ? std::min(greatest_sample_, margin * spline.greatest_coefficient(cell)) : greatest_sample_;
    return e.terms + greatest * e.samples;
  }

private:
  /// The greatest errors of second derivatives by rounding of terms, and by that of samples of magnitude 1.
  struct Errors {
    FT terms, samples;
  };

  Errors errors(const Cell& cell) const {
    Errors greatest{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        Errors sum{};
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            const FT factor = std::abs(to_lattice_[a][i] * to_lattice_[b][j]);
            const Errors e = errors_in_lattice(a, b, cell);
            sum.terms += factor * e.terms;
            sum.samples += factor * e.samples;
          }
        greatest = {std::max(greatest.terms, sum.terms), std::max(greatest.samples, sum.samples)};
      }
    return greatest;
  }

  /// The greatest change of the value and of the first two derivatives along one axis by errors of magnitude 1, of all
  /// terms or of all samples.
  struct Gains {
    std::array<FT, 3> terms, samples;
  };

  /// The errors of the derivative along the axes a and b of the lattice.
  Errors errors_in_lattice(std::size_t a, std::size_t b, const Cell& cell) const {
    FT terms = rounding_of_terms_, samples = rounding_of_samples_;
    for (std::size_t c = 0; c < 3; ++c) {
      const Gains& gains = gains_[c][cell[c]];
      const std::size_t order = std::size_t(a == c) + std::size_t(b == c);
      terms *= gains.terms[order];
      samples *= gains.samples[order];
    }
    return {terms, samples};
  }

  static Gains gains(const internal::Line_functionals<FT>& line, std::size_t kind) {
    const auto rows = line.rows(kind);
    Gains gains{};
    for (std::size_t d = 0; d < 3; ++d) {
      const FT factorial = d == 2 ? FT(2) : FT(1);
      gains.terms[d] = factorial * line.gain(kind, d);
      for (const FT& x : rows[d]) gains.samples[d] += factorial * std::abs(x);
    }
    return gains;
  }

  typename Spline::Matrix to_lattice_;
  FT rounding_of_terms_;   // of the largest ones
  FT rounding_of_samples_; // of magnitude 1
  FT greatest_sample_;
  bool is_local_;
  std::array<internal::Per_kind_of_cell<Gains>, 3> gains_;
  Errors inside_{}; // in cells away from the borders
};

} // namespace equiaffine

#endif
