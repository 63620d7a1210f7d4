// SPDX-License-Identifier: GPL-3.0-or-later
// Optional members of models of ImplicitFunctionTraits_3. For each there is a free function that calls the member or,
// if the model lacks it, falls back on members that every model has. Both have the same name, except that
// sampling_lattice() calls the member `lattice(size)`. The wrappers Level_set_traits_3, Transformed_function_traits_3,
// Any_function_3 and, below, Batch_function_traits_3 have the capabilities of what they wrap.
// doc/concepts/capabilities.md documents the semantics of each; test/support/conformance.h checks every model and
// wrapper.
#ifndef EQUIAFFINE_FUNCTION_CAPABILITIES_H
#define EQUIAFFINE_FUNCTION_CAPABILITIES_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace equiaffine::internal {

// Boxes as intervals, and bounds on them.

/// The ranges of x, y and z in a box.
inline std::array<Interval, 3> sides_of(const CGAL::Bbox_3& box) {
  return {Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()), Interval(box.zmin(), box.zmax())};
}

inline std::array<double, 3> center_of(const CGAL::Bbox_3& box) {
  return {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2};
}

/// The box that contains only the point.
inline CGAL::Bbox_3 box_of_point(const std::array<double, 3>& p) {
  return CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
}

/// The ranges of the vectors from the center to the points of a box.
inline std::array<Interval, 3> offset_from_center(const CGAL::Bbox_3& box, const std::array<double, 3>& center) {
  std::array<Interval, 3> offset = sides_of(box);
  for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = offset[axis] - Interval(center[axis]);
  return offset;
}

/// The index of the monomial x_a x_b.
inline std::size_t index_of_product(std::size_t axis, std::size_t other_axis) {
  std::array<int, 3> exponents = {};
  ++exponents[axis];
  ++exponents[other_axis];
  return std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]));
}

/// Bounds of value and gradient on a box by the mean value theorem: for a point c of the box, f lies in f(c) + sum of
/// f_a offset_a, and its derivative f_a along axis a lies in f_a(c) + sum of f_ab offset_b. `at_point` has the bounds
/// at c, `on_box` those on the box, and `offset` is the range of vectors from c to points of the box. The result is
/// intersected with `on_box`.
inline Jet_3<Interval, 1> mean_value_bounds(const Jet_3<Interval, 2>& on_box, const Jet_3<Interval, 1>& at_point,
                                            const std::array<Interval, 3>& offset) {
  const auto& derivatives = on_box.coefficients();
  std::array<Interval, 4> sum = at_point.coefficients();
  for (std::size_t a = 0; a < 3; ++a) {
    sum[0] += derivatives[1 + a] * offset[a];
    for (std::size_t b = 0; b < 3; ++b) // the Taylor coefficient of x_a^2 is half of f_aa
      sum[1 + a] += derivatives[index_of_product(a, b)] * offset[b] * Interval(a == b ? 2 : 1);
  }
  Jet_3<Interval, 1> bounds;
  for (std::size_t n = 0; n < 4; ++n) bounds.coefficients()[n] = Interval::intersection(derivatives[n], sum[n]);
  return bounds;
}

} // namespace equiaffine::internal

