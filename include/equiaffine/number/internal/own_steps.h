// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_NUMBER_INTERNAL_OWN_STEPS_H
#define EQUIAFFINE_NUMBER_INTERNAL_OWN_STEPS_H

#include <cmath>
#include <concepts>

namespace equiaffine::internal {

/// The types of numbers that have these functions, of their own or in the standard library.
namespace own_steps {

using std::erf, std::floor, std::fmod;

template <class T>
concept HasErf = requires(const T& a) {
  { erf(a) } -> std::convertible_to<T>;
};
template <class T>
concept HasFloor = requires(const T& a) {
  { floor(a) } -> std::convertible_to<T>;
};
template <class T>
concept HasFmod = requires(const T& a) {
  { fmod(a, a) } -> std::convertible_to<T>;
};

} // namespace own_steps

} // namespace equiaffine::internal

#endif
