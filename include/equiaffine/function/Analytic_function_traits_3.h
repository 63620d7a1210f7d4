// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_ANALYTIC_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_ANALYTIC_FUNCTION_TRAITS_3_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Pack.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

namespace equiaffine {

namespace internal {

/// The jets of the coordinates with the least support: 1 and the coordinate itself.
template <class FT, int Order, int Axis>
auto sparse_variable(const FT& value) {
  Jet_3<FT, Order, (Monomial_set(1) | Monomial_set(2) << Axis)> jet(value);
  jet.template at<1 + Axis>() = FT(1);
  return jet;
}

template <class Function, class X, class Y, class Z>
concept CallableWith = requires(const Function& f, const X& x, const Y& y, const Z& z) {
  f(x, y, z);
};

// With its checks of every operation a sanitizer would make one function of millions of lines.
#ifdef __SANITIZE_ADDRESS__
#define EQUIAFFINE_FLATTEN
#else
#define EQUIAFFINE_FLATTEN [[gnu::flatten]]
#endif

/// f(x, y, z) with everything inlined: what crosses a call goes through memory, which costs more than its arithmetic.
template <class Result, class Function, class X, class Y, class Z>
EQUIAFFINE_FLATTEN Result inlined_call(const Function& f, const X& x, const Y& y, const Z& z) {
  return f(x, y, z);
}

#undef EQUIAFFINE_FLATTEN

/// The expansion of f at (x, y, z): on sparse jets when f takes three arguments of different types, else on full ones.
template <int Order, class FT, class Function>
Jet_3<FT, Order> expand(const Function& f, const FT& x, const FT& y, const FT& z) {
  const auto sx = sparse_variable<FT, Order, 0>(x);
  const auto sy = sparse_variable<FT, Order, 1>(y);
  const auto sz = sparse_variable<FT, Order, 2>(z);
  using Jet = Jet_3<FT, Order>;
  if constexpr (CallableWith<Function, decltype(sx), decltype(sy), decltype(sz)>) {
    if constexpr (is_built_in<FT>) return inlined_call<Jet>(f, sx, sy, sz);
    else return f(sx, sy, sz);
  } else {
    static_assert(CallableWith<Function, Jet, Jet, Jet>,
                  "the function takes no jets: write it as a template of the type of its arguments, and call functions "
                  "as `using std::sin; sin(x)`");
    return f(Jet(sx), Jet(sy), Jet(sz));
  }
}

/// A function with an own way to its Taylor polynomials, for numbers and for spans of packs.
template <class Function, class FT>
concept HasTaylor = requires(const Function& f, const FT& x, std::span<const Pack<FT>> packs,
                             std::span<Jet_3<Pack<FT>>> jets) {
  { f.taylor(x, x, x) } -> std::same_as<Jet_3<FT>>;
  f.taylor(packs, packs, packs, jets);
};

} // namespace internal

/// Model of FirstOrderImplicitFunctionTraits_3 and, if the function takes Interval, of
/// FirstOrderBoundedImplicitFunctionTraits_3 for a function given as code: `f(x, y, z)`, templated on its number type,
/// const and callable from several threads.
///
///     struct Sphere {
///       template <class T> T operator()(const T& x, const T& y, const T& z) const { return x*x + y*y + z*z - 1.0; }
///     };
///     Analytic_function_traits_3<Kernel, Sphere> traits(Sphere(), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
///
/// It is called with FT, Interval, jets of both and, for batches in compute_attributes, jets of Pack<FT>. Elementary
/// functions must be found by argument-dependent lookup (`using std::exp; return exp(x);`). With three template
/// parameters, or `auto`, for the arguments and `auto` for intermediate results it computes only the derivatives that
/// its structure leaves nonzero.
template <class Kernel, class Function>
class Analytic_function_traits_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;

  /// `box` is where the level set is looked for, not a limit of f.
  Analytic_function_traits_3(Function function, const CGAL::Bbox_3& box) : function_(std::move(function)), box_(box) {}

  FT value(const Point_3& p) const { return function_(p.x(), p.y(), p.z()); }
  Jet_3<FT, 1> first_order(const Point_3& p) const { return internal::expand<1, FT>(function_, p.x(), p.y(), p.z()); }
  Jet_3<FT> taylor(const Point_3& p) const {
    if constexpr (internal::HasTaylor<Function, FT>) return function_.taylor(p.x(), p.y(), p.z());
    else return internal::expand<4, FT>(function_, p.x(), p.y(), p.z());
  }

  /// A function that asks whether x < y has to be answered alike in all lanes of a pack. \throw Lanes_disagree
  void taylor_packs(std::span<const Pack<FT>> x, std::span<const Pack<FT>> y, std::span<const Pack<FT>> z,
                    std::span<Jet_3<Pack<FT>>> jets) const requires(std::is_floating_point_v<FT>) {
    if constexpr (internal::HasTaylor<Function, FT>) function_.taylor(x, y, z, jets);
    else
      for (std::size_t n = 0; n < jets.size(); ++n)
        jets[n] = internal::expand<4, Pack<FT>>(function_, x[n], y[n], z[n]);
  }

  Interval bounds(const CGAL::Bbox_3& box) const {
    return function_(Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()),
                     Interval(box.zmin(), box.zmax()));
  }

  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    return internal::expand<1, Interval>(function_, Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()),
                                         Interval(box.zmin(), box.zmax()));
  }

  Jet_3<Interval, 2> second_order_bounds(const CGAL::Bbox_3& box) const {
    return internal::expand<2, Interval>(function_, Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()),
                                         Interval(box.zmin(), box.zmax()));
  }

  CGAL::Bbox_3 bbox() const { return box_; }
  const Function& function() const { return function_; }

private:
  Function function_;
  CGAL::Bbox_3 box_;
};

/// Deduces the type of the function: `make_analytic_traits<Kernel>(f, box)`.
template <class Kernel, class Function>
Analytic_function_traits_3<Kernel, Function> make_analytic_traits(Function function, const CGAL::Bbox_3& box) {
  return {std::move(function), box};
}

} // namespace equiaffine

#endif
