// SPDX-License-Identifier: GPL-3.0-or-later
// Refuses flags of the compiler under which the library does not compile, or computes something else. Whatever else a
// header needs, it includes this one, if only by way of others.
#ifndef EQUIAFFINE_BASE_INTERNAL_CHECK_FLAGS_H
#define EQUIAFFINE_BASE_INTERNAL_CHECK_FLAGS_H

#if __cplusplus < 202002L
#error "equiaffine needs C++20: compile with -std=c++20 or a later standard"
#endif
// A NaN says where a function has no value, an infinite bound what intervals do not know, and error bounds count on the
// order of roundings.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || __FINITE_MATH_ONLY__
#error                                                                                                                 \
    "equiaffine needs NaN, infinity and the order of roundings: compile without -ffast-math, -Ofast, -ffinite-math-only and -fassociative-math"
#endif

#endif
