// SPDX-License-Identifier: GPL-3.0-or-later
// All 35 Taylor coefficients up to order 4 of five functions by jets, for single points and packs, compared with
// hand-derived code, Boost.Math autodiff and ADOL-C.
#include "hand_derived.h"
#include "runner.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/number/Pack.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#ifdef EQUIAFFINE_HAS_ADOLC
#include <adolc/adolc.h>
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using namespace benchmark_runner;
using Lanes = Pack<double>;
using Jet = Jet_3<double>;
using Array = std::array<double, 35>;

constexpr std::size_t number_of_points = 64; // with their results they stay in the first two levels of cache
constexpr std::size_t repetitions = 64;

struct Points {
  std::array<std::array<double, number_of_points>, 3> c;

  Points() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.1, 0.9);
    for (auto& axis : c)
      for (double& v : axis) v = unit(random);
  }
};

/// The largest error of a fourth derivative, relative to the largest fourth derivative, over the points.
template <class Function>
double fourth_order_error(const Function& f, const Points& p) {
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
  double worst = 0;
  for (std::size_t i = 0; i < number_of_points; ++i) {
    const Jet jet = expand<4, double>(f, p.c[0][i], p.c[1][i], p.c[2][i]);
    const auto exact = expand<4, Number>(f, Number(p.c[0][i]), Number(p.c[1][i]), Number(p.c[2][i]));
    double error = 0, size = 0;
    for (int a = 0; a <= 4; ++a)
      for (int b = 0; a + b <= 4; ++b) {
        const Number d = exact.derivative(a, b, 4 - a - b);
        error = std::max(error, std::abs(double(Number(jet.derivative(a, b, 4 - a - b)) - d)));
        size = std::max(size, std::abs(double(d)));
      }
    if (size > 0) worst = std::max(worst, error / size);
  }
  return worst / std::numeric_limits<double>::epsilon();
}

template <class F>
Contender contender(const std::string& name, std::size_t times, std::size_t step, F at_point) {
  return {name,
          [=] {
            for (std::size_t n = 0; n < times; ++n)
              for (std::size_t i = 0; i < number_of_points; i += step) at_point(i);
          },
          double(times * number_of_points)};
}

#ifdef EQUIAFFINE_HAS_ADOLC
/// Forward mode in the 15 directions from which fourth derivatives can be interpolated, without the interpolation.
class Adolc {
public:
  template <class Function>
  Adolc(short tape, const Function& f) : tape_(tape), in_(myalloc3(3, 15, 4)), out_(myalloc3(1, 15, 4)) {
    trace_on(tape_);
    adouble x, y, z;
    x <<= 0.5;
    y <<= 0.6;
    z <<= 0.7;
    adouble result = f(x, y, z);
    double value;
    result >>= value;
    trace_off();
    std::size_t ray = 0;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j, ++ray)
        for (int axis = 0; axis < 3; ++axis)
          for (int degree = 0; degree < 4; ++degree)
            in_[axis][ray][degree] = degree > 0 ? 0 : axis == 0 ? i : axis == 1 ? j : 4 - i - j;
  }

  void operator()(const double* point) const {
    double value;
    hov_forward(tape_, 1, 3, 4, 15, const_cast<double*>(point), in_, &value, out_);
    keep(out_[0][0][0]);
  }

private:
  short tape_;
  double*** in_;
  double*** out_;
};
#endif

struct Case {
  std::string name, expression;
  bool is_algebraic;
};

/// The figures of one function. The contenders are in the order of `compare`.
void report(const Case& c, const std::vector<Contender>& contenders) {
  const double jets = contenders[0].nanoseconds, packs = contenders[2].nanoseconds;
  const std::string prefix = "jets_" + c.name;
  figure(prefix + "_to_hand", jets / contenders[1].nanoseconds, "x", c.is_algebraic ? "<=1.15" : "<=1.5");
  double best_peer = std::numeric_limits<double>::infinity();
  for (std::size_t n = 4; n < contenders.size(); ++n) best_peer = std::min(best_peer, contenders[n].nanoseconds);
  if (contenders.size() > 4) figure(prefix + "_best_peer_to_jets", best_peer / jets, "x", ">=8");
  if (!c.is_algebraic) figure(prefix + "_scalar_to_packs", jets / packs, "x", Lanes::size >= 8 ? ">=4" : ">=2.2");
  figure(prefix + "_expression_to_functor", contenders[3].nanoseconds / packs, "x", "<=3");
}

/// The maximum difference between the coefficients of two contenders, which should agree.
double difference(const std::array<Jet, number_of_points>& jets, const std::array<Array, number_of_points>& arrays) {
  double largest = 0;
  for (std::size_t i = 0; i < number_of_points; ++i)
    for (std::size_t n = 0; n < 35; ++n)
      largest = std::max(largest, std::abs(jets[i].coefficients()[n] - arrays[i][n]) / (1 + std::abs(arrays[i][n])));
  return largest;
}

