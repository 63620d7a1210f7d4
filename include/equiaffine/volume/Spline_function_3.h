// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H
#define EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/Linear_substitution_3.h>
#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/bspline_bounds.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/internal/bspline_interpolation.h>
#include <equiaffine/volume/internal/separable_filter.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace equiaffine {

/// The tensor product B-spline of degree 5, 7 or 9 through the samples of a volume, as a function of the points of
/// space: value, and Taylor expansion to order 4, at any point.
///
/// The support is the whole lattice, borders included, where the scheme keeps its order by extrapolating samples, by
/// polynomials of degree n or, if the samples are smooth enough, n + 2 (internal/border_degree.h). Outside, at every
/// point whose samples include one that is not finite (all samples take part in interpolation), and everywhere if an
/// axis has no more than `degree` nodes, all numbers are NaN.
///
/// Derivatives are taken in lattice coordinates and mapped by the inverse of the lattice's matrix: any spacing,
/// rotation, shear and handedness. The rounding error of a k-th derivative is some 1e-15 max|f| / spacing^k, in the
/// cells at the border 30 to 70 times that by quasi-interpolation, and the square and cube of it in edges and corners.
/// Unser, Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// Const members may be called from many threads at once. Memory: one number per node and per padding node.
template <class Kernel>
class Spline_function_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Lattice = Lattice_3<Kernel>;
  using Matrix = typename internal::Linear_substitution_3<FT>::Matrix;
  static_assert(std::is_floating_point_v<FT>);

  /// The coefficients do not depend on the number of threads that compute them.
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_3<Kernel>& volume, const Spline_parameters& parameters = {},
                             ConcurrencyTag = {})
      : lattice_(volume.lattice), degree_(parameters.degree), scheme_(parameters.scheme),
        to_lattice_(inverse_matrix(lattice_)), substitution_(to_lattice_) {
    CGAL_precondition(degree_ == 5 || degree_ == 7 || degree_ == 9);
    CGAL_precondition(volume.values.size() == lattice_.number_of_nodes());
    for (std::size_t a = 0; a < 3; ++a) {
      slack_[a] = rounding_of_coordinate(a);
      size_[a] = lattice_.size()[a] + 2 * std::size_t(internal::spline_padding(degree_));
      is_supported_ = is_supported_ && lattice_.size()[a] > std::size_t(degree_);
    }
    if (!is_supported_) return;
    if (parameters.smoothing == 0) fit<ConcurrencyTag>(volume.values);
    else fit<ConcurrencyTag>(smooth_volume<ConcurrencyTag>(volume, FT(parameters.smoothing)).values);
  }

  const Lattice& lattice() const { return lattice_; }
  int degree() const { return degree_; }
  Spline_scheme scheme() const { return scheme_; }
  /// Of the polynomials that extend the samples beyond the border.
  int border_degree() const { return border_degree_; }

  FT value(const Point_3& p) const { return taylor<0>(p).value(); }

  /// The cell of the lattice that contains a point of the support.
  std::optional<std::array<std::size_t, 3>> cell_of(const Point_3& p) const {
    const auto place = locate(p);
    if (!place) return std::nullopt;
    return place->cell;
  }

  /// The linear part of the map from space to lattice coordinates.
  const Matrix& to_lattice() const { return to_lattice_; }

  /// An expansion in lattice coordinates, in those of space.
  Jet_3<FT> to_space(const Jet_3<FT>& jet) const { return substitution_(jet); }

  /// The expansion at p in the coordinates of space, to total order `Order` <= 4; the lower ones cost less.
  template <int Order = internal::maximal_order>
  Jet_3<FT, Order> taylor(const Point_3& p) const {
    const auto place = locate(p);
    if (!place) {
      Jet_3<FT, Order> jet;
      jet.coefficients().fill(std::numeric_limits<FT>::quiet_NaN());
      return jet;
    }
    return substitution_(scheme_ == Spline_scheme::PAPER ? interpolated_expansion<Order>(*place)
                                                         : expansion<Order>(*place));
  }

  /// Contains the values at all points of the box, also as computed, from the coefficients that count there. The whole
  /// line if there is a point without a value in the box. The time is proportional to the number of cells that the box
  /// meets.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const auto part = locate(box);
    if (!part || !part->is_complete || bounds_->has_nan(coefficients_.data(), part->box)) return Interval::whole();
    return bounds_->value(coefficients_.data(), part->box);
  }

  /// Contains the values and the first derivatives in the same sense. In boxes of up to 9 cells along each axis they
  /// are nearly the ranges: the excess shrinks with the square of the box, down to 2^-12 of a cell. If there are points
  /// without a value in the box, the bounds of the derivatives are the whole line, and those of the value are of the
  /// other points; infinity, if none of them has one.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    const auto part = locate(box);
    std::array<Interval, 4> bounds;
    bounds.fill(Interval::whole());
    if (!part) bounds[0] = internal::no_values();
    else if (part->is_complete) bounds = bounds_->first_order(coefficients_.data(), part->box);
    else bounds[0] = bounds_->value(coefficients_.data(), part->box);
    Jet_3<Interval, 1> in_space(bounds[0]);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t a = 0; a < 3; ++a)
        if (to_lattice_[a][b] != 0) in_space.coefficients()[1 + b] += Interval(to_lattice_[a][b]) * bounds[1 + a];
    return in_space;
  }

