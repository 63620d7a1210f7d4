// SPDX-License-Identifier: GPL-3.0-or-later
// The spline that approximates the samples of a volume, as a function; also determines the samples on which its values
// in a block of cells depend.
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

/// Finds the cells of a lattice that contain a point or meet a box. The support contains all points of the lattice,
/// including those on its border that rounding moves outside.
template <class Kernel>
class Spline_support_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Lattice = Lattice_3<Kernel>;
  using Matrix = std::array<std::array<FT, 3>, 3>;

  /// A point of the support: its cell, and its position in the cell, in [0, 1] up to rounding.
  struct Place {
    std::array<std::size_t, 3> cell;
    std::array<FT, 3> offset;
  };

  /// The part of a box that lies in the support.
  struct Common_box {
    Bspline_box<FT> box;
    bool is_whole_box = true; ///< false if a part of the box lies outside the support
  };

  explicit Spline_support_3(const Lattice& lattice) : lattice_(lattice), to_lattice_(inverse_matrix(lattice)) {
    for (std::size_t a = 0; a < 3; ++a) slack_[a] = rounding_of_coordinate(a);
  }

  const Lattice& lattice() const { return lattice_; }

  /// The linear part of the map from space to lattice coordinates.
  const Matrix& to_lattice() const { return to_lattice_; }

  /// Bounds on the rounding errors of the lattice coordinates of a point of the lattice.
  const std::array<FT, 3>& slack() const { return slack_; }

  /// The cell and the position of a point in it, if it lies in the support.
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

  /// The bounding box, in lattice coordinates, of the intersection of a box with the support, if they meet. A side
  /// that differs from a node only by rounding is moved to the node.
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

  /// The minimum and the maximum of lattice coordinate a over a box.
  std::array<FT, 2> sides_in_lattice(const CGAL::Bbox_3& box, std::size_t a) const {
    constexpr FT infinity = std::numeric_limits<FT>::infinity();
    std::array<FT, 2> sides{};
    for (int b = 0; b < 3; ++b) {
      const FT p = to_lattice_[a][std::size_t(b)] * (FT(box.min(b)) - lattice_.origin()[b]);
      const FT q = to_lattice_[a][std::size_t(b)] * (FT(box.max(b)) - lattice_.origin()[b]);
      sides[0] += std::min(p, q);
      sides[1] += std::max(p, q);
    }
    if (!(sides[0] <= sides[1])) return {-infinity, infinity}; // NaN from 0 times infinity
    return sides;
  }

  /// Whether a lattice coordinate lies in the support; false for NaN.
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

/// The tensor-product B-spline of degree 5, 7, or 9 that approximates the samples of a volume, as a function in space
/// with its value and its Taylor expansion to order 4 at any point.
///
/// The support is the whole lattice including its border. There the scheme keeps its order because it extends the
/// samples by polynomials of degree n, the degree of the spline, or of degree n + 2 if these predict the outermost
/// samples better; steps, for example of a mask, are extended by constants (Volume_survey.h). All numbers are NaN
/// outside the support, at every point that depends on a sample that is not finite (with interpolation, all points
/// depend on all samples), and everywhere if an axis has at most `degree` nodes. In a part of a volume
/// (Volume_view_3::part), a cell has values if all samples on which it depends are known.
///
/// Derivatives are computed in lattice coordinates and mapped to space by the inverse matrix of the lattice. The
/// lattice may hence have any rotation, shear, and handedness, and steps from 1e-70 to 1e70. The rounding error of a
/// k-th derivative is about 1e-15 max|f| / spacing^k. In the cells at a face of the lattice, quasi-interpolation
/// multiplies it by a factor of 30 to 70, along edges by the square of that factor, and in corners by its cube. See
/// Unser, Aldroubi, Eden: B-spline signal processing, 1993; de Boor: Quasiinterpolants, 1990.
///
/// The function keeps the samples without converting them. It computes its coefficients, one number per node and per
/// padding node, at the first evaluation, or on construction for interpolation. restricted_to_cells() returns
/// functions with the coefficients of a block of cells only. Copies share samples and coefficients. Const members are
/// thread-safe.
template <class Kernel>
class Spline_function_3 {
public:
  using FT = typename Kernel::FT;                            ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;                  ///< points of the kernel
  using Lattice = Lattice_3<Kernel>;                         ///< the type of the lattice
  using Matrix = typename Linear_substitution_3<FT>::Matrix; ///< three rows of three numbers
  static_assert(std::is_floating_point_v<FT>);

  /// With shorter or longer steps, fourth derivatives and quantities computed from them may overflow or underflow.
  static constexpr double shortest_step = 1e-70,
                          longest_step = 1e70; ///< see shortest_step

