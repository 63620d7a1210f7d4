// SPDX-License-Identifier: GPL-3.0-or-later
// The floating-point operations per point of the estimators, from 34 derivatives to the affine structure: Table 1 of
// Andrade, Lewiner 2012.
#ifndef EQUIAFFINE_TEST_SUPPORT_OPERATION_COUNTS_H
#define EQUIAFFINE_TEST_SUPPORT_OPERATION_COUNTS_H

#include "support/counting_number.h"
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/reference_estimators.h>

#include <random>

struct Operation_counts {
  long matrices, mapping, transformation; ///< the first two are parts of the third
  long direct, compact;
};

inline Operation_counts operation_counts() {
  using namespace equiaffine;
  std::mt19937 random(1);
  Jet_3<Counting_number> jet;
  for (Counting_number& c : jet.coefficients())
    c = Counting_number::variable(std::uniform_real_distribution<double>(-1, 1)(random));
  const auto f = internal::partial_derivatives(jet);
  const auto inverse = internal::Simplifying_map_3<Counting_number>(f).inverse;
  const auto count = [](auto estimate) {
    Counting_number::reset();
    estimate();
    return Counting_number::operations();
  };
  return {count([&] { internal::Simplifying_map_3<Counting_number>{f}; }),
          count([&] { internal::mapped_derivatives(f, inverse); }),
          count([&] { internal::transformation_estimate(jet); }), count([&] { internal::direct_estimate(jet, 2); }),
          count([&] { affine_invariants(Monge_chart_3(jet)); })};
}

#endif
