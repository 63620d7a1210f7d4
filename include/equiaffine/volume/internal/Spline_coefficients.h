// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_COEFFICIENTS_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_COEFFICIENTS_H

#include <equiaffine/base/internal/shared/large_pages.h>
#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_scheme.h>
#include <equiaffine/volume/internal/bspline.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/internal/bspline_interpolation.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// The coefficients of a tensor product spline, with padding on all sides so that every cell has its (n + 1)^3 of them.
template <class FT>
class Spline_coefficients {
public:
  using Size = std::array<std::size_t, 3>;

  /// No coefficients, for a lattice of `nodes`.
  Spline_coefficients(const Size& nodes, int degree) : degree_(degree) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = nodes[a] + 2 * std::size_t(spline_padding(degree));
  }

  /// Turns samples into coefficients, along x, then y, then z. Those that are not finite become NaN.
  template <class ConcurrencyTag>
  void fit(const std::vector<FT>& samples, const Size& nodes, Spline_scheme scheme, int border_degree) {
    resize_with_large_pages(values_, size_[0] * size_[1] * size_[2] + overread);
    with_degree(degree_, [&](auto n) {
      with_line_filter<FT, n>(scheme, border_degree, [&](const auto& line) {
        using Filter = std::decay_t<decltype(line)>;
        Separable_filter<ConcurrencyTag, FT, Filter>(nodes, Filter::padding, values_.data())({&line, &line, &line},
                                                                                             samples.data());
      });
    });
    const std::size_t slab = size_[0] * size_[1];
    parallel_for<ConcurrencyTag>(0, size_[2], [&](std::size_t k) {
      FT* const first = values_.data() + k * slab;
      for (FT* x = first; x != first + slab; ++x)
        if (!std::isfinite(*x)) *x = std::numeric_limits<FT>::quiet_NaN(); // an infinity could pass as a value
    });
  }

  const FT* data() const { return values_.data(); }
  const Size& size() const { return size_; }

  /// The expansion in lattice coordinates at a place of a cell.
  template <int Order>
  Jet_3<FT, Order> expansion(const Size& cell, const std::array<FT, 3>& offset) const {
    Jet_3<FT, Order> jet;
    const FT* first = &values_[(cell[2] * size_[1] + cell[1]) * size_[0] + cell[0]]; // padding shifts the lattice, too
    with_degree(degree_,
                [&](auto n) { contract<n, Order>(first, size_[0], size_[0] * size_[1], offset, jet.coefficients()); });
    return jet;
  }

  /// An expansion that is linear in each coordinate between the expansions at the corners of the cell.
  template <int Order>
  Jet_3<FT, Order> interpolated_expansion(const Size& cell, const std::array<FT, 3>& offset) const {
    Jet_3<FT, Order> sum(FT(0));
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::array<FT, 3> corner_offset;
      FT weight = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        corner_offset[a] = FT(corner >> a & 1);
        weight *= corner >> a & 1 ? offset[a] : 1 - offset[a];
      }
      const auto jet = expansion<Order>(cell, corner_offset);
      for (std::size_t n = 0; n < jet.size; ++n) sum.coefficients()[n] += weight * jet.coefficients()[n];
    }
    return sum;
  }

private:
  int degree_;
  Size size_; // padding included
  std::vector<FT> values_;
};

} // namespace equiaffine::internal

#endif
