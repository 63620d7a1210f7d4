// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H
#define EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/Linear_substitution_3.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/Spline_coefficients.h>
#include <equiaffine/volume/internal/Spline_support_3.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/bspline_bounds.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace equiaffine {

/// The tensor product B-spline of degree 5, 7 or 9 through the samples of a volume, as a function of the points of
/// space: value, and Taylor expansion to order 4, at any point.
///
/// The support is the whole lattice with its border. There the scheme keeps its order because it extends the samples by
/// polynomials of degree n, that of the spline, or of degree n + 2 if the samples are smooth enough, or by constants if
/// they are steps, as those of a mask (internal/border_degree.h). All numbers are NaN outside of the support, at every point whose samples include one
/// that is not finite (all samples take part in interpolation), and everywhere if an axis has no more than `degree`
/// nodes. Of a part of a volume (Volume_view_3::part) a cell has a value if all samples that it depends on are known.
///
/// Derivatives are computed in lattice coordinates and mapped to space by the inverse of the lattice's matrix, so that
/// the lattice may have any rotation, shear and handedness, and steps from 1e-70 to 1e70. The rounding error of a k-th
/// derivative is some 1e-15 max|f| / spacing^k. In the cells at a face of the lattice, quasi-interpolation multiplies
/// it by a factor of 30 to 70, along edges by the square of that factor, and in corners by its cube. See Unser,
/// Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// The function keeps the samples, as they are. It computes its coefficients, one number per node and per padding node,
/// when it is first evaluated, or at once for interpolation; restricted_to_cells() makes functions that have only those of
/// a block of cells. Copies
/// share samples and coefficients. Const members may be called from many threads at once.
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
  /// degree is 5, 7 or 9, the smoothing is finite and not negative, and steps of the lattice are no shorter or longer
  /// than they may be
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_view_3<Kernel>& volume, const Spline_parameters& parameters = {},
                             ConcurrencyTag tag = {})
      : Spline_function_3(volume, parameters, internal::border_votes(volume, parameters, volume.cells()), tag) {}

  /// The same for samples that are smoothed already, and the survey of the volume, of which they may be a part.
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Spline_function_3(const Volume_view_3<Kernel>& smooth, const Spline_parameters& parameters,
                    const Volume_survey& survey, ConcurrencyTag tag = {})
      : Spline_function_3(smooth, {.degree = parameters.degree, .scheme = parameters.scheme}, survey.border_votes,
                          tag) {}

  const Lattice& lattice() const { return support_.lattice(); } ///< where the samples are
  int degree() const { return fit_.degree; }                    ///< 5, 7 or 9
  Spline_scheme scheme() const { return fit_.scheme; }          ///< how samples become coefficients
  /// The degree of the polynomials that extend the samples beyond the border.
  int border_degree() const { return fit_.border_degree; }

  /// The same function, bit for bit, with the coefficients of a block of cells only, which are computed at once and in
  /// this thread. It may be evaluated elsewhere, too, which costs some 10 microseconds a point. If the coefficients of all
  /// cells exist already, or if the scheme is interpolation, they are used. Of a part of a volume, those cells of the block
  /// count that have a value. \pre the block has cells, and the lattice all of them
  Spline_function_3 restricted_to_cells(const Cell_block& cells) const {
    for (std::size_t a = 0; a < 3; ++a)
      CGAL_precondition(cells.first[a] < cells.end[a] && cells.end[a] < lattice().size()[a]);
    Spline_function_3 result = *this;
    if (source_ && scheme() != Spline_scheme::INTERPOLATION && !source_->all_if_computed())
      result.part_ = std::make_shared<const Coefficients>(source_->of_cells(clamped(cells, source_->cells())));
    return result;
  }

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

  /// The expansion at p in the coordinates of space, to total order `Order` <= 5; lower orders cost less.
  template <int Order = internal::default_order>
  Jet_3<FT, Order> taylor(const Point_3& p) const {
    const auto place = locate(p);
    if (!place || !source_->cells().contains(place->cell)) {
      Jet_3<FT, Order> jet;
      jet.coefficients().fill(std::numeric_limits<FT>::quiet_NaN());
      return jet;
    }
    return with_coefficients_of(place->cell, [&](const Coefficients& coefficients) {
      return substitution_(scheme() == Spline_scheme::PAPER
                               ? coefficients.template interpolated_expansion<Order>(place->cell, place->offset)
                               : coefficients.template expansion<Order>(place->cell, place->offset));
    });
  }

  /// Returns the greatest magnitude of the coefficients of a cell, about that of the samples around it.
  FT greatest_coefficient(const std::array<std::size_t, 3>& cell) const {
    if (!source_ || !source_->cells().contains(cell)) return std::numeric_limits<FT>::quiet_NaN();
    return with_coefficients_of(cell, [&](const Coefficients& coefficients) { return coefficients.greatest(cell); });
  }

  /// Computes an interval that contains the values at all points of the box, also as value() rounds them, from the
  /// coefficients that count there. It is the whole line if a point of the box has no value. Takes time proportional to
  /// the number of cells that the box meets.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const auto common = locate(box);
    if (!common || !common->is_whole_box) return Interval::whole();
    const Coefficients& all = source_->all();
    const auto of_box = bounds_of(all);
    return of_box.has_nan(all.data(), common->box) ? Interval::whole() : of_box.value(all.data(), common->box);
  }

  /// Computes intervals that contain the values and the first derivatives in the same sense. In boxes of up to 9 cells
  /// along each axis they are nearly the ranges: the excess shrinks with the square of the side of the box, down to
  /// 2^-12 of a cell. If a point of the box has no value, the bounds of the derivatives are the whole line, and the
  /// bounds of the value are those of the points that have one; they are infinity if there are none.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    const auto common = locate(box);
    std::array<Interval, 4> bounds;
    bounds.fill(Interval::whole());
    if (common) {
      const Coefficients& all = source_->all();
      if (common->is_whole_box) bounds = bounds_of(all).first_order(all.data(), common->box);
      else bounds[0] = bounds_of(all).value(all.data(), common->box);
    } else if (!source_ || source_->cells() == cells_of(lattice().size())) {
      bounds[0] = internal::no_values();
    }
    Jet_3<Interval, 1> in_space(bounds[0]);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t a = 0; a < 3; ++a)
        if (to_lattice()[a][b] != 0) in_space.coefficients()[1 + b] += Interval(to_lattice()[a][b]) * bounds[1 + a];
    return in_space;
  }

