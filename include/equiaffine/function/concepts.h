// SPDX-License-Identifier: GPL-3.0-or-later
// The concepts of functions, which all algorithms for level sets require. doc/concepts has a page on the semantics of
// each concept; test/support/conformance.h checks every model. capabilities.h has optional members of models.
#ifndef EQUIAFFINE_FUNCTION_CONCEPTS_H
#define EQUIAFFINE_FUNCTION_CONCEPTS_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/select.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Lattice_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>

namespace equiaffine {

// clang-format off

/// A function f on a box with its Taylor expansions of total order 4. All members must be thread-safe. The value is NaN
/// where f is undefined; some coefficient is not finite where f is not four times differentiable.
/// See \ref concept_ImplicitFunctionTraits_3.
template <class Traits>
concept ImplicitFunctionTraits_3 =
  std::copy_constructible<Traits> &&
  requires(const Traits& traits, const typename Traits::Point_3& p) {
    typename Traits::FT;
    typename Traits::Vector_3;
    { traits.value(p) } -> std::convertible_to<typename Traits::FT>;
    { traits.taylor(p) } -> std::same_as<Jet_3<typename Traits::FT>>;
    { traits.bbox() } -> std::convertible_to<CGAL::Bbox_3>;
  };

/// A function that bounds its values on a box: `bounds(box)` contains f(p) for every p in the box.
/// See \ref concept_BoundedImplicitFunctionTraits_3.
template <class Traits>
concept BoundedImplicitFunctionTraits_3 =
  ImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const CGAL::Bbox_3& box) {
    { traits.bounds(box) } -> std::same_as<Interval>;
  };

/// A function that also bounds its gradient: coefficient n of `first_order_bounds(box)` contains coefficient n of
/// `first_order(p)` for every p in the box.
/// See \ref concept_FirstOrderBoundedImplicitFunctionTraits_3.
template <class Traits>
concept FirstOrderBoundedImplicitFunctionTraits_3 =
  BoundedImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const CGAL::Bbox_3& box) {
    { traits.first_order_bounds(box) } -> std::same_as<Jet_3<Interval, 1>>;
  };

/// A function that also bounds its second derivatives, for tighter bounds in small boxes: coefficient n of
/// `second_order_bounds(box)` contains coefficient n of the expansion of order 2 at every p in the box.
/// See \ref concept_SecondOrderBoundedImplicitFunctionTraits_3.
template <class Traits>
concept SecondOrderBoundedImplicitFunctionTraits_3 =
  FirstOrderBoundedImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const CGAL::Bbox_3& box) {
    { traits.second_order_bounds(box) } -> std::same_as<Jet_3<Interval, 2>>;
  };

/// A function that may have a cheaper version on a box: `restricted(box)` is empty, or a function with the same values
/// and expansions of order 1 in the box, bit for bit, and with valid bounds of these.
/// See \ref concept_RestrictableImplicitFunctionTraits_3.
template <class Traits>
concept RestrictableImplicitFunctionTraits_3 =
  BoundedImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const CGAL::Bbox_3& box) {
    { traits.restricted(box) } -> std::same_as<std::optional<Traits>>;
  };

/// A function that evaluates many points in one call, with the same results as single calls, bit for bit.
/// See \ref concept_BatchImplicitFunctionTraits_3.
template <class Traits>
concept BatchImplicitFunctionTraits_3 =
  ImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, std::span<const typename Traits::Point_3> points,
           std::span<typename Traits::FT> values, std::span<Jet_3<typename Traits::FT>> jets) {
    traits.values(points, values);
    traits.taylors(points, jets);
  };

/// A function that also expands to order 1 at many points in one call, with the same results as `first_order`, bit for
/// bit unless the compiler contracts products and sums.
/// See \ref concept_BatchImplicitFunctionTraits_3.
template <class Traits>
concept FirstOrderBatchImplicitFunctionTraits_3 =
  BatchImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, std::span<const typename Traits::Point_3> points,
           std::span<Jet_3<typename Traits::FT, 1>> jets) {
    traits.first_orders(points, jets);
  };

