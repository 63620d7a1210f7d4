// SPDX-License-Identifier: GPL-3.0-or-later
// A number that counts floating-point operations: additions, multiplications, divisions and calls of functions, one
// each. Comparisons, absolute values, negations, and operations on constants are not counted.
#ifndef EQUIAFFINE_TEST_SUPPORT_COUNTING_NUMBER_H
#define EQUIAFFINE_TEST_SUPPORT_COUNTING_NUMBER_H

#include <cmath>
#include <limits>

struct Counting_number {
  double value = 0;
  bool is_constant = true;

  static inline long additions = 0, multiplications = 0, divisions = 0, functions = 0;
  static void reset() { additions = multiplications = divisions = functions = 0; }
  static long operations() { return additions + multiplications + divisions + functions; }

  Counting_number() = default;
  Counting_number(double x) : value(x) {}
  static Counting_number variable(double x) { return {x, false}; }

  Counting_number operator-() const { return {-value, is_constant}; }
  friend Counting_number operator+(Counting_number a, Counting_number b) {
    return counted(additions, a, b, a.value + b.value);
  }
  friend Counting_number operator-(Counting_number a, Counting_number b) {
    return counted(additions, a, b, a.value - b.value);
  }
  friend Counting_number operator*(Counting_number a, Counting_number b) {
    return counted(multiplications, a, b, a.value * b.value);
  }
  friend Counting_number operator/(Counting_number a, Counting_number b) {
    return counted(divisions, a, b, a.value / b.value);
  }
  Counting_number& operator+=(Counting_number b) { return *this = *this + b; }
  Counting_number& operator-=(Counting_number b) { return *this = *this - b; }
  Counting_number& operator*=(Counting_number b) { return *this = *this * b; }

  friend bool operator==(Counting_number a, Counting_number b) { return a.value == b.value; }
  friend bool operator<(Counting_number a, Counting_number b) { return a.value < b.value; }
  friend bool operator>(Counting_number a, Counting_number b) { return a.value > b.value; }
  friend bool operator<=(Counting_number a, Counting_number b) { return a.value <= b.value; }
  friend bool operator>=(Counting_number a, Counting_number b) { return a.value >= b.value; }

  friend Counting_number abs(Counting_number a) { return {std::abs(a.value), a.is_constant}; }
  friend Counting_number sqrt(Counting_number a) { return counted(functions, a, a, std::sqrt(a.value)); }
  friend Counting_number sin(Counting_number a) { return counted(functions, a, a, std::sin(a.value)); }
  friend Counting_number cos(Counting_number a) { return counted(functions, a, a, std::cos(a.value)); }
  friend Counting_number atan2(Counting_number a, Counting_number b) {
    return counted(functions, a, b, std::atan2(a.value, b.value));
  }

private:
  Counting_number(double x, bool constant) : value(x), is_constant(constant) {}

  static Counting_number counted(long& counter, Counting_number a, Counting_number b, double result) {
    const bool constant = a.is_constant && b.is_constant;
    counter += constant ? 0 : 1;
    return {result, constant};
  }
};

template <>
struct std::numeric_limits<Counting_number> : std::numeric_limits<double> {};

#endif