  /// If `options.smoothing` is not set, decide_smoothing() chooses it. The coefficients do not depend on the number of
  /// threads. \throw Input_error for bad options, and std::invalid_argument unless the lengths of the steps are between
  /// `shortest_step` and `longest_step`
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Spline_function_3(const Volume_view_3<Kernel>& volume, const Volume_options& options = {},
                             ConcurrencyTag tag = {})
      : Spline_function_3(volume, internal::with_smoothing<ConcurrencyTag>(volume, options),
                          internal::border_votes(volume, options, volume.cells()), tag) {}

  /// The same for samples that are already smoothed. `survey` must be that of the whole volume, even if `smooth` is a
  /// part of it.
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

  /// The same function, bit for bit, with only the coefficients of a block of cells, which are computed now in this
  /// thread. Evaluating it outside the block is possible, but takes about 10 microseconds per point. Uses the
  /// coefficients of all cells if they exist already or if the scheme is interpolation. In a part of a volume, the
  /// block is clamped to the cells that have values. \pre the block is not empty and lies in the lattice
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

  /// Maps an expansion in lattice coordinates to the coordinates of space.
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

  /// Returns the maximum magnitude of the coefficients of a cell, which is about that of the samples around it.
  FT greatest_coefficient(const std::array<std::size_t, 3>& cell) const {
    if (!source_ || !source_->cells().contains(cell)) return std::numeric_limits<FT>::quiet_NaN();
    return with_coefficients_of(cell, [&](const Coefficients& coefficients) { return coefficients.greatest(cell); });
  }

  /// Computes an interval that contains the values at all points of the box, including the rounding of value(), from
  /// the coefficients that are relevant there. Returns the whole line if a point of the box has no value. The time is
  /// proportional to the number of cells that meet the box.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const auto common = locate(box);
    if (!common || !common->is_whole_box) return Interval::whole();
    const Coefficients& all = source_->all();
    const auto of_box = bounds_of(all);
    return of_box.has_nan(all.data(), common->box) ? Interval::whole() : of_box.value(all.data(), common->box);
  }

  /// Computes intervals that contain the values and the first derivatives, including rounding. In boxes of up to 9
  /// cells along each axis they are close to the exact ranges: the excess is proportional to the square of the side of
  /// the box, for sides down to 2^-12 of a cell. If a point of the box has no value, the bounds of the derivatives are
  /// the whole line, and the bounds of the value are those of the points with a value, or the interval [infinity,
  /// infinity] if there are none.
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
                     "a lattice step of a spline is shorter than 1e-70 or longer than 1e70: choose another unit");
    for (const std::size_t nodes : lattice().size())
      if (nodes <= std::size_t(degree())) return;
    source_ = std::make_shared<const internal::Coefficient_source<Kernel>>(
        smooth_volume<ConcurrencyTag>(volume, FT(*options.smoothing), votes), fit_, tag);
    if (scheme() == Spline_scheme::INTERPOLATION) source_->all(); // they cannot be computed in parts
  }

  using Support = internal::Spline_support_3<Kernel>;
  using Coefficients = internal::Spline_coefficients<FT>;

  internal::Bspline_bounds<FT> bounds_of(const Coefficients& coefficients) const {
    return {degree(), coefficients.size(), support_.slack()};
  }

  /// Returns f(coefficients) for coefficients that include those of the given cell of the source.
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

  /// The part of a box that has values, in the cells of the source.
  std::optional<typename Support::Common_box> locate(const CGAL::Bbox_3& box) const {
    if (!source_) return std::nullopt;
    auto common = support_.locate(box);
    for (std::size_t a = 0; common && a < 3; ++a) {
      const std::size_t first = source_->cells().first[a], end = source_->cells().end[a];
      if (common->box.first[a] < first || common->box.first[a] + common->box.cells[a] > end) return std::nullopt;
      common->box.first[a] -= first;
    }
    if (common && scheme() == Spline_scheme::PAPER) { // values are interpolated from all corners of a cell
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
  std::shared_ptr<const Coefficients> part_; // those of a block of cells, if the function is restricted
};

/// The kernel is that of the volume.
template <class Kernel>
Spline_function_3(const Volume_3<Kernel>&, const Volume_options& = {}) -> Spline_function_3<Kernel>;

/// The kernel is that of the volume.
template <class Kernel, class ConcurrencyTag>
Spline_function_3(const Volume_3<Kernel>&, const Volume_options&, ConcurrencyTag) -> Spline_function_3<Kernel>;

/// Returns the cells at whose nodes the samples must be known so that a spline through them has values in a block of
/// cells. `nodes` is the number of nodes of the lattice along each axis. Near the border of the lattice more cells
/// are needed, because the samples are extended there. Without a smoothing in the options, the largest scale that may
/// be chosen is assumed.
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
        // The choice of the border degree uses this number of samples at each end of a line.
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
