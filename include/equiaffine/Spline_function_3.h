// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SPLINE_FUNCTION_3_H
#define EQUIAFFINE_SPLINE_FUNCTION_3_H

#include <equiaffine/Interval.h>
#include <equiaffine/Jet_3.h>
#include <equiaffine/Volume_3.h>
#include <equiaffine/internal/Linear_substitution_3.h>
#include <equiaffine/internal/bspline_bounds.h>
#include <equiaffine/internal/bspline_evaluation.h>
#include <equiaffine/internal/parallel_for.h>

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

/// How samples become spline coefficients. Orders are those of the value for spacing h -> 0; a derivative of order k
/// has order min(2, n + 1 - k) and n + 1 - k respectively, n the degree.
enum class Spline_scheme {
  CONVOLUTION,        ///< coefficients = samples, the paper's choice: smooths; order 2
  QUASI_INTERPOLATION ///< a local filter of 2 floor(n / 2) + 1 samples per axis: order n + 1, no spreading of kinks
};

/// The tensor product B-spline of degree 5, 7 or 9 through the samples of a volume, as a function of the points of
/// space: value, and Taylor expansion to order 4, at any point.
///
/// The support is the whole lattice, borders included, where the scheme keeps its order by extrapolating samples
/// (internal/bspline.h). Outside, at every point whose samples include one that is not finite, and everywhere if an
/// axis has no more than `degree` nodes, all numbers are NaN.
///
/// Derivatives are taken in lattice coordinates and mapped by the inverse of the lattice's matrix: any spacing,
/// rotation, shear and handedness. The rounding error of a k-th derivative is some 1e-15 max|f| / spacing^k, in the
/// cells at the border 10, 30, 1000 times that for degree 5, 7, 9.
/// Unser, Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// Const members may be called from many threads at once. Memory: one number per node and per padding node, and
/// a fortieth of that once a box of many cells is bounded.
template <class Kernel>
class Spline_function_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Lattice = Lattice_3<Kernel>;
  static_assert(std::is_floating_point_v<FT>);

  /// The coefficients do not depend on the number of threads that compute them.
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_3<Kernel>& volume, int degree = 7,
                             Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION, ConcurrencyTag = {})
      : lattice_(volume.lattice), degree_(degree), scheme_(scheme), to_lattice_(inverse_matrix(lattice_)),
        substitution_(to_lattice_) {
    CGAL_precondition(degree == 5 || degree == 7 || degree == 9);
    CGAL_precondition(volume.values.size() == lattice_.number_of_nodes());
    for (std::size_t a = 0; a < 3; ++a) {
      slack_[a] = rounding_of_coordinate(a);
      size_[a] = lattice_.size()[a] + 2 * std::size_t(internal::spline_padding(degree));
      is_supported_ = is_supported_ && lattice_.size()[a] > std::size_t(degree);
    }
    if (!is_supported_) return;
    coefficients_.resize(size_[0] * size_[1] * size_[2] + internal::overread);
    for_degree([&](auto n) {
      filter<n, ConcurrencyTag>(volume.values);
      bounds_.emplace(degree_, internal::relative_error_of_value<n, FT>(), size_);
    });
  }

  const Lattice& lattice() const { return lattice_; }
  int degree() const { return degree_; }
  Spline_scheme scheme() const { return scheme_; }

  FT value(const Point_3& p) const { return taylor<0>(p).value(); }

  /// The expansion at p in the coordinates of space, to total order `Order` <= 4; the lower ones cost less.
  template <int Order = internal::maximal_order>
  Jet_3<FT, Order> taylor(const Point_3& p) const {
    const auto place = locate(p);
    if (!place) {
      Jet_3<FT, Order> jet;
      jet.coefficients().fill(std::numeric_limits<FT>::quiet_NaN());
      return jet;
    }
    return substitution_(taylor_in_lattice<Order>(*place));
  }

  /// Contains the values at all points of the box, also as computed: they lie between the least and the greatest
  /// coefficient of the B-splines that do not vanish there. The whole line if the box leaves the support. The time is
  /// proportional to the number of cells that the box meets, or of blocks of 8 x 8 x 8 cells if it meets many.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const auto part = locate(box);
    if (!part || !part->is_complete) return Interval::whole();
    const auto range = bounds_->values(coefficients_.data(), part->box);
    return range.is_finite ? bounds_->bound(range) : Interval::whole();
  }

  /// Contains the values and the first derivatives in the same sense. In boxes of up to `degree` cells per axis these
  /// also are bounded from the center of the box, by bounds of the second derivatives: widths are proportional to those
  /// of small boxes. If there are points without a value in the box, the bounds of the derivatives are the whole line,
  /// and those of the value are of the other points; infinity, if none of them has one.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    const auto part = locate(box);
    std::array<Interval, 4> bounds;
    bounds.fill(Interval::whole());
    if (!part) bounds[0] = internal::no_values();
    else {
      const auto taylor = [&](const std::array<FT, 3>& u) { return taylor_in_lattice<1>(place_of(u)); };
      const auto known = bounds_->first_order(coefficients_.data(), part->box, taylor);
      if (part->is_complete) bounds = known;
      else bounds[0] = known[0];
    }
    Jet_3<Interval, 1> in_space(bounds[0]);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t a = 0; a < 3; ++a)
        if (to_lattice_[a][b] != 0) in_space.coefficients()[1 + b] += Interval(to_lattice_[a][b]) * bounds[1 + a];
    return in_space;
  }

