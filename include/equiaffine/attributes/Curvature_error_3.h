// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_CURVATURE_ERROR_3_H
#define EQUIAFFINE_ATTRIBUTES_CURVATURE_ERROR_3_H

#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/volume/bspline_functionals.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine {

/// How far the affine curvatures of a spline may be from those of the function that was sampled.
template <class FT>
struct Affine_curvature_error {
  FT gaussian_curvature, mean_curvature;
};

/// Estimates, at points, the errors of the affine Gaussian and mean curvature of the spline through the samples of a
/// volume, smoothed or not: twice the sum of the standard deviation that white noise of the samples gives them, and of
/// the difference to the curvatures from a second scale. That is the scale 6/5 smoothing, where the error that
/// smoothing makes is 4.3 times as large, and degree 9 (for degree 9, 7), where that of the spline is of another order,
/// by quasi-interpolation instead of convolution.
///
/// The deviation follows from how the coefficients of the expansion depend on the samples: 35 independent disturbances
/// of the expansion, each as large as the noise makes it, go through the curvatures. An estimate does not know of what
/// both scales miss, such as details below a voxel. NaN where a curvature does not exist. Some 10 microseconds a point.
template <class Kernel>
class Curvature_error_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;

  /// `function` is that of the volume smoothed by the scale `smoothing`, `volume` as it was sampled. The deviation of
  /// the noise is in the unit of the samples, see Sample_noise.
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Curvature_error_3(const Sampled_function_traits_3<Kernel>& function, const Volume_3<Kernel>& volume,
                    const FT& smoothing, const FT& noise_deviation, ConcurrencyTag tag = {})
      : function_(function), other_(volume,
                                    {.degree = function.spline().degree() == 9 ? 7 : 9,
                                     .scheme = other_scheme(function.spline().scheme()),
                                     .smoothing = double(FT(1.2) * smoothing)},
                                    tag) {
    const internal::Spline_rule<FT> rule{function.spline().degree(), function.spline().scheme(),
                                         function.spline().border_degree(), smoothing};
    for (std::size_t a = 0; a < 3; ++a)
      if (const std::size_t nodes = volume.lattice.size()[a]; nodes > std::size_t(rule.degree))
        factors_[a] = factors(internal::Line_functionals<FT>(nodes, rule), a == 0 ? noise_deviation : FT(1));
  }

  Affine_curvature_error<FT> operator()(const Point_3& p) const {
    const Spline_function_3<Kernel>& spline = function_.spline();
    const auto cell = spline.cell_of(p);
    const auto jet = spline.taylor(p);
    if (!cell || local_structure(jet, {p.x(), p.y(), p.z()}, function_.rounding(p)).status != Point_status::REGULAR) {
      const FT nan = std::numeric_limits<FT>::quiet_NaN();
      return {nan, nan};
    }
    const Curvatures at_p = curvatures(jet), other = curvatures(other_.taylor(p));
    FT gaussian = 0, mean = 0;
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto [i, j, k] = internal::monomials[n];
      auto disturbed = spline.to_space(disturbance(*cell, {i, j, k}));
      for (std::size_t m = 0; m < disturbed.size; ++m) disturbed.coefficients()[m] += jet.coefficients()[m];
      const Curvatures c = curvatures(disturbed);
      gaussian += (c.gaussian - at_p.gaussian) * (c.gaussian - at_p.gaussian);
      mean += (c.mean - at_p.mean) * (c.mean - at_p.mean);
    }
    return {2 * (std::sqrt(gaussian) + std::abs(other.gaussian - at_p.gaussian)),
            2 * (std::sqrt(mean) + std::abs(other.mean - at_p.mean))};
  }

private:
  static constexpr std::size_t orders = internal::Line_functionals<FT>::orders;
  using Factor = std::array<std::array<FT, orders>, orders>; // [d][p]: lower triangular

  struct Curvatures {
    FT gaussian, mean;
  };

  /// Along one axis: the Cholesky factors L of the covariance of the Taylor coefficients.
  static internal::Per_kind_of_cell<Factor> factors(const internal::Line_functionals<FT>& line, FT deviation) {
    return {line.kinds(), [&](std::size_t kind) { return factor(line.rows(kind), deviation); }};
  }

  static Factor factor(const typename internal::Line_functionals<FT>::Rows& rows, FT deviation) {
    Factor l{};
    for (std::size_t d = 0; d < orders; ++d)
      for (std::size_t p = 0; p <= d; ++p) {
        FT sum = internal::dot(rows[d], rows[p]);
        for (std::size_t q = 0; q < p; ++q) sum -= l[d][q] * l[p][q];
        l[d][p] = p == d ? std::sqrt(std::max(sum, FT(0))) : l[p][p] > 0 ? sum / l[p][p] : FT(0);
      }
    for (auto& row : l)
      for (FT& x : row) x *= deviation;
    return l;
  }

  /// The error of convolution is much the same for all degrees.
  static Spline_scheme other_scheme(Spline_scheme scheme) {
    return scheme == Spline_scheme::INTERPOLATION ? scheme : Spline_scheme::QUASI_INTERPOLATION;
  }

  static Curvatures curvatures(const Jet_3<FT>& jet) {
    const auto s = affine_invariants(Monge_chart_3<FT>(jet));
    return {s.gaussian_curvature, s.mean_curvature};
  }

  /// Of the expansion in lattice coordinates: the covariance is that of a tensor product, L_x L_x^T times and so on;
  /// column (i, j, k) of its factor.
  Jet_3<FT> disturbance(const std::array<std::size_t, 3>& cell, const std::array<int, 3>& column) const {
    std::array<const Factor*, 3> l;
    for (std::size_t a = 0; a < 3; ++a) l[a] = &factors_[a][cell[a]];
    Jet_3<FT> jet(FT(0));
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto [i, j, k] = internal::monomials[n];
      jet.coefficients()[n] = (*l[0])[std::size_t(i)][std::size_t(column[0])] *
                              (*l[1])[std::size_t(j)][std::size_t(column[1])] *
                              (*l[2])[std::size_t(k)][std::size_t(column[2])];
    }
    return jet;
  }

  Sampled_function_traits_3<Kernel> function_;
  Spline_function_3<Kernel> other_;
  std::array<internal::Per_kind_of_cell<Factor>, 3> factors_;
};

} // namespace equiaffine

#endif
