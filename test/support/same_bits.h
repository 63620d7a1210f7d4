// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_SAME_BITS_H
#define EQUIAFFINE_TEST_SUPPORT_SAME_BITS_H

#include <cstring>

/// Whether two numbers or expansions have the same bits, including NaN and signs of zeros.
template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

#endif
