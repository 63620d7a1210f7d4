// SPDX-License-Identifier: GPL-3.0-or-later
// The level set f = v of a model of f, with a choice of orientation.
#ifndef EQUIAFFINE_FUNCTION_LEVEL_SET_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_LEVEL_SET_TRAITS_3_H

#include <equiaffine/function/capabilities.h>

#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace equiaffine {

/// The side of a level set to which its normals point.
enum class Orientation_of_level_set {
  ALONG_GRADIENT,  ///< towards larger values, the default
  AGAINST_GRADIENT ///< towards smaller values, for volumes that are bright inside
};

/// The function f - v, or v - f for AGAINST_GRADIENT. Its zero set is the level set f = v with the chosen orientation.
/// It models every refinement of the concept that the base models, and has the base's capabilities. Reversing the
/// orientation changes the sign of nu, xi, H, J, H_e and of the metric, and preserves K and K_e.
template <ImplicitFunctionTraits_3 Base>
class Level_set_traits_3 {
public:
  using FT = typename Base::FT;             ///< the number type of the base
  using Point_3 = typename Base::Point_3;   ///< points of the base
  using Vector_3 = typename Base::Vector_3; ///< vectors of the base

  /// The level set f = `isovalue` of the base, with the given orientation.
  Level_set_traits_3(Base base, const FT& isovalue,
                     Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT)
      : base_(std::move(base)), isovalue_(isovalue),
        is_reversed_(orientation == Orientation_of_level_set::AGAINST_GRADIENT) {}

  FT value(const Point_3& p) const { return shifted(base_.value(p)); } ///< f(p) - v, or v - f(p)
  /// The expansion of order 1, computed from the base.
  Jet_3<FT, 1> first_order(const Point_3& p) const requires FirstOrderImplicitFunctionTraits_3<Base> {
    return shifted(base_.first_order(p));
  }
  /// The expansion of order 4, computed from the base.
  Jet_3<FT> taylor(const Point_3& p) const { return shifted(base_.taylor(p)); }
  /// The expansion of order 5, computed from the base, if the base has one.
  std::optional<Jet_3<FT, 5>> fifth_order(const Point_3& p) const requires HasFifthOrder<Base> {
    const std::optional<Jet_3<FT, 5>> jet = base_.fifth_order(p);
    return jet ? std::optional(shifted(*jet)) : std::nullopt;
  }
  /// Sets values[i] to value(points[i]).
  void values(std::span<const Point_3> points,
              std::span<FT> values) const requires BatchImplicitFunctionTraits_3<Base> {
    base_.values(points, values);
    for (FT& value : values) value = shifted(value);
  }
  /// Sets jets[i] to first_order(points[i]).
  void first_orders(std::span<const Point_3> points,
                    std::span<Jet_3<FT, 1>> jets) const requires FirstOrderBatchImplicitFunctionTraits_3<Base> {
    base_.first_orders(points, jets);
    for (auto& jet : jets) jet = shifted(jet);
  }
  /// Sets jets[i] to taylor(points[i]).
  void taylors(std::span<const Point_3> points,
               std::span<Jet_3<FT>> jets) const requires BatchImplicitFunctionTraits_3<Base> {
    base_.taylors(points, jets);
    for (auto& jet : jets) jet = shifted(jet);
  }
  /// Sets jets[n] to the expansions at the points of the packs x[n], y[n], z[n].
  void taylor_packs(std::span<const Pack<FT>> x, std::span<const Pack<FT>> y, std::span<const Pack<FT>> z,
                    std::span<Jet_3<Pack<FT>>> jets) const requires PackImplicitFunctionTraits_3<Base> {
    base_.taylor_packs(x, y, z, jets);
    for (auto& jet : jets) jet = shifted(jet);
  }
  /// Bounds of the value on a box, from those of the base.
  Interval bounds(const CGAL::Bbox_3& box) const requires BoundedImplicitFunctionTraits_3<Base> {
    const Interval b = base_.bounds(box) - Interval(CGAL::to_double(isovalue_));
    return is_reversed_ ? -b : b;
  }
  /// Bounds of value and gradient on a box, from those of the base.
  Jet_3<Interval, 1>
  first_order_bounds(const CGAL::Bbox_3& box) const requires FirstOrderBoundedImplicitFunctionTraits_3<Base> {
    return shifted_bounds(base_.first_order_bounds(box));
  }
  /// Bounds of the expansion of order 2 on a box, from those of the base.
  Jet_3<Interval, 2>
  second_order_bounds(const CGAL::Bbox_3& box) const requires SecondOrderBoundedImplicitFunctionTraits_3<Base> {
    return shifted_bounds(base_.second_order_bounds(box));
  }
  /// The tighter bounds of value and gradient on a box, from those of the base.
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const requires HasTightFirstOrderBounds<Base> {
    return shifted_bounds(base_.tight_first_order_bounds(box));
  }
  /// Which bounds the base has.
  Known_bounds known_bounds() const requires HasKnownBounds<Base> { return base_.known_bounds(); }
  /// The same level set of the cheaper function for a box, if the base has one.
  std::optional<Level_set_traits_3>
  restricted(const CGAL::Bbox_3& box) const requires RestrictableImplicitFunctionTraits_3<Base> {
    auto base = base_.restricted(box);
    return base ? std::optional(with_base(*std::move(base))) : std::nullopt;
  }
  FT rounding(const Point_3& p) const requires HasRounding<Base> { return base_.rounding(p); } ///< that of the base
  /// The certainty of the base at p.
  double certainty(const Point_3& p) const requires HasCertainty<Base> { return base_.certainty(p); }
  CGAL::Bbox_3 bbox() const { return base_.bbox(); } ///< that of the base

