// SPDX-License-Identifier: GPL-3.0-or-later
// The spline through the samples of a volume as a function, and which samples its values in a block of cells need.
#ifndef EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H
#define EQUIAFFINE_VOLUME_SPLINE_FUNCTION_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/Linear_substitution_3.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/internal/Spline_coefficients.h>
#include <equiaffine/volume/internal/bspline_bounds.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// Finds the cells of a lattice that contain a point or meet a box. All points of the lattice are in the support, those
/// at its border even if rounding moves them out.
template <class Kernel>
class Spline_support_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Lattice = Lattice_3<Kernel>;
  using Matrix = std::array<std::array<FT, 3>, 3>;

  /// A point of the support: its cell, and its place in the cell, in [0, 1] up to rounding.
  struct Place {
    std::array<std::size_t, 3> cell;
    std::array<FT, 3> offset;
  };

  /// The part of a box that is in the support.
  struct Common_box {
    Bspline_box<FT> box;
    bool is_whole_box = true; ///< if false, a part of the box is outside of the support
  };

  explicit Spline_support_3(const Lattice& lattice) : lattice_(lattice), to_lattice_(inverse_matrix(lattice)) {
    for (std::size_t a = 0; a < 3; ++a) slack_[a] = rounding_of_coordinate(a);
  }

  const Lattice& lattice() const { return lattice_; }

  /// The linear part of the map from space to lattice coordinates.
  const Matrix& to_lattice() const { return to_lattice_; }

  /// The greatest change of the lattice coordinates of a point of the lattice by rounding.
  const std::array<FT, 3>& slack() const { return slack_; }

  /// The place of a point, if it is in the support.
  std::optional<Place> locate(const Point_3& p) const {
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

  /// The box of the lattice around what a box and the support have in common, if they meet. A side that only rounding
  /// separates from a node is taken to be there.
  std::optional<Common_box> locate(const CGAL::Bbox_3& box) const {
    Common_box common;
    for (std::size_t a = 0; a < 3; ++a) {
      std::array<FT, 2> sides = sides_in_lattice(box, a);
      const FT last = FT(lattice_.size()[a] - 1);
      if (sides[1] < -slack_[a] || sides[0] > last + slack_[a]) return std::nullopt;
      common.is_whole_box = common.is_whole_box && is_inside(sides[0], a) && is_inside(sides[1], a);
      for (FT& u : sides) {
        if (std::abs(u - std::round(u)) <= slack_[a]) u = std::round(u);
        u = std::clamp(u, FT(0), last);
      }
      const std::size_t first = cell(sides[0], a);
      const std::size_t end = std::max(first + 1, std::size_t(std::ceil(sides[1])));
      common.box.first[a] = first;
      common.box.cells[a] = end - first;
      common.box.begin[a] = sides[0] - FT(first);
      common.box.end[a] = sides[1] - FT(end - 1);
    }
    return common;
  }

private:
  /// Row a of the inverse is the cross product of the other two steps over the determinant.
  static Matrix inverse_matrix(const Lattice& lattice) {
    Matrix inverse;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto row = CGAL::cross_product(lattice.steps()[(a + 1) % 3], lattice.steps()[(a + 2) % 3]);
      for (int b = 0; b < 3; ++b) inverse[a][std::size_t(b)] = row[b] / lattice.determinant();
    }
    return inverse;
  }

  FT rounding_of_coordinate(std::size_t a) const {
    const CGAL::Bbox_3 box = lattice_.bbox();
    FT sum = 0;
    for (int b = 0; b < 3; ++b)
      sum += std::abs(to_lattice_[a][std::size_t(b)]) * FT(std::max(std::abs(box.min(b)), std::abs(box.max(b))));
    return 8 * std::numeric_limits<FT>::epsilon() * sum;
  }

  /// The least and the greatest lattice coordinate a of the points of a box.
  std::array<FT, 2> sides_in_lattice(const CGAL::Bbox_3& box, std::size_t a) const {
    constexpr FT infinity = std::numeric_limits<FT>::infinity();
    std::array<FT, 2> sides{};
    for (int b = 0; b < 3; ++b) {
      const FT p = to_lattice_[a][std::size_t(b)] * (FT(box.min(b)) - lattice_.origin()[b]);
      const FT q = to_lattice_[a][std::size_t(b)] * (FT(box.max(b)) - lattice_.origin()[b]);
      sides[0] += std::min(p, q);
      sides[1] += std::max(p, q);
    }
    if (!(sides[0] <= sides[1])) return {-infinity, infinity}; // 0 times infinity has made a NaN
    return sides;
  }

  /// Whether a lattice coordinate is in the support; NaN is not.
  bool is_inside(FT u, std::size_t a) const { return u >= -slack_[a] && u <= FT(lattice_.size()[a] - 1) + slack_[a]; }

  std::size_t cell(FT u, std::size_t a) const {
    return std::min(std::size_t(std::max(u, FT(0))), lattice_.size()[a] - 2);
  }

  Lattice lattice_;
  Matrix to_lattice_;
  std::array<FT, 3> slack_{};
};

} // namespace equiaffine::internal