namespace equiaffine {

// clang-format off

/// A model that chooses the lattices on which it is sampled, for example to cover the image of a box.
/// See \ref concept_capabilities.
template <class Traits>
concept HasSamplingLattice = requires(const Traits& traits, const typename Lattice_3<Kernel_of<Traits>>::Size& size) {
  { traits.lattice(size) } -> std::convertible_to<Lattice_3<Kernel_of<Traits>>>;
};

/// A model with bounds of value and gradient that are tighter than its `first_order_bounds`, at a higher cost.
/// See \ref concept_capabilities.
template <class Traits>
concept HasTightFirstOrderBounds = requires(const Traits& traits, const CGAL::Bbox_3& box) {
  { traits.tight_first_order_bounds(box) } -> std::same_as<Jet_3<Interval, 1>>;
};

/// The kinds of bounds that a model has. Bounds are tight in small boxes if their excess over the range decreases with
/// the square of the box's size.
struct Known_bounds {
  bool have_gradients,          ///< bounds of value and gradient, not only of the value
      are_tight_in_small_boxes; ///< see above
};

/// A model that determines at run time which bounds it has, such as Any_function_3.
/// See \ref concept_capabilities.
template <class Traits>
concept HasKnownBounds = requires(const Traits& traits) {
  { traits.known_bounds() } -> std::same_as<Known_bounds>;
};

/// A model with derivatives of order 5, which the gradients of affine curvatures need.
/// See \ref concept_capabilities.
template <class Traits>
concept HasFifthOrder = requires(const Traits& traits, const typename Traits::Point_3& p) {
  { traits.fifth_order(p) } -> std::convertible_to<std::optional<Jet_3<typename Traits::FT, 5>>>;
};

/// A model whose second derivatives can have errors larger than their own rounding, as those of a spline, and that
/// bounds these errors. See \ref concept_capabilities.
template <class Traits>
concept HasRounding = requires(const Traits& traits, const typename Traits::Point_3& p) {
  traits.rounding(p);
};

/// A model that rates the reliability of its affine curvatures, such as a fit with estimated errors.
/// See \ref concept_capabilities.
template <class Traits>
concept HasCertainty = requires(const Traits& traits, const typename Traits::Point_3& p) {
  { traits.certainty(p) } -> std::convertible_to<double>;
};

/// A model with its own search for zeros on segments.
/// See \ref concept_capabilities.
template <class Traits>
concept HasIntersectSegment = requires(const Traits& traits, const typename Traits::Point_3& p,
                                       const typename Traits::FT& f) {
  { traits.intersect_segment(p, p, f, f) } -> std::same_as<Surface_point_3<Kernel_of<Traits>>>;
};

/// A model that returns the samples of a block of nodes in one call.
/// See \ref concept_capabilities.
template <class Traits>
concept HasSamples = requires(const Traits& traits, const std::array<std::size_t, 3>& node,
                              std::span<typename Traits::FT> out) {
  traits.samples(node, node, out);
};

// clang-format on

/// The expansion of order 1 at a point, computed as cheaply as the model permits.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<typename Traits::FT, 1> first_order(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) {
    return traits.first_order(p);
  } else {
    const auto jet = traits.taylor(p);
    Jet_3<typename Traits::FT, 1> result;
    for (std::size_t n = 0; n < 4; ++n) result.coefficients()[n] = jet.coefficients()[n];
    return result;
  }
}

/// The expansion of order 5 at a point, if the model has one.
template <ImplicitFunctionTraits_3 Traits>
std::optional<Jet_3<typename Traits::FT, 5>> fifth_order(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (HasFifthOrder<Traits>) return traits.fifth_order(p);
  else return std::nullopt;
}

/// The lattice of the given size on which to sample a function: chosen by the model, or axis-parallel in its box.
template <ImplicitFunctionTraits_3 Traits>
Lattice_3<Kernel_of<Traits>> sampling_lattice(const Traits& traits,
                                              const typename Lattice_3<Kernel_of<Traits>>::Size& size) {
  if constexpr (HasSamplingLattice<Traits>) return traits.lattice(size);
  else return Lattice_3<Kernel_of<Traits>>(size, traits.bbox());
}

/// Bounds of value and gradient on a box. Missing bounds are the whole real line.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (FirstOrderBoundedImplicitFunctionTraits_3<Traits>) {
    return traits.first_order_bounds(box);
  } else {
    Jet_3<Interval, 1> jet;
    jet.coefficients().fill(Interval::whole());
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) jet.template at<0>() = traits.bounds(box);
    return jet;
  }
}

/// The tightest bounds of value and gradient that the model supports. If they come from bounds of second order, they
/// cost about three times as much, and their excess over the range is of the order of the square of the box's size.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> tight_first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (HasTightFirstOrderBounds<Traits>) {
    return traits.tight_first_order_bounds(box);
  } else if constexpr (SecondOrderBoundedImplicitFunctionTraits_3<Traits>) {
    const auto center = internal::center_of(box);
    const auto at_center = traits.first_order_bounds(internal::box_of_point(center));
    return internal::mean_value_bounds(traits.second_order_bounds(box), at_center,
                                       internal::offset_from_center(box, center));
  } else {
    return first_order_bounds(traits, box);
  }
}

/// Returns which bounds the model has.
template <ImplicitFunctionTraits_3 Traits>
Known_bounds known_bounds(const Traits& traits) {
  if constexpr (HasKnownBounds<Traits>) return traits.known_bounds();
  else return {FirstOrderBoundedImplicitFunctionTraits_3<Traits>, SecondOrderBoundedImplicitFunctionTraits_3<Traits>};
}