private:
  struct Place {
    std::array<std::size_t, 3> cell;
    std::array<FT, 3> offset; // in [0, 1], up to rounding
  };

  struct Part {
    internal::Bspline_box<FT> box;
    bool is_complete = true; // else the box leaves the support
  };

  static Matrix inverse_matrix(const Lattice& lattice) {
    Matrix inverse;
    for (std::size_t a = 0; a < 3; ++a) { // row a: the cross product of the other two steps / determinant
      const auto row = CGAL::cross_product(lattice.steps()[(a + 1) % 3], lattice.steps()[(a + 2) % 3]);
      for (int b = 0; b < 3; ++b) inverse[a][std::size_t(b)] = row[b] / lattice.determinant();
    }
    return inverse;
  }

  /// How far rounding moves lattice coordinate `a` of a point of the lattice: points of its border count as inside.
  FT rounding_of_coordinate(std::size_t a) const {
    const CGAL::Bbox_3 box = lattice_.bbox();
    FT sum = 0;
    for (int b = 0; b < 3; ++b)
      sum += std::abs(to_lattice_[a][std::size_t(b)]) * FT(std::max(std::abs(box.min(b)), std::abs(box.max(b))));
    return 8 * std::numeric_limits<FT>::epsilon() * sum;
  }

  bool is_inside(FT u, std::size_t a) const {
    return u >= -slack_[a] && u <= FT(lattice_.size()[a] - 1) + slack_[a]; // false for NaN
  }

  std::size_t cell(FT u, std::size_t a) const {
    return std::min(std::size_t(std::max(u, FT(0))), lattice_.size()[a] - 2);
  }

  std::optional<Place> locate(const Point_3& p) const {
    if (!is_supported_) return std::nullopt;
    Place place;
    const auto d = p - lattice_.origin();
    for (std::size_t a = 0; a < 3; ++a) {
      const FT u = to_lattice_[a][0] * d.x() + to_lattice_[a][1] * d.y() + to_lattice_[a][2] * d.z();
      if (!is_inside(u, a)) return std::nullopt;
      place.cell[a] = cell(u, a);
      place.offset[a] = u - FT(place.cell[a]);
    }
    return place;
  }

  /// The part of a box in the support; nothing if there is none. A side that rounding separates from a node is there.
  std::optional<Part> locate(const CGAL::Bbox_3& box) const {
    if (!is_supported_) return std::nullopt;
    constexpr FT infinity = std::numeric_limits<FT>::infinity();
    Part part;
    for (std::size_t a = 0; a < 3; ++a) {
      std::array<FT, 2> side{}; // lower, upper
      for (int b = 0; b < 3; ++b) {
        const FT p = to_lattice_[a][std::size_t(b)] * (FT(box.min(b)) - lattice_.origin()[b]);
        const FT q = to_lattice_[a][std::size_t(b)] * (FT(box.max(b)) - lattice_.origin()[b]);
        side[0] += std::min(p, q);
        side[1] += std::max(p, q);
      }
      if (!(side[0] <= side[1])) side = {-infinity, infinity}; // 0 times infinity
      const FT last = FT(lattice_.size()[a] - 1);
      if (side[1] < -slack_[a] || side[0] > last + slack_[a]) return std::nullopt;
      part.is_complete = part.is_complete && is_inside(side[0], a) && is_inside(side[1], a);
      for (FT& u : side) {
        if (std::abs(u - std::round(u)) <= slack_[a]) u = std::round(u);
        u = std::clamp(u, FT(0), last);
      }
      const std::size_t first = cell(side[0], a);
      const std::size_t end = std::max(first + 1, std::size_t(std::ceil(side[1])));
      part.box.first[a] = first;
      part.box.cells[a] = end - first;
      const bool is_exact = scheme_ != Spline_scheme::PAPER; // whose expansions are means of those at all corners
      part.box.begin[a] = is_exact ? side[0] - FT(first) : FT(0);
      part.box.end[a] = is_exact ? side[1] - FT(end - 1) : FT(1);
    }
    return part;
  }

  /// In lattice coordinates.
  template <int Order>
  Jet_3<FT, Order> expansion(const Place& place) const {
    Jet_3<FT, Order> jet;
    const FT* first = &coefficients_[coefficient_index(place.cell)];
    internal::with_degree(degree_, [&](auto n) {
      internal::contract<n, Order>(first, size_[0], size_[0] * size_[1], place.offset, jet.coefficients());
    });
    return jet;
  }

  /// Linear in each coordinate between the expansions at the corners of the cell.
  template <int Order>
  Jet_3<FT, Order> interpolated_expansion(const Place& place) const {
    Jet_3<FT, Order> sum(FT(0));
    for (unsigned corner = 0; corner < 8; ++corner) {
      Place node = place;
      FT weight = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        node.offset[a] = FT(corner >> a & 1);
        weight *= corner >> a & 1 ? place.offset[a] : 1 - place.offset[a];
      }
      const auto jet = expansion<Order>(node);
      for (std::size_t n = 0; n < jet.size; ++n) sum.coefficients()[n] += weight * jet.coefficients()[n];
    }
    return sum;
  }

  /// Position of a coefficient; the first tap of cell c is coefficient c, as padding shifts both alike.
  std::size_t coefficient_index(const std::array<std::size_t, 3>& c) const {
    return (c[2] * size_[1] + c[1]) * size_[0] + c[0];
  }

  /// Chooses the border's degree and computes the coefficients.
  template <class ConcurrencyTag>
  void fit(const std::vector<FT>& samples) {
    border_degree_ = internal::border_degree(samples, lattice_.size(), degree_, scheme_);
    coefficients_.resize(size_[0] * size_[1] * size_[2] + internal::overread);
    internal::with_degree(degree_, [&](auto n) { filter<n, ConcurrencyTag>(samples); });
    bounds_.emplace(degree_, size_, slack_);
  }

  /// Samples to coefficients, along x, then y, then z.
  template <int Degree, class ConcurrencyTag>
  void filter(const std::vector<FT>& samples) {
    internal::with_line_filter<FT, Degree>(scheme_, border_degree_, [&](const auto& line) {
      using Filter = std::decay_t<decltype(line)>;
      internal::Separable_filter<ConcurrencyTag, FT, Filter>(lattice_.size(), Filter::padding, coefficients_.data())(
          {&line, &line, &line}, samples.data());
    });
    const std::size_t slab = size_[0] * size_[1];
    internal::parallel_for<ConcurrencyTag>(0, size_[2], [&](std::size_t k) {
      FT* const first = coefficients_.data() + k * slab;
      for (FT* x = first; x != first + slab; ++x)
        if (!std::isfinite(*x)) *x = std::numeric_limits<FT>::quiet_NaN(); // an infinity could pass as a value
    });
  }

  Lattice lattice_;
  int degree_, border_degree_ = degree_;
  Spline_scheme scheme_;
  Matrix to_lattice_;
  internal::Linear_substitution_3<FT> substitution_;
  std::array<FT, 3> slack_{};
  std::array<std::size_t, 3> size_{}; // of the coefficients, padding included
  bool is_supported_ = true;
  std::vector<FT> coefficients_;
  std::optional<internal::Bspline_bounds<FT>> bounds_; // if there is a support
};

} // namespace equiaffine

#endif
