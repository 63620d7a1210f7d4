// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a model or a wrapper, used by conformance.h.
#ifndef EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_CHECKS_H
#define EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_CHECKS_H

#include "support/same_bits.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace conformance {

using equiaffine::Jet_3;

inline double evaluate(const Jet_3<double>& jet, double x, double y, double z) {
  double sum = 0;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      for (int k = 0; i + j + k <= 4; ++k)
        sum += jet.coefficient(i, j, k) * std::pow(x, i) * std::pow(y, j) * std::pow(z, k);
  return sum;
}

/// The maximum difference between f and its expansion in a set of directions at distance h, relative to the size of the
/// terms.
template <class Traits>
double remainder(const Traits& traits, const typename Traits::Point_3& p, double h) {
  static const std::array<std::array<double, 3>, 7> directions = {
      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {.6, -.64, .48}, {-.48, .6, .64}, {.64, .48, -.6}, {-.57, -.57, -.6}}};
  const auto jet = traits.taylor(p);
  double size = 0, worst = 0;
  for (int n = 0; n < 35; ++n)
    size += std::abs(jet.coefficients()[std::size_t(n)]) *
            std::pow(h, equiaffine::internal::monomials[std::size_t(n)].degree());
  for (const auto& d : directions) {
    const typename Traits::Point_3 q(p.x() + h * d[0], p.y() + h * d[1], p.z() + h * d[2]);
    const double predicted = evaluate(jet, q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    worst = std::max(worst, std::abs(traits.value(q) - predicted));
  }
  return worst / size;
}

/// The cube around p whose sides are 2 r.
template <class Point_3>
CGAL::Bbox_3 cube(const Point_3& p, double r) {
  return CGAL::Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
}

template <class Point_3>
Point_3 random_point_in_cube(const Point_3& p, double r, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return Point_3(p.x() + r * unit(random), p.y() + r * unit(random), p.z() + r * unit(random));
}

/// Expects the expansion at q, which is not rounded outward, to be in the bounds up to a relative error.
template <class Jet, class Bounds, class Point_3>
void expect_enclosed(const Jet& jet, const Bounds& bounds, double relative_error, const Point_3& q) {
  for (std::size_t c = 0; c < bounds.coefficients().size(); ++c) {
    const double rounding = relative_error * (1 + std::abs(jet.coefficients()[c]));
    EXPECT_GE(jet.coefficients()[c], bounds.coefficients()[c].lower() - rounding) << "coefficient " << c << " at " << q;
    EXPECT_LE(jet.coefficients()[c], bounds.coefficients()[c].upper() + rounding) << "coefficient " << c << " at " << q;
  }
}

/// Expects `bounds_on(traits, box)` to enclose values and gradients at points of the box, and to shrink with the box.
template <class Model, class Bounds>
void expect_bounds_of_first_order(const Bounds& bounds_on) {
  const auto traits = Model::make();
  std::mt19937 random(2);
  for (const auto& p : Model::points()) {
    std::array<double, 4> last_width;
    last_width.fill(std::numeric_limits<double>::infinity());
    for (double r = Model::length / 2; r > Model::length / 100; r /= 2) {
      const auto bounds = bounds_on(traits, cube(p, r));
      for (int n = 0; n < 50; ++n) {
        const auto q = random_point_in_cube(p, r, random);
        expect_enclosed(equiaffine::first_order(traits, q), bounds, 1e-13, q);
      }
      for (std::size_t c = 0; c < 4; ++c) {
        const double width = bounds.coefficients()[c].upper() - bounds.coefficients()[c].lower();
        EXPECT_LE(width, last_width[c]);
        last_width[c] = width;
      }
    }
    for (const double width : last_width) EXPECT_TRUE(std::isfinite(width));
  }
}

/// Whether a wrapper models all concepts that its base models, and has all capabilities of its base.
template <class Wrapper, class Base>
constexpr bool has_capabilities_of() {
  using namespace equiaffine;
  constexpr auto implies = [](bool base, bool wrapper) { return !base || wrapper; };
  return implies(BoundedImplicitFunctionTraits_3<Base>, BoundedImplicitFunctionTraits_3<Wrapper>) &&
         implies(FirstOrderBoundedImplicitFunctionTraits_3<Base>, FirstOrderBoundedImplicitFunctionTraits_3<Wrapper>) &&
         implies(FirstOrderImplicitFunctionTraits_3<Base>, FirstOrderImplicitFunctionTraits_3<Wrapper>) &&
         implies(BatchImplicitFunctionTraits_3<Base>, BatchImplicitFunctionTraits_3<Wrapper>) &&
         implies(FirstOrderBatchImplicitFunctionTraits_3<Base>, FirstOrderBatchImplicitFunctionTraits_3<Wrapper>) &&
         implies(HasSamplingLattice<Base>, HasSamplingLattice<Wrapper>) &&
         implies(HasTightFirstOrderBounds<Base>, HasTightFirstOrderBounds<Wrapper>) &&
         implies(HasFifthOrder<Base>, HasFifthOrder<Wrapper>) &&
         implies(HasKnownBounds<Base>, HasKnownBounds<Wrapper>) && implies(HasRounding<Base>, HasRounding<Wrapper>) &&
         implies(HasCertainty<Base>, HasCertainty<Wrapper>) &&
         implies(HasIntersectSegment<Base>, HasIntersectSegment<Wrapper>);
}

