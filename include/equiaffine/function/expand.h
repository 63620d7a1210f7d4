// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_EXPAND_H
#define EQUIAFFINE_FUNCTION_EXPAND_H

#include <equiaffine/function/internal/expand.h>
#include <equiaffine/number/Jet_3.h>

namespace equiaffine {

/// The Taylor expansion of a functor f at (x, y, z), by automatic differentiation: a polynomial in the distances from x, y
/// and z whose total order is 1 to 4. The functor is a template of the types of its three arguments, or of one type, and
/// calls functions as `using std::sin; sin(x)`. FT may be a Pack, of which each lane is a point of its own; then f may
/// throw Lanes_disagree.
template <int Order, class FT, class Function>
Jet_3<FT, Order> expand(const Function& f, const FT& x, const FT& y, const FT& z) {
  return internal::expand<Order, FT>(f, x, y, z);
}

} // namespace equiaffine

#endif
