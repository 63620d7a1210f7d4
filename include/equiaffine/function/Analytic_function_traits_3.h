// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_ANALYTIC_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_ANALYTIC_FUNCTION_TRAITS_3_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/Pack.h>

#include <CGAL/Algebraic_structure_traits.h>
#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace equiaffine {

/// A function given as code: `f(x, y, z)`, a template of its number type, const and thread-safe. Models
/// FirstOrderBatchImplicitFunctionTraits_3 and, if f accepts Interval, SecondOrderBoundedImplicitFunctionTraits_3.
///
///     struct Sphere {
///       template <class T> T operator()(const T& x, const T& y, const T& z) const { return x*x + y*y + z*z - 1.0; }
///     };
///     Analytic_function_traits_3<Kernel, Sphere> traits(Sphere(), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
///
/// f is called with FT, Interval and jets of both; Marching Cubes, max_distance_to_surface and compute_attributes also
/// call it with jets of Pack<FT>. Elementary functions must be found by argument-dependent lookup: write `using
/// std::exp; return exp(x);`, since the standard library has no `std::exp(x)` for jets. If f has three template
/// parameters, or `auto`, for its arguments and `auto` for intermediate results, it computes only derivatives that can
/// be nonzero.
///
/// If a comparison in f has no unique result on a box, the bounds are the whole real line. If f does not support
/// Interval, exclude this type by a constraint; the model then has no bounds.
template <class Kernel, class Function>
class Analytic_function_traits_3 {
  static constexpr bool takes_intervals = internal::CallableWith<Function, Interval, Interval, Interval>;

public:
  using FT = typename Kernel::FT;             ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;   ///< points of the kernel
  using Vector_3 = typename Kernel::Vector_3; ///< vectors of the kernel
  static_assert(!CGAL::Algebraic_structure_traits<FT>::Is_exact::value,
                "this kernel has exact numbers, like Epeck: use a kernel with floating-point numbers, such as Epick or "
                "Simple_cartesian<double>");

  /// Algorithms search for the level set in `box`. f may be evaluated outside of it.
  Analytic_function_traits_3(Function function, const CGAL::Bbox_3& box) : function_(std::move(function)), box_(box) {}

  FT value(const Point_3& p) const { return function_(p.x(), p.y(), p.z()); } ///< f(x, y, z)
  /// The expansion of order 1, by automatic differentiation.
  Jet_3<FT, 1> first_order(const Point_3& p) const { return expand<1, FT>(function_, p.x(), p.y(), p.z()); }
  /// The expansion of order 4, by `f.taylor(x, y, z)` if it exists, otherwise by automatic differentiation.
  Jet_3<FT> taylor(const Point_3& p) const {
    if constexpr (internal::HasTaylor<Function, FT>) return function_.taylor(p.x(), p.y(), p.z());
    else return expand<4, FT>(function_, p.x(), p.y(), p.z());
  }

  /// The expansion of order 5, by automatic differentiation.
  Jet_3<FT, 5> fifth_order(const Point_3& p) const {
    using Jet = Jet_3<FT, 5>;
    return function_(Jet::variable(0, p.x()), Jet::variable(1, p.y()), Jet::variable(2, p.z()));
  }

  /// Sets values[i] to value(points[i]), by f(x, y, z, values) on spans if f supports it.
  void values(std::span<const Point_3> points, std::span<FT> values) const {
    internal::values_at<FT>(function_, points, values);
  }

  /// Sets jets[i] to first_order(points[i]), computed in packs unless a comparison differs between points.
  void first_orders(std::span<const Point_3> points, std::span<Jet_3<FT, 1>> jets) const {
    if constexpr (std::is_floating_point_v<FT>) {
      try {
        return internal::expand_points<1, FT>(function_, points, jets);
      } catch (const Lanes_disagree&) {
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i) jets[i] = first_order(points[i]);
  }

  /// Sets jets[i] to taylor(points[i]).
  void taylors(std::span<const Point_3> points, std::span<Jet_3<FT>> jets) const {
    for (std::size_t i = 0; i < points.size(); ++i) jets[i] = taylor(points[i]);
  }

  /// Sets jets[n] to the expansions at the points x[n], y[n], z[n], one per lane. Comparisons in f, such as x < y, must
  /// have the same result in all lanes of a pack. \throw Lanes_disagree if they differ
  void taylor_packs(std::span<const Pack<FT>> x, std::span<const Pack<FT>> y, std::span<const Pack<FT>> z,
                    std::span<Jet_3<Pack<FT>>> jets) const requires(std::is_floating_point_v<FT>) {
    if constexpr (internal::HasTaylor<Function, FT>) function_.taylor(x, y, z, jets);
    else
      for (std::size_t n = 0; n < jets.size(); ++n) jets[n] = expand<4, Pack<FT>>(function_, x[n], y[n], z[n]);
  }

  /// Bounds of the value on a box: f in interval arithmetic.
  Interval bounds(const CGAL::Bbox_3& box) const requires takes_intervals {
    const auto [x, y, z] = internal::sides_of(box);
    try {
      return function_(x, y, z);
    } catch (const Undecided_comparison&) {
      return Interval::whole();
    }
  }

  /// Bounds of value and gradient on a box: the expansion of order 1 in interval arithmetic.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const requires takes_intervals {
    return expansion_bounds<1>(box);
  }

  /// Bounds of the expansion of order 2 on a box, in interval arithmetic.
  Jet_3<Interval, 2> second_order_bounds(const CGAL::Bbox_3& box) const requires takes_intervals {
    return expansion_bounds<2>(box);
  }

  /// The model of f.restricted(x, y, z) for the sides of a box, if that is not empty.
  std::optional<Analytic_function_traits_3>
  restricted(const CGAL::Bbox_3& box) const requires internal::HasRestriction<Function> && std::is_same_v<FT, double> {
    const auto [x, y, z] = internal::sides_of(box);
    auto function = function_.restricted(x, y, z);
    if (!function) return std::nullopt;
    return Analytic_function_traits_3(*std::move(function), box_);
  }

  CGAL::Bbox_3 bbox() const { return box_; }             ///< the box passed to the constructor
  const Function& function() const { return function_; } ///< f

private:
  template <int Order>
  Jet_3<Interval, Order> expansion_bounds(const CGAL::Bbox_3& box) const {
    const auto [x, y, z] = internal::sides_of(box);
    try {
      return expand<Order, Interval>(function_, x, y, z);
    } catch (const Undecided_comparison&) {
      Jet_3<Interval, Order> jet;
      jet.coefficients().fill(Interval::whole());
      return jet;
    }
  }

  Function function_;
  CGAL::Bbox_3 box_;
};

/// Returns the model for `function`, deducing its type: `make_analytic_traits<Kernel>(f, box)`.
template <class Kernel, class Function>
Analytic_function_traits_3<Kernel, Function> make_analytic_traits(Function function, const CGAL::Bbox_3& box) {
  return {std::move(function), box};
}

} // namespace equiaffine

#endif