  /// Calls the base if v = 0 and the orientation is kept; otherwise the base would search for zeros of another
  /// function.
  Surface_point_3<Kernel_of<Base>> intersect_segment(const Point_3& a, const Point_3& b, const FT& fa,
                                                     const FT& fb) const requires HasIntersectSegment<Base> {
    if (isovalue_ == FT(0) && !is_reversed_) return base_.intersect_segment(a, b, fa, fb);
    return internal::zero_on_segment<Kernel_of<Base>>(*this, a, b, fa, fb);
  }
  /// The lattice of the given size on which to sample the base.
  Lattice_3<Kernel_of<Base>> lattice(const typename Lattice_3<Kernel_of<Base>>::Size& size) const {
    return sampling_lattice(base_, size);
  }

  /// The lattice of the base.
  auto lattice() const requires LatticeImplicitFunctionTraits_3<Base> { return base_.lattice(); }
  /// The sample of the base at node (i, j, k), minus v and reversed like value().
  FT sample(std::size_t i, std::size_t j, std::size_t k) const requires LatticeImplicitFunctionTraits_3<Base> {
    return shifted(base_.sample(i, j, k));
  }
  /// The samples of the base at a block of nodes, minus v and reversed like value().
  void samples(const std::array<std::size_t, 3>& first, const std::array<std::size_t, 3>& size,
               std::span<FT> out) const requires HasSamples<Base> {
    base_.samples(first, size, out);
    for (FT& sample : out) sample = shifted(sample);
  }
  /// The cell of the base's lattice that contains p.
  auto cell_of(const Point_3& p) const requires CellwiseImplicitFunctionTraits_3<Base> { return base_.cell_of(p); }
  /// The same level set of the base restricted to a block of cells.
  Level_set_traits_3
  restricted_to_cells(const Cell_block& cells) const requires CellwiseImplicitFunctionTraits_3<Base> {
    return with_base(base_.restricted_to_cells(cells));
  }

  const Base& base() const { return base_; } ///< the function f

private:
  Level_set_traits_3 with_base(Base base) const {
    return Level_set_traits_3(std::move(base), isovalue_,
                              is_reversed_ ? Orientation_of_level_set::AGAINST_GRADIENT
                                           : Orientation_of_level_set::ALONG_GRADIENT);
  }

  FT shifted(const FT& value) const { return is_reversed_ ? isovalue_ - value : value - isovalue_; }

  /// Rounds like the overload for numbers: v + (-f) equals v - f bit for bit.
  template <class Number, int Order>
  Jet_3<Number, Order> shifted(Jet_3<Number, Order> jet) const {
    if (is_reversed_) jet = -jet;
    jet.template at<0>() = is_reversed_ ? isovalue_ + jet.value() : jet.value() - isovalue_;
    return jet;
  }

  template <int Order>
  Jet_3<Interval, Order> shifted_bounds(Jet_3<Interval, Order> jet) const {
    jet.template at<0>() = jet.value() - Interval(CGAL::to_double(isovalue_));
    return is_reversed_ ? -jet : jet;
  }

  Base base_;
  FT isovalue_;
  bool is_reversed_;
};

} // namespace equiaffine

#endif