namespace equiaffine {

/// The tensor product B-spline of degree 5, 7 or 9 through the samples of a volume, as a function of the points of
/// space: value, and Taylor expansion to order 4, at any point.
///
/// The support is the whole lattice with its border. There the scheme keeps its order because it extends the samples by
/// polynomials of degree n, that of the spline, or of degree n + 2 if the samples are smooth enough, or by constants if
/// they are steps, as those of a mask (Volume_survey.h). All numbers are NaN outside of the support, at every point
/// whose samples include one that is not finite (all samples take part in interpolation), and everywhere if an axis has
/// no more than `degree` nodes. Of a part of a volume (Volume_view_3::part) a cell has a value if all samples that it
/// depends on are known.
///
/// Derivatives are computed in lattice coordinates and mapped to space by the inverse of the lattice's matrix, so that
/// the lattice may have any rotation, shear and handedness, and steps from 1e-70 to 1e70. The rounding error of a k-th
/// derivative is some 1e-15 max|f| / spacing^k. In the cells at a face of the lattice, quasi-interpolation multiplies
/// it by a factor of 30 to 70, along edges by the square of that factor, and in corners by its cube. See Unser,
/// Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// The function keeps the samples, as they are. It computes its coefficients, one number per node and per padding node,
/// when it is first evaluated, or at once for interpolation; restricted_to_cells() makes functions that have only those
/// of a block of cells. Copies share samples and coefficients. Const members may be called from many threads at once.
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

  /// Without a smoothing in the options decide_smoothing() finds it. The coefficients do not depend on the number of
  /// threads that compute them. \throw Input_error for bad options, and std::invalid_argument unless steps of the
  /// lattice are no shorter or longer than they may be
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_view_3<Kernel>& volume, const Volume_options& options = {},
                             ConcurrencyTag tag = {})
      : Spline_function_3(volume, internal::with_smoothing<ConcurrencyTag>(volume, options),
                          internal::border_votes(volume, options, volume.cells()), tag) {}

  /// The same for samples that are smoothed already, and the survey of the volume, of which they may be a part.
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Spline_function_3(const Volume_view_3<Kernel>& smooth, const Volume_options& options, const Volume_survey& survey,
                    ConcurrencyTag tag = {})
      : Spline_function_3(smooth, {.spline_scheme = options.spline_scheme, .spline_degree = options.spline_degree},
                          survey.border_votes, tag) {}

  const Lattice& lattice() const { return support_.lattice(); } ///< where the samples are
  int degree() const { return fit_.degree; }                    ///< 5, 7 or 9
  Spline_scheme scheme() const { return fit_.scheme; }          ///< how samples become coefficients
  /// The degree of the polynomials that extend the samples beyond the border.
  int border_degree() const { return fit_.border_degree; }

  /// The same function, bit for bit, with the coefficients of a block of cells only, which are computed at once and in
  /// this thread. It may be evaluated elsewhere, too, which costs some 10 microseconds a point. If the coefficients of
  /// all cells exist already, or if the scheme is interpolation, they are used. Of a part of a volume, those cells of
  /// the block count that have a value. \pre the block has cells, and the lattice all of them
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
  Spline_function_3(const Volume_view_3<Kernel>& volume, const Volume_options& options, const Border_votes& votes,
                    ConcurrencyTag tag)
      : fit_{options.spline_degree, options.spline_scheme,
             internal::elected_border_degree(votes, options.spline_degree)},
        support_(volume.lattice()), substitution_(support_.to_lattice()) {
    for (const auto& step : lattice().steps())
      check_argument(shortest_step * shortest_step <= step.squared_length() &&
                         step.squared_length() <= longest_step * longest_step,
                     "a step of the lattice of a spline is not from 1e-70 to 1e70 long: choose another unit");
    for (const std::size_t nodes : lattice().size())
      if (nodes <= std::size_t(degree())) return;
    source_ = std::make_shared<const internal::Coefficient_source<Kernel>>(
        smooth_volume<ConcurrencyTag>(volume, FT(*options.smoothing), votes), fit_, tag);
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
Spline_function_3(const Volume_3<Kernel>&, const Volume_options& = {}) -> Spline_function_3<Kernel>;

/// The kernel is that of the volume.
template <class Kernel, class ConcurrencyTag>
Spline_function_3(const Volume_3<Kernel>&, const Volume_options&, ConcurrencyTag) -> Spline_function_3<Kernel>;

/// The cells at whose nodes samples must be known so that a spline through them has its values in all cells of a block.
/// `nodes` are the numbers of nodes of the lattice. Beside the border of the lattice these are more than elsewhere,
/// since there the samples are extended. Without a smoothing the greatest one that may be chosen counts.
/// \throw Input_error for bad options, and for interpolation, which needs all samples
inline Cell_block cells_to_know(const Cell_block& cells, const std::array<std::size_t, 3>& nodes,
                                const Volume_options& options) {
  options.check();
  if (options.spline_scheme == Spline_scheme::INTERPOLATION)
    throw Input_error::about("spline_scheme",
                             "interpolation needs all samples of a volume; choose quasi-interpolation");
  const std::size_t degree = std::size_t(options.spline_degree);
  const double smoothing = options.smoothing.value_or(greatest_scale_to_choose);
  const internal::Spline_fit fit = {options.spline_degree, options.spline_scheme,
                                    internal::greater_border_degree(options.spline_degree)};
  Cell_block known = cells;
  fit.with_filter<double>([&](const auto& line) {
    if constexpr (requires { line.samples_of({}, 0); })
      for (std::size_t a = 0; a < 3; ++a) {
        if (nodes[a] <= degree) continue; // there is no spline
        internal::Line_part used = line.samples_of({cells.first[a], cells.end[a] + degree}, nodes[a]);
        // The votes on the border degree look at so many samples at an end of a line.
        const auto voting = std::min(nodes[a], std::size_t(fit.border_degree) + 2);
        if (cells.first[a] == 0) used.end = std::max(used.end, voting);
        if (cells.end[a] + 1 == nodes[a]) used.first = std::min(used.first, nodes[a] - voting);
        if (smoothing > 1)
          used = internal::Smoothing_filter<double>(smoothing, nodes[a], fit.border_degree).samples_of(used);
        known.first[a] = std::min(known.first[a], used.first);
        known.end[a] = std::max(known.end[a], used.end - 1);
      }
  });
  return known;
}

} // namespace equiaffine

#endif
