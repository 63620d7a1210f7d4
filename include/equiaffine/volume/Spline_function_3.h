// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H
#define EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H

#include <equiaffine/Volume_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/shared/Linear_substitution_3.h>
#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/internal/Spline_coefficients.h>
#include <equiaffine/volume/internal/Spline_support_3.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/bspline_bounds.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace equiaffine {

/// The tensor product B-spline of degree 5, 7 or 9 through the samples of a volume, as a function of the points of
/// space: value, and Taylor expansion to order 4, at any point.
///
/// The support is the whole lattice with its border. There the scheme keeps its order because it extends the samples by
/// polynomials of degree n, that of the spline, or of degree n + 2 if the samples are smooth enough
/// (internal/border_degree.h). All numbers are NaN outside of the support, at every point whose samples include one
/// that is not finite (all samples take part in interpolation), and everywhere if an axis has no more than `degree`
/// nodes.
///
/// Derivatives are computed in lattice coordinates and mapped to space by the inverse of the lattice's matrix, so that
/// the lattice may have any rotation, shear and handedness, and steps from 1e-70 to 1e70. The rounding error of a k-th
/// derivative is some 1e-15 max|f| / spacing^k. In the cells at a face of the lattice, quasi-interpolation multiplies
/// it by a factor of 30 to 70, along edges by the square of that factor, and in corners by its cube. See Unser,
/// Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// Const members may be called from many threads at once. The function keeps one number per node and per padding node.
template <class Kernel>
class Spline_function_3 {
public:
  using FT = typename Kernel::FT;                            ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;                  ///< points of the kernel
  using Lattice = Lattice_3<Kernel>;                         ///< the type of the lattice
  using Matrix = typename Linear_substitution_3<FT>::Matrix; ///< three rows of three numbers
  static_assert(std::is_floating_point_v<FT>);

  /// Fourth derivatives for other steps, and what is made of them, may leave the range of double precision.
  static constexpr double shortest_step = 1e-70,
                          longest_step = 1e70; ///< see shortest_step