/// The same for the concepts and capabilities that type erasure does not keep.
template <class Wrapper, class Base>
constexpr bool has_refinements_of() {
  using namespace equiaffine;
  constexpr auto implies = [](bool base, bool wrapper) { return !base || wrapper; };
  return implies(SecondOrderBoundedImplicitFunctionTraits_3<Base>,
                 SecondOrderBoundedImplicitFunctionTraits_3<Wrapper>) &&
         implies(RestrictableImplicitFunctionTraits_3<Base>, RestrictableImplicitFunctionTraits_3<Wrapper>) &&
         implies(PackImplicitFunctionTraits_3<Base>, PackImplicitFunctionTraits_3<Wrapper>) &&
         implies(LatticeImplicitFunctionTraits_3<Base>, LatticeImplicitFunctionTraits_3<Wrapper>) &&
         implies(CellwiseImplicitFunctionTraits_3<Base>, CellwiseImplicitFunctionTraits_3<Wrapper>) &&
         implies(HasSamples<Base>, HasSamples<Wrapper>);
}

/// Expects the results of a wrapper at the image of a point to be those of the base at the point.
template <class Wrapper, class Base, class Point_3>
void expect_capabilities_of(const Wrapper& wrapper, const Point_3& image, const Base& base, const Point_3& p) {
  static_assert(has_capabilities_of<Wrapper, Base>());
  using namespace equiaffine;
  EXPECT_NEAR(certainty(wrapper, image), certainty(base, p), 1e-3);
  EXPECT_EQ(fifth_order(wrapper, image).has_value(), fifth_order(base, p).has_value());
  EXPECT_EQ(known_bounds(wrapper).have_gradients, known_bounds(base).have_gradients);
  EXPECT_EQ(known_bounds(wrapper).are_tight_in_small_boxes, known_bounds(base).are_tight_in_small_boxes);
}

/// Expects bounds to be equal up to the rounding of a shifted interval.
template <class Bounds>
void expect_equal_bounds(const Bounds& first, const Bounds& second) {
  const auto expect_equal = [](double x, double y) {
    if (x != y) {
      EXPECT_NEAR(x, y, 1e-14 * (1 + std::abs(x)));
    }
  };
  for (std::size_t c = 0; c < first.size; ++c) {
    expect_equal(first.coefficients()[c].lower(), second.coefficients()[c].lower());
    expect_equal(first.coefficients()[c].upper(), second.coefficients()[c].upper());
  }
}

/// Expects the results of a wrapper to be those of a model, bit for bit, at many points, on boxes, and on restrictions.
template <class Model, class Wrapper>
void expect_same_numbers(const Wrapper& wrapper) {
  using namespace equiaffine;
  using Traits = typename Model::Traits;
  const Traits base = Model::make();
  const Batch_function_traits_3 of_base(base);
  const Batch_function_traits_3 of_wrapper(wrapper);
  const auto points = Model::points();
  std::vector<double> values(points.size()), same_values(points.size());
  std::vector<Jet_3<double, 1>> lines(points.size()), same_lines(points.size());
  std::vector<Jet_3<double>> jets(points.size()), same_jets(points.size());
  of_base.values(points, values), of_wrapper.values(points, same_values);
  of_base.first_orders(points, lines), of_wrapper.first_orders(points, same_lines);
  of_base.taylors(points, jets), of_wrapper.taylors(points, same_jets);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(same_bits(same_values[i], values[i]));
    EXPECT_TRUE(same_bits(same_lines[i], lines[i]));
    EXPECT_TRUE(same_bits(same_jets[i], jets[i]));
    const CGAL::Bbox_3 box = cube(points[i], Model::length / 10);
    if constexpr (SecondOrderBoundedImplicitFunctionTraits_3<Wrapper>) {
      EXPECT_TRUE(same_bits(wrapper.second_order_bounds(box), base.second_order_bounds(box)));
    }
    if constexpr (LatticeImplicitFunctionTraits_3<Wrapper>) {
      EXPECT_TRUE(same_bits(wrapper.sample(i, i, i), base.sample(i, i, i)));
      std::array<double, 2> row;
      samples(wrapper, {i, i, i}, {2, 1, 1}, row);
      EXPECT_TRUE(same_bits(row[0], base.sample(i, i, i)) && same_bits(row[1], base.sample(i + 1, i, i)));
    }
    if constexpr (CellwiseImplicitFunctionTraits_3<Wrapper>) {
      const auto cell = wrapper.cell_of(points[i]);
      EXPECT_EQ(cell, base.cell_of(points[i]));
      const auto [x, y, z] = *cell;
      const auto part = wrapper.restricted_to_cells({{x, y, z}, {x + 1, y + 1, z + 1}});
      for (const auto& p : points) EXPECT_TRUE(same_bits(part.taylor(p), base.taylor(p)));
    }
    if constexpr (RestrictableImplicitFunctionTraits_3<Wrapper>) {
      const auto part = wrapper.restricted(box);
      EXPECT_EQ(part.has_value(), base.restricted(box).has_value());
      if (part) {
        EXPECT_TRUE(same_bits(double(part->value(points[i])), double(base.value(points[i]))));
      }
    }
  }
}

/// A pair of points of a model at which f has different signs, or nothing.
template <class Model>
std::optional<std::array<typename Model::Traits::Point_3, 2>> segment_with_zero() {
  const auto traits = Model::make();
  const auto points = Model::points();
  for (const auto& q : points)
    if (equiaffine::is_sign_change(traits.value(points[0]), traits.value(q))) return {{points[0], q}};
  return std::nullopt;
}

} // namespace conformance

#endif