private:
  template <class ConcurrencyTag>
  Spline_function_3(const Volume_view_3<Kernel>& volume, const Spline_parameters& parameters, const Border_votes& votes,
                    ConcurrencyTag tag)
      : fit_{internal::checked_degree(parameters.degree), parameters.scheme,
             internal::elected_border_degree(votes, parameters.degree)},
        support_(volume.lattice()), substitution_(support_.to_lattice()) {
    for (const auto& step : lattice().steps())
      check_argument(shortest_step * shortest_step <= step.squared_length() &&
                         step.squared_length() <= longest_step * longest_step,
                     "a step of the lattice of a spline is not from 1e-70 to 1e70 long: choose another unit");
    for (const std::size_t nodes : lattice().size())
      if (nodes <= std::size_t(degree())) return;
    source_ = std::make_shared<const internal::Coefficient_source<Kernel>>(
        smooth_volume<ConcurrencyTag>(volume, FT(parameters.smoothing), votes), fit_, tag);
    if (scheme() == Spline_scheme::INTERPOLATION) source_->all(); // no part of them can be computed alone
  }

  using Support = internal::Spline_support_3<Kernel>;
  using Coefficients = internal::Spline_coefficients<FT>;

  internal::Bspline_bounds<FT> bounds_of(const Coefficients& coefficients) const {
    return {degree(), coefficients.size(), support_.slack()};
  }

  /// Returns f(coefficients) for coefficients that have those of a cell of the source.
  template <class F>
  auto with_coefficients_of(const std::array<std::size_t, 3>& cell, const F& f) const {
    if (!part_) return f(source_->all());
    if (part_->cells().contains(cell)) return f(*part_);
    if (const Coefficients* const all = source_->all_if_computed()) return f(*all);
    const auto [i, j, k] = cell;
    return f(source_->of_cells({{i, j, k}, {i + 1, j + 1, k + 1}}));
  }

  std::optional<typename Support::Place> locate(const Point_3& p) const {
    if (!source_) return std::nullopt;
    return support_.locate(p);
  }

  /// The part of a box where there are values, in the cells of the source.
  std::optional<typename Support::Common_box> locate(const CGAL::Bbox_3& box) const {
    if (!source_) return std::nullopt;
    auto common = support_.locate(box);
    for (std::size_t a = 0; common && a < 3; ++a) {
      const std::size_t first = source_->cells().first[a], end = source_->cells().end[a];
      if (common->box.first[a] < first || common->box.first[a] + common->box.cells[a] > end) return std::nullopt;
      common->box.first[a] -= first;
    }
    if (common && scheme() == Spline_scheme::PAPER) { // its values are means over the corners of a cell
      common->box.begin = {0, 0, 0};
      common->box.end = {1, 1, 1};
    }
    return common;
  }

  internal::Spline_fit fit_;
  Support support_;
  Linear_substitution_3<FT, internal::maximal_order> substitution_;
  std::shared_ptr<const internal::Coefficient_source<Kernel>>
      source_;                               // null if the lattice has too few nodes for a spline
  std::shared_ptr<const Coefficients> part_; // of a block of cells, if the function is restricted
};

/// The kernel is that of the volume.
template <class Kernel>
Spline_function_3(const Volume_3<Kernel>&, const Spline_parameters& = {}) -> Spline_function_3<Kernel>;

/// The kernel is that of the volume.
template <class Kernel, class ConcurrencyTag>
Spline_function_3(const Volume_3<Kernel>&, const Spline_parameters&, ConcurrencyTag) -> Spline_function_3<Kernel>;

} // namespace equiaffine

#endif