private:
  using Matrix = typename internal::Linear_substitution_3<FT>::Matrix;

  struct Place {
    std::array<std::size_t, 3> cell;
    std::array<FT, 3> offset; // in [0, 1], up to rounding
  };

  struct Part {
    internal::Bspline_box<FT> box;
    bool is_complete; // else the box leaves the support
  };

  template <class F>
  void for_degree(F f) const {
    if (degree_ == 5) f(std::integral_constant<int, 5>());
    else if (degree_ == 7) f(std::integral_constant<int, 7>());
    else f(std::integral_constant<int, 9>());
  }

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
    std::array<FT, 3> u;
    const auto d = p - lattice_.origin();
    for (std::size_t a = 0; a < 3; ++a) {
      u[a] = to_lattice_[a][0] * d.x() + to_lattice_[a][1] * d.y() + to_lattice_[a][2] * d.z();
      if (!is_inside(u[a], a)) return std::nullopt;
    }
    return place_of(u);
  }

  /// What rounding puts outside moves to the border: no spline is extrapolated.
  Place place_of(const std::array<FT, 3>& u) const {
    Place place;
    for (std::size_t a = 0; a < 3; ++a) {
      place.cell[a] = cell(u[a], a);
      place.offset[a] = std::clamp(u[a] - FT(place.cell[a]), FT(0), FT(1));
    }
    return place;
  }

  /// The part of a box in the support; nothing if there is none.
  std::optional<Part> locate(const CGAL::Bbox_3& box) const {
    if (!is_supported_) return std::nullopt;
    Part part = {{}, true};
    for (std::size_t a = 0; a < 3; ++a) {
      FT lower = 0, upper = 0;
      for (int b = 0; b < 3; ++b) {
        const FT p = to_lattice_[a][std::size_t(b)] * (FT(box.min(b)) - lattice_.origin()[b]);
        const FT q = to_lattice_[a][std::size_t(b)] * (FT(box.max(b)) - lattice_.origin()[b]);
        lower += std::min(p, q);
        upper += std::max(p, q);
      }
      part.is_complete = part.is_complete && is_inside(lower, a) && is_inside(upper, a);
      const FT last = FT(lattice_.size()[a] - 1), slack = 2 * slack_[a]; // of the box, and of points at the border
      if (upper < -slack || lower > last + slack) return std::nullopt;
      part.box.lower[a] = std::min(last, std::max(FT(0), lower - slack));
      part.box.upper[a] = std::max(FT(0), std::min(last, upper + slack));
      part.box.first[a] = cell(part.box.lower[a], a);
      part.box.last[a] = cell(part.box.upper[a], a) + std::size_t(degree_);
    }
    return part;
  }

  /// In lattice coordinates.
  template <int Order>
  Jet_3<FT, Order> taylor_in_lattice(const Place& place) const {
    Jet_3<FT, Order> jet;
    const FT* first = &coefficients_[coefficient_index(place.cell)];
    for_degree([&](auto n) {
      internal::contract<n, Order>(first, size_[0], size_[0] * size_[1], place.offset, jet.coefficients());
    });
    return jet;
  }

  /// Position of a coefficient; the first tap of cell c is coefficient c, as padding shifts both alike.
  std::size_t coefficient_index(const std::array<std::size_t, 3>& c) const {
    return (c[2] * size_[1] + c[1]) * size_[0] + c[0];
  }

  /// Samples to coefficients, along x, then y, then z.
  template <int Degree, class ConcurrencyTag>
  void filter(const std::vector<FT>& samples) {
    using Filter = internal::Line_filter<FT, Degree>;
    static constexpr Filter convolution = Filter::convolution();
    static constexpr Filter quasi_interpolation = Filter::quasi_interpolation();
    const Filter& line = scheme_ == Spline_scheme::CONVOLUTION ? convolution : quasi_interpolation;

    const auto [nx, ny, nz] = lattice_.size();
    const std::size_t pad = Filter::padding, row = size_[0], slab = size_[0] * size_[1];
    FT* const c = coefficients_.data();
    internal::parallel_for<ConcurrencyTag>(0, ny * nz, [&, nx = nx, ny = ny](std::size_t line_number) {
      const std::size_t j = line_number % ny, k = line_number / ny;
      const FT* from = &samples[lattice_.index(0, j, k)];
      line.apply(from, nx, 1, c + (k + pad) * slab + (j + pad) * row, 1);
    });
    internal::parallel_for<ConcurrencyTag>(
        0, nz, [&, ny = ny](std::size_t k) { filter_in_place(line, c + (k + pad) * slab, ny, row); });
    internal::parallel_for<ConcurrencyTag>(
        0, size_[1], [&, nz = nz](std::size_t j) { filter_in_place(line, c + j * row, nz, slab); });
    internal::parallel_for<ConcurrencyTag>(0, size_[2], [&](std::size_t k) {
      for (FT* x = c + k * slab; x != c + (k + 1) * slab; ++x)
        if (!std::isfinite(*x)) *x = std::numeric_limits<FT>::quiet_NaN(); // an infinity could pass as a value
    });
  }

  /// Filters the `count` rows that lie `stride` apart, after `padding` empty ones, in the direction across them.
  template <class Filter>
  void filter_in_place(const Filter& line, FT* rows, std::size_t count, std::size_t stride) const {
    const std::size_t width = size_[0];
    std::vector<FT> samples(count * width);
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(rows + (i + std::size_t(Filter::padding)) * stride, width, &samples[i * width]);
    line.apply(samples.data(), count, width, rows, stride);
  }

  Lattice lattice_;
  int degree_;
  Spline_scheme scheme_;
  Matrix to_lattice_;
  internal::Linear_substitution_3<FT> substitution_;
  std::array<FT, 3> slack_{};
  std::array<std::size_t, 3> size_{}; // of the coefficients, padding included
  bool is_supported_ = true;
  std::vector<FT> coefficients_;
  std::optional<internal::Bspline_bounds<FT>> bounds_;
};

} // namespace equiaffine

#endif
