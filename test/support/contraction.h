// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_CONTRACTION_H
#define EQUIAFFINE_TEST_SUPPORT_CONTRACTION_H

#include <gtest/gtest.h>

/// The error of the rounded square of x, if the compiler contracts the product and the difference.
[[gnu::noinline]] inline double error_of_square(double x, double rounded_square) { return x * x - rounded_square; }

/// Whether the compiler contracts products and sums to fused operations (-ffp-contract). If so, the same computation in
/// two places of the program can differ by rounding.
inline bool compiler_contracts() {
  const volatile double x = 1 + 0x1p-30;
  const volatile double rounded_square = x * x;
  return error_of_square(x, rounded_square) != 0;
}

/// Skips a test that compares packs with numbers bit for bit if the two differ by rounding.
#define SKIP_IF_THE_COMPILER_CONTRACTS()                                                                               \
  if (compiler_contracts()) GTEST_SKIP() << "packs and numbers are equal to within rounding only"

#endif