template <class Function, class Hand, class Plain>
void compare(const Case& c, const Function& f, const Hand& hand, [[maybe_unused]] const Plain& plain,
             [[maybe_unused]] short tape) {
  const Points p;
  static std::array<Jet, number_of_points> out;
  static std::array<Array, number_of_points> hand_out;
  static std::array<Jet_3<Lanes>, number_of_points> pack_out;
  const Expression_3 expression(c.expression);
  std::vector<Contender> contenders;
  contenders.push_back(contender("jets", repetitions, 1, [&](std::size_t i) {
    ::new (&out[i]) Jet(expand<4, double>(f, p.c[0][i], p.c[1][i], p.c[2][i])); // without a copy
    keep(out[i]);
  }));
  contenders.push_back(contender("hand-derived", repetitions, 1, [&](std::size_t i) {
    hand(p.c[0][i], p.c[1][i], p.c[2][i], hand_out[i]);
    keep(hand_out[i]);
  }));
  const auto lanes = [](const std::array<double, number_of_points>& axis, std::size_t i) {
    return Lanes::generate([&](std::size_t lane) { return axis[i + lane]; });
  };
  contenders.push_back(contender("jets in packs", repetitions, Lanes::size, [&](std::size_t i) {
    ::new (&pack_out[i])
        Jet_3<Lanes>(expand<4, Lanes>(f, lanes(p.c[0], i), lanes(p.c[1], i), lanes(p.c[2], i)));
    keep(pack_out[i]);
  }));
  std::array<std::vector<Lanes>, 3> packs_of_points;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < number_of_points; i += Lanes::size)
      packs_of_points[axis].push_back(lanes(p.c[axis], i));
  const std::span<const Lanes> x(packs_of_points[0]), y(packs_of_points[1]), z(packs_of_points[2]);
  contenders.push_back(contender("expression, jets in packs", repetitions, number_of_points, [&](std::size_t) {
    expression.taylor(x, y, z, std::span(pack_out).first(x.size()));
    keep(pack_out);
  }));
  if constexpr (!std::is_same_v<Function, analytic_functions::Metaballs>)
    contenders.push_back(contender("Boost.Math autodiff", 1, 1, [&](std::size_t i) {
      const auto v = boost::math::differentiation::make_ftuple<double, 4, 4, 4>(p.c[0][i], p.c[1][i], p.c[2][i]);
      keep(f(std::get<0>(v), std::get<1>(v), std::get<2>(v)));
    }));
#ifdef EQUIAFFINE_HAS_ADOLC
  const Adolc adolc(tape, plain);
  contenders.push_back(contender("ADOL-C, 15 rays", 1, 1, [&](std::size_t i) {
    const std::array<double, 3> point = {p.c[0][i], p.c[1][i], p.c[2][i]};
    adolc(point.data());
  }));
#endif
  std::printf("%s, per point, %zu lanes\n", c.name.c_str(), Lanes::size);
  race(contenders, 101);
  report(c, contenders);
  figure("jets_" + c.name + "_fourth_derivative_error", fourth_order_error(f, p), "eps", "<=5");
  std::printf("  largest difference to hand-derived code: %.1e\n", difference(out, hand_out));
}

} // namespace

int main() {
#ifndef EQUIAFFINE_HAS_ADOLC
  std::printf("ADOL-C is skipped; install Debian's libadolc-dev\n");
#endif
  namespace af = analytic_functions;
  const auto sphere = [](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z - 1.0; };
  const auto blobby = [](const auto& x, const auto& y, const auto& z) {
    return 81.0 * (x * x * x * x + y * y * y * y + z * z * z * z) - 45.0 * (x * x + y * y + z * z) + 6.0;
  };
  const auto sine = [](const auto& x, const auto& y, const auto& z) {
    return 2.0 * z * z - sin(5.0 * x + 3.0 * y * y - 1.0);
  };
  const auto torus = [](const auto& x, const auto& y, const auto& z) {
    return x * x + y * y - sqrt(x * x + y * y) + 0.25 + z * z - 0.04;
  };
  const auto metaballs = [](const auto& x, const auto& y, const auto& z) {
    std::decay_t<decltype(x)> sum = 0.4;
    for (const auto& c : af::Metaballs().centers)
      sum -= exp(-4.0 * ((x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]) + (z - c[2]) * (z - c[2])));
    return sum;
  };
  std::string balls = "0.4";
  for (const auto& c : af::Metaballs().centers)
    balls += " - exp(-4*((x-(" + std::to_string(c[0]) + "))^2+(y-(" + std::to_string(c[1]) + "))^2+(z-(" +
             std::to_string(c[2]) + "))^2))";
  compare(
      {"sphere", "x^2+y^2+z^2-1", true}, af::Sphere(),
      [](double x, double y, double z, Array& c) { hand_derived::sphere(x, y, z, c); }, sphere, 1);
  compare(
      {"blobby", "81*(x^2)^2-45*x^2+81*(y^2)^2-45*y^2+81*(z^2)^2-45*z^2+6", true}, af::Blobby(),
      [](double x, double y, double z, Array& c) { hand_derived::blobby(x, y, z, c); }, blobby, 2);
  compare(
      {"sine", "2*z^2-sin(5*x+3*y^2-1)", true}, af::Sine_surface(),
      [](double x, double y, double z, Array& c) { hand_derived::sine(x, y, z, c); }, sine, 3);
  compare(
      {"torus", "(sqrt(x^2+y^2)-0.5)^2+z^2-0.04", true}, af::Torus(),
      [](double x, double y, double z, Array& c) { hand_derived::torus(x, y, z, c); }, torus, 4);
  compare(
      {"metaballs", balls, false}, af::Metaballs(),
      [](double x, double y, double z, Array& c) { hand_derived::metaballs(x, y, z, c); }, metaballs, 5);
}
