// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_EXPANDED_BLOCK_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_EXPANDED_BLOCK_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Pack.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace equiaffine::internal {

/// The expansions of f at a block of points, and the errors of its second derivatives there. Point i is lane
/// i % Lanes::size of pack i / Lanes::size; copies of the last point fill up the last pack.
template <class Pack_of_numbers>
struct Expanded_block_of {
  using Lanes = Pack_of_numbers;
  static constexpr std::size_t packs = 8, points = packs * Lanes::size;

  std::size_t number_of_points;
  std::array<Lanes, packs> x, y, z, roundings;
  std::array<Jet_3<Lanes>, packs> jets;
  bool has_roundings; ///< if false, second derivatives are exact up to roundings of their own size

  std::size_t number_of_packs() const { return (number_of_points + Lanes::size - 1) / Lanes::size; }

  std::array<Lanes, 3> points_of_pack(std::size_t n) const { return {x[n], y[n], z[n]}; }

  std::optional<Lanes> rounding_of_pack(std::size_t n) const {
    if (has_roundings) return roundings[n];
    return std::nullopt;
  }

  std::array<double, 3> point(std::size_t i) const { return {lane(x, i), lane(y, i), lane(z, i)}; }

  double rounding(std::size_t i) const { return has_roundings ? lane(roundings, i) : 0; }

  Jet_3<double> jet(std::size_t i) const {
    Jet_3<double> result;
    for (std::size_t n = 0; n < result.size; ++n)
      result.coefficients()[n] = jets[i / Lanes::size].coefficients()[n][i % Lanes::size];
    return result;
  }

private:
  static double lane(const std::array<Lanes, packs>& numbers, std::size_t i) {
    return numbers[i / Lanes::size][i % Lanes::size];
  }
};

/// Translation units for different processors have different packs, and so do the types of their blocks.
using Expanded_block = Expanded_block_of<Pack<double>>;

/// Sets the jets by the model's own taylor_packs(). Returns false if the model has no such member, or if the function
/// branches differently in the lanes of a pack.
template <class Traits>
bool expand_in_packs(const Traits& traits, Expanded_block& block) {
  if constexpr (PackImplicitFunctionTraits_3<Traits>) {
    const auto used = [&](auto& array) { return std::span(array).first(block.number_of_packs()); };
    try {
      traits.taylor_packs(used(std::as_const(block.x)), used(std::as_const(block.y)), used(std::as_const(block.z)),
                          used(block.jets));
      return true;
    } catch (const Lanes_disagree&) {
    }
  }
  return false;
}

template <class Traits>
void expand_one_by_one(const Traits& traits, std::span<const typename Traits::Point_3> points, Expanded_block& block) {
  using Lanes = Pack<double>;
  std::array<Jet_3<double>, Expanded_block::points> singles;
  for (std::size_t i = 0; i < points.size(); ++i) singles[i] = traits.taylor(points[i]);
  for (std::size_t n = 0; n < block.number_of_packs(); ++n)
    for (std::size_t c = 0; c < Jet_3<double>::size; ++c)
      block.jets[n].coefficients()[c] = Lanes::generate(
          [&](std::size_t i) { return singles[std::min(n * Lanes::size + i, points.size() - 1)].coefficients()[c]; });
}

/// Expands f at up to Expanded_block::points points.
template <class Traits>
Expanded_block expand_block(const Traits& traits, std::span<const typename Traits::Point_3> points) {
  using Lanes = Pack<double>;
  Expanded_block block;
  block.number_of_points = points.size();
  block.has_roundings = HasRounding<Traits>;
  for (std::size_t n = 0; n < block.number_of_packs(); ++n) {
    const auto pack_of = [&](auto f) {
      return Lanes::generate(
          [&](std::size_t i) { return f(points[std::min(n * Lanes::size + i, points.size() - 1)]); });
    };
    block.x[n] = pack_of([](const auto& p) { return p.x(); });
    block.y[n] = pack_of([](const auto& p) { return p.y(); });
    block.z[n] = pack_of([](const auto& p) { return p.z(); });
    if constexpr (HasRounding<Traits>) block.roundings[n] = pack_of([&](const auto& p) { return rounding(traits, p); });
  }
  if (!expand_in_packs(traits, block)) expand_one_by_one(traits, points, block);
  return block;
}

} // namespace equiaffine::internal

#endif
