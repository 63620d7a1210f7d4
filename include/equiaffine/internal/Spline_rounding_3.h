// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_SPLINE_ROUNDING_3_H
#define EQUIAFFINE_INTERNAL_SPLINE_ROUNDING_3_H

#include <equiaffine/Spline_function_3.h>
#include <equiaffine/internal/bspline_functionals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// An estimate from above of the errors of a spline's second derivatives that come from rounding: two roundings of
/// every term, as if all samples were of the size of the largest.
template <class Kernel>
class Spline_rounding_3 {
public:
  using FT = typename Kernel::FT;
  using Spline = Spline_function_3<Kernel>;

  Spline_rounding_3(const Volume_3<Kernel>& volume, const Spline& spline) : to_lattice_(spline.to_lattice()) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t nodes = volume.lattice.size()[a];
      if (nodes <= std::size_t(spline.degree())) return;
      const Line_functionals<FT> line(nodes, {spline.degree(), spline.scheme()});
      gains_[a] = {line.kinds(), [&](std::size_t kind) {
                     return Gains{line.gain(kind, 0), line.gain(kind, 1), 2 * line.gain(kind, 2)}; // times d!
                   }};
    }
    for (const FT& x : volume.values)
      if (std::isfinite(x)) greatest_sample_ = std::max(greatest_sample_, std::abs(x));
  }

  FT operator()(const std::array<std::size_t, 3>& cell) const {
    FT greatest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        FT sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            FT product = std::abs(to_lattice_[a][i] * to_lattice_[b][j]);
            for (std::size_t c = 0; c < 3; ++c)
              product *= gains_[c][cell[c]][std::size_t(a == c) + std::size_t(b == c)];
            sum += product;
          }
        greatest = std::max(greatest, sum);
      }
    return 2 * std::numeric_limits<FT>::epsilon() * greatest_sample_ * greatest;
  }

private:
  /// How much rounding of samples of size 1 can change the value and the first two derivatives along one axis.
  using Gains = std::array<FT, 3>;

  typename Spline::Matrix to_lattice_;
  std::array<Per_kind_of_cell<Gains>, 3> gains_;
  FT greatest_sample_ = 0;
};

} // namespace equiaffine::internal

#endif