  /// The coefficients do not depend on the number of threads that compute them. \throw std::invalid_argument unless the
  /// degree is 5, 7 or 9, the smoothing is finite and not negative, there are as many values as nodes, and steps of the
  /// lattice are no shorter or longer than they may be
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_3<Kernel>& volume, const Spline_parameters& parameters = {},
                             ConcurrencyTag = {})
      : degree_(checked_degree(parameters.degree)), border_degree_(parameters.degree), scheme_(parameters.scheme),
        support_(volume.lattice), substitution_(support_.to_lattice()),
        coefficients_(volume.lattice.size(), parameters.degree) {
    check_argument(volume.values.size() == lattice().number_of_nodes(),
                   "a volume has not as many values as its lattice has nodes: choose the lattice that it has");
    for (const auto& step : lattice().steps())
      check_argument(shortest_step * shortest_step <= step.squared_length() &&
                         step.squared_length() <= longest_step * longest_step,
                     "a step of the lattice of a spline is not from 1e-70 to 1e70 long: choose another unit");
    for (const std::size_t nodes : lattice().size())
      if (nodes <= std::size_t(degree_)) return;
    if (parameters.smoothing == 0) fit<ConcurrencyTag>(volume.values);
    else fit<ConcurrencyTag>(smooth_volume<ConcurrencyTag>(volume, FT(parameters.smoothing)).values);
  }

  const Lattice& lattice() const { return support_.lattice(); } ///< where the samples are
  int degree() const { return degree_; }                        ///< 5, 7 or 9
  Spline_scheme scheme() const { return scheme_; }              ///< how samples became coefficients
  /// The degree of the polynomials that extend the samples beyond the border.
  int border_degree() const { return border_degree_; }

  FT value(const Point_3& p) const { return taylor<0>(p).value(); } ///< the value; NaN outside of the support

  /// The cell of the lattice that contains a point of the support.
  std::optional<std::array<std::size_t, 3>> cell_of(const Point_3& p) const {
    const auto place = locate(p);
    if (!place) return std::nullopt;
    return place->cell;
  }

  /// The linear part of the map from space to lattice coordinates.
  const Matrix& to_lattice() const { return support_.to_lattice(); }

  /// Turns an expansion in lattice coordinates into one in those of space.
  Jet_3<FT> to_space(const Jet_3<FT>& jet) const { return substitution_(jet); }

  /// The expansion at p in the coordinates of space, to total order `Order` <= 4; lower orders cost less.
  template <int Order = internal::maximal_order>
  Jet_3<FT, Order> taylor(const Point_3& p) const {
    const auto place = locate(p);
    if (!place) {
      Jet_3<FT, Order> jet;
      jet.coefficients().fill(std::numeric_limits<FT>::quiet_NaN());
      return jet;
    }
    return substitution_(scheme_ == Spline_scheme::PAPER
                             ? coefficients_.template interpolated_expansion<Order>(place->cell, place->offset)
                             : coefficients_.template expansion<Order>(place->cell, place->offset));
  }

  /// Computes an interval that contains the values at all points of the box, also as value() rounds them, from the
  /// coefficients that count there. It is the whole line if a point of the box has no value. Takes time proportional to
  /// the number of cells that the box meets.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const auto common = locate(box);
    if (!common || !common->is_whole_box || bounds_->has_nan(coefficients_.data(), common->box))
      return Interval::whole();
    return bounds_->value(coefficients_.data(), common->box);
  }

  /// Computes intervals that contain the values and the first derivatives in the same sense. In boxes of up to 9 cells
  /// along each axis they are nearly the ranges: the excess shrinks with the square of the side of the box, down to
  /// 2^-12 of a cell. If a point of the box has no value, the bounds of the derivatives are the whole line, and the
  /// bounds of the value are those of the points that have one; they are infinity if there are none.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    const auto common = locate(box);
    std::array<Interval, 4> bounds;
    bounds.fill(Interval::whole());
    if (!common) bounds[0] = internal::no_values();
    else if (common->is_whole_box) bounds = bounds_->first_order(coefficients_.data(), common->box);
    else bounds[0] = bounds_->value(coefficients_.data(), common->box);
    Jet_3<Interval, 1> in_space(bounds[0]);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t a = 0; a < 3; ++a)
        if (to_lattice()[a][b] != 0) in_space.coefficients()[1 + b] += Interval(to_lattice()[a][b]) * bounds[1 + a];
    return in_space;
  }

private:
  static int checked_degree(int degree) {
    check_argument(degree == 5 || degree == 7 || degree == 9,
                   "the degree of a spline is not 5, 7 or 9: choose one of these");
    return degree;
  }

  using Support = internal::Spline_support_3<Kernel>;

  template <class ConcurrencyTag>
  void fit(const std::vector<FT>& samples) {
    border_degree_ = internal::border_degree(samples, lattice().size(), degree_, scheme_);
    coefficients_.template fit<ConcurrencyTag>(samples, lattice().size(), scheme_, border_degree_);
    bounds_.emplace(degree_, coefficients_.size(), support_.slack());
  }

  std::optional<typename Support::Place> locate(const Point_3& p) const {
    if (!bounds_) return std::nullopt;
    return support_.locate(p);
  }

  std::optional<typename Support::Common_box> locate(const CGAL::Bbox_3& box) const {
    if (!bounds_) return std::nullopt;
    auto common = support_.locate(box);
    if (common && scheme_ == Spline_scheme::PAPER) { // its values are means over the corners of a cell
      common->box.begin = {0, 0, 0};
      common->box.end = {1, 1, 1};
    }
    return common;
  }

  int degree_, border_degree_;
  Spline_scheme scheme_;
  Support support_;
  Linear_substitution_3<FT> substitution_;
  internal::Spline_coefficients<FT> coefficients_;
  std::optional<internal::Bspline_bounds<FT>> bounds_; // empty if the lattice has too few nodes for a spline
};

} // namespace equiaffine

#endif
