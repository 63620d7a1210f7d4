// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_EXPLAIN_MISUSE_H
#define EQUIAFFINE_FUNCTION_INTERNAL_EXPLAIN_MISUSE_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>

#include <CGAL/Bbox_3.h>

#include <concepts>

// A public function has an overload for what it does not take, whose body is one of these calls: the first line of the
// compiler says then what is missing, and not which candidates there are.
namespace equiaffine::internal {

/// Does not compile for a type that is no model of ImplicitFunctionTraits_3.
template <class Traits>
constexpr void explain_traits() {
  static_assert(
      requires {
        typename Traits::FT;
        typename Traits::Point_3;
        typename Traits::Vector_3;
      },
      "this function is no model of ImplicitFunctionTraits_3, since it has no types FT, Point_3 and Vector_3: "
      "make_analytic_traits() makes one of f(x, y, z), and sample_on_lattice() with Sampled_function_traits_3 one of "
      "f(p)");
  static_assert(
      requires(const Traits& t, const typename Traits::Point_3& p) {
        { t.value(p) } -> std::convertible_to<typename Traits::FT>;
      },
      "this function is no model of ImplicitFunctionTraits_3, since it has no member value(p) const that returns an "
      "FT");
  static_assert(
      requires(const Traits& t, const typename Traits::Point_3& p) {
        { t.taylor(p) } -> std::same_as<Jet_3<typename Traits::FT>>;
      },
      "this function is no model of ImplicitFunctionTraits_3, since it has no member taylor(p) const that returns a "
      "Jet_3<FT>: expand<4>() makes one of f(x, y, z)");
  static_assert(
      requires(const Traits& t) {
        { t.bbox() } -> std::convertible_to<CGAL::Bbox_3>;
      },
      "this function is no model of ImplicitFunctionTraits_3, since it has no member bbox() const that returns a "
      "CGAL::Bbox_3");
  static_assert(std::copy_constructible<Traits>,
                "this function is no model of ImplicitFunctionTraits_3, since it cannot be copied");
}

/// Does not compile unless all other arguments are named parameters.
template <class... Others>
constexpr void explain_parameters() {
  static_assert((Parameter_chain<Others> && ...),
                "an argument is no named parameter: write parameters::NAME(value), of equiaffine or of CGAL");
}

} // namespace equiaffine::internal

#endif
