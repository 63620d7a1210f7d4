// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_EXPAND_H
#define EQUIAFFINE_FUNCTION_EXPAND_H

#include <equiaffine/function/internal/expand.h>
#include <equiaffine/number/Jet_3.h>

namespace equiaffine {

/// The Taylor expansion of a functor f at (x, y, z), by automatic differentiation: a polynomial in the distances from
/// x, y and z whose total order is 1 to 5. The functor is a template of the types of its three arguments, which is
/// faster, or of one type, and calls functions as `using std::sin; sin(x)`. FT may be a Pack, of which each lane is a
/// point of its own; then f may throw Lanes_disagree.
template <int Order, class FT, class Function>
Jet_3<FT, Order> expand(const Function& f, const FT& x, const FT& y, const FT& z) {
  const auto sx = internal::sparse_variable<FT, Order, 0>(x);
  const auto sy = internal::sparse_variable<FT, Order, 1>(y);
  const auto sz = internal::sparse_variable<FT, Order, 2>(z);
  using Jet = Jet_3<FT, Order>;
  if constexpr (internal::CallableWith<Function, decltype(sx), decltype(sy), decltype(sz)>) {
    if constexpr (is_built_in<FT>) return internal::inlined_call<Jet>(f, sx, sy, sz);
    else return f(sx, sy, sz);
  } else {
    static_assert(internal::CallableWith<Function, Jet, Jet, Jet>,
                  "the function takes no jets: write it as a template of the type of its arguments, and call functions "
                  "as `using std::sin; sin(x)`");
    return f(Jet(sx), Jet(sy), Jet(sz));
  }
}

} // namespace equiaffine

#endif