/// A bound on the error of the second derivatives at p, in excess of a few rounding errors of the derivatives. A
/// Gaussian curvature that such errors could produce is treated as zero.
template <ImplicitFunctionTraits_3 Traits>
typename Traits::FT rounding(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (HasRounding<Traits>) return traits.rounding(p);
  else return typename Traits::FT(0);
}

/// The reliability of the affine curvatures of the level set through p, from 0 to 1. It is invariant under affine maps
/// of space. Registration tries points of greater certainty first.
template <ImplicitFunctionTraits_3 Traits>
double certainty(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (HasCertainty<Traits>) return traits.certainty(p);
  else return 1;
}

/// Finds a zero of f on the segment ab, where f has the values fa and fb of different signs at its ends (0 counts as
/// positive). Uses Newton's method if the model has cheaper derivatives than `taylor`, otherwise Chandrupatla's method.
/// Both start from linear interpolation and stay within the bracket. The result is accurate to a few roundings of the
/// coordinates. If |f| neither falls below its values at the ends nor becomes negligible, the sign changes without a
/// zero: at a pole, at a jump, or where f becomes undefined. The result then has not converged and contains the reason.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> intersect_segment(const Traits& traits, const typename Traits::Point_3& a,
                                                     const typename Traits::Point_3& b, const typename Traits::FT& fa,
                                                     const typename Traits::FT& fb) {
  if constexpr (HasIntersectSegment<Traits>) return traits.intersect_segment(a, b, fa, fb);
  else return internal::zero_on_segment<Kernel_of<Traits>>(traits, a, b, fa, fb);
}

/// Writes the samples of a function at a block of nodes of its lattice, i fastest. The block starts at node `first` and
/// has `size` nodes along each axis.
template <LatticeImplicitFunctionTraits_3 Traits>
void samples(const Traits& traits, const std::array<std::size_t, 3>& first, const std::array<std::size_t, 3>& size,
             std::span<typename Traits::FT> out) {
  if constexpr (HasSamples<Traits>) traits.samples(first, size, out);
  else {
    std::size_t n = 0;
    for (std::size_t k = 0; k < size[2]; ++k)
      for (std::size_t j = 0; j < size[1]; ++j)
        for (std::size_t i = 0; i < size[0]; ++i) out[n++] = traits.sample(first[0] + i, first[1] + j, first[2] + k);
  }
}

/// Turns any model of ImplicitFunctionTraits_3 into a model of FirstOrderBatchImplicitFunctionTraits_3. Calls the batch
/// members of the base, or loops over single calls if it has none. All other members of the base stay available.
template <ImplicitFunctionTraits_3 Traits>
class Batch_function_traits_3 : public Traits {
public:
  using typename Traits::FT;      ///< the number type
  using typename Traits::Point_3; ///< points

  explicit Batch_function_traits_3(Traits traits) : Traits(std::move(traits)) {} ///< copies the model

  /// Sets values[i] to value(points[i]). \pre the spans have the same size
  void values(std::span<const Point_3> points, std::span<FT> values) const {
    CGAL_precondition(points.size() == values.size());
    if constexpr (BatchImplicitFunctionTraits_3<Traits>) Traits::values(points, values);
    else
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = Traits::value(points[i]);
  }

  /// Sets jets[i] to first_order(points[i]). \pre the spans have the same size
  void first_orders(std::span<const Point_3> points, std::span<Jet_3<FT, 1>> jets) const {
    CGAL_precondition(points.size() == jets.size());
    if constexpr (FirstOrderBatchImplicitFunctionTraits_3<Traits>) Traits::first_orders(points, jets);
    else
      for (std::size_t i = 0; i < points.size(); ++i)
        jets[i] = equiaffine::first_order(static_cast<const Traits&>(*this), points[i]);
  }

  /// Sets jets[i] to taylor(points[i]). \pre the spans have the same size
  void taylors(std::span<const Point_3> points, std::span<Jet_3<FT>> jets) const {
    CGAL_precondition(points.size() == jets.size());
    if constexpr (BatchImplicitFunctionTraits_3<Traits>) Traits::taylors(points, jets);
    else
      for (std::size_t i = 0; i < points.size(); ++i) jets[i] = Traits::taylor(points[i]);
  }

  /// The model restricted to a block of cells, wrapped again.
  Batch_function_traits_3
  restricted_to_cells(const Cell_block& cells) const requires CellwiseImplicitFunctionTraits_3<Traits> {
    return Batch_function_traits_3(Traits::restricted_to_cells(cells));
  }
};

} // namespace equiaffine

#endif