/// A function that expands at points in packs: lane i of x[n], y[n], z[n] is a point, and lane i of jets[n] is its
/// expansion, bit for bit unless the compiler contracts products and sums. May throw Lanes_disagree.
/// See \ref concept_PackImplicitFunctionTraits_3.
template <class Traits>
concept PackImplicitFunctionTraits_3 =
  ImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, std::span<const Pack<typename Traits::FT>> x,
           std::span<Jet_3<Pack<typename Traits::FT>>> jets) {
    traits.taylor_packs(x, x, x, jets);
  };

/// A function with a cheaper expansion of order 1, for root finding.
/// See \ref concept_FirstOrderImplicitFunctionTraits_3.
template <class Traits>
concept FirstOrderImplicitFunctionTraits_3 =
  ImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const typename Traits::Point_3& p) {
    { traits.first_order(p) } -> std::same_as<Jet_3<typename Traits::FT, 1>>;
  };

/// A function with samples at the nodes of a lattice.
/// See \ref concept_LatticeImplicitFunctionTraits_3.
template <class Traits>
concept LatticeImplicitFunctionTraits_3 =
  ImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, std::size_t i) {
    { traits.lattice() }
      -> std::convertible_to<Lattice_3<typename CGAL::Kernel_traits<typename Traits::Point_3>::Kernel>>;
    { traits.sample(i, i, i) } -> std::convertible_to<typename Traits::FT>;
  };

/// A lattice function that may need less memory if it is evaluated in a block of cells only.
/// See \ref concept_CellwiseImplicitFunctionTraits_3.
template <class Traits>
concept CellwiseImplicitFunctionTraits_3 =
  LatticeImplicitFunctionTraits_3<Traits> &&
  requires(const Traits& traits, const typename Traits::Point_3& p, const Cell_block& cells) {
    { traits.cell_of(p) } -> std::same_as<std::optional<std::array<std::size_t, 3>>>;
    { traits.restricted_to_cells(cells) } -> std::same_as<Traits>;
  };

// clang-format on

/// The kernel of the points of a model.
template <ImplicitFunctionTraits_3 Traits>
using Kernel_of = typename CGAL::Kernel_traits<typename Traits::Point_3>::Kernel;

namespace internal {

/// Fails to compile, with an explanation, if a type is not a model of ImplicitFunctionTraits_3. See
/// explain_parameters() in named_parameters.h.
template <class Traits>
constexpr void explain_traits() {
  static_assert(
      requires {
        typename Traits::FT;
        typename Traits::Point_3;
        typename Traits::Vector_3;
      },
      "this function is not a model of ImplicitFunctionTraits_3: it has no types FT, Point_3 and Vector_3; call "
      "make_analytic_traits() with f(x, y, z), or sample_on_lattice() with f(p) and then Sampled_function_traits_3");
  static_assert(
      requires(const Traits& t, const typename Traits::Point_3& p) {
        { t.value(p) } -> std::convertible_to<typename Traits::FT>;
      },
      "this function is not a model of ImplicitFunctionTraits_3: it has no member value(p) const that returns an FT");
  static_assert(
      requires(const Traits& t, const typename Traits::Point_3& p) {
        { t.taylor(p) } -> std::same_as<Jet_3<typename Traits::FT>>;
      },
      "this function is not a model of ImplicitFunctionTraits_3: it has no member taylor(p) const that returns a "
      "Jet_3<FT>; call expand<4>() with f(x, y, z)");
  static_assert(
      requires(const Traits& t) {
        { t.bbox() } -> std::convertible_to<CGAL::Bbox_3>;
      },
      "this function is not a model of ImplicitFunctionTraits_3: it has no member bbox() const that returns a "
      "CGAL::Bbox_3");
  static_assert(std::copy_constructible<Traits>,
                "this function is not a model of ImplicitFunctionTraits_3: it cannot be copied");
}

} // namespace internal

} // namespace equiaffine

#endif
