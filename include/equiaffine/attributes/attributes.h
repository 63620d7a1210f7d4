// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H
#define EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/base/parallel_for.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/rounding.h>
#include <equiaffine/geometry/affine_gradients.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/number/Pack.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

namespace internal {

/// By the estimator of the named parameters. Without it the paper's ones are not even compiled.
template <class Parameters, class FT>
Local_structure_3<FT> local_structure_by(const Parameters& parameters, const Jet_3<FT>& jet,
                                         const std::array<FT, 3>& point, const FT& rounding) {
  if constexpr (has_parameter<Estimator_tag, Parameters>)
    return local_structure(jet, point, rounding, get_parameter<Estimator_tag>(parameters, Estimator::COMPACT));
  else return local_structure(jet, point, rounding);
}

} // namespace internal

/// The local structure of the level set of f through p. `sampled_status` is what the sampler says of p: a point that is
/// UNCONVERGED stays so, with the numbers that exist, unless it is OUTSIDE. Named parameter: `estimator`.
template <ImplicitFunctionTraits_3 Traits, class Parameters = internal::No_parameters>
Local_structure_3<typename Traits::FT> local_structure_at(const Traits& traits, const typename Traits::Point_3& p,
                                                          Point_status sampled_status = Point_status::REGULAR,
                                                          const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Estimator_tag>();
  const std::array<typename Traits::FT, 3> point = {p.x(), p.y(), p.z()};
  auto structure = internal::local_structure_by(parameters, traits.taylor(p), point, internal::rounding(traits, p));
  if (sampled_status == Point_status::UNCONVERGED && structure.status != Point_status::OUTSIDE)
    structure.status = Point_status::UNCONVERGED;
  return structure;
}

namespace internal {

template <class FT>
Jet_3<FT> lane(const Jet_3<Pack<FT>>& jet, std::size_t i) {
  Jet_3<FT> result;
  for (std::size_t n = 0; n < result.size; ++n) result.coefficients()[n] = jet.coefficients()[n][i];
  return result;
}

/// f(i) for the lanes of pack n; the last point stands for those that are missing.
template <class Point_3, class F>
Pack<double> pack_of(std::span<const Point_3> points, std::size_t n, F f) {
  return Pack<double>::generate(
      [&](std::size_t i) { return f(points[std::min(n * Pack<double>::size + i, points.size() - 1)]); });
}

inline constexpr std::size_t packs_per_block = 8, points_per_block = packs_per_block * Pack<double>::size;
using Block_of_jets = std::array<Jet_3<Pack<double>>, packs_per_block>;

/// The expansions at up to points_per_block points: from the model's own packs if it has them and its function does not
/// branch differently there, else one by one.
template <class Traits, class Point_3 = typename Traits::Point_3>
void expand_block(const Traits& traits, std::span<const Point_3> points, std::span<Jet_3<Pack<double>>> jets) {
  if constexpr (PackImplicitFunctionTraits_3<Traits>) {
    std::array<Pack<double>, packs_per_block> x, y, z;
    for (std::size_t n = 0; n < jets.size(); ++n) {
      x[n] = pack_of(points, n, [](const Point_3& p) { return p.x(); });
      y[n] = pack_of(points, n, [](const Point_3& p) { return p.y(); });
      z[n] = pack_of(points, n, [](const Point_3& p) { return p.z(); });
    }
    try {
      const auto used = [&](const auto& axis) { return std::span<const Pack<double>>(axis.data(), jets.size()); };
      return traits.taylor_packs(used(x), used(y), used(z), jets);
    } catch (const Lanes_disagree&) {
    }
  }
  std::array<Jet_3<double>, points_per_block> singles;
  for (std::size_t i = 0; i < points.size(); ++i) singles[i] = traits.taylor(points[i]);
  const std::span<const Jet_3<double>> used(singles.data(), points.size());
  for (std::size_t n = 0; n < jets.size(); ++n)
    for (std::size_t c = 0; c < Jet_3<double>::size; ++c)
      jets[n].coefficients()[c] = pack_of(used, n, [&](const Jet_3<double>& jet) { return jet.coefficients()[c]; });
}

/// What is to be computed, with the functions that take it from packs.
template <class Parameters>
struct Attribute_columns {
  const std::vector<Attribute>& singles;
  std::vector<Attribute_of<Pack<double>>> packs;
  std::array<std::optional<std::size_t>, 3> gradients; // their columns
  const Parameters& parameters;

  Attribute_columns(const Attribute_selection& selection, const Parameters& named)
      : singles(selection.columns), parameters(named) {
    constexpr const auto& table = all_attributes_of<Pack<double>>;
    for (const Attribute& single : singles) {
      for (std::size_t n = 0; n < gradients.size(); ++n)
        if (single.name == gradient_names[n]) gradients[n] = packs.size();
      packs.push_back(*std::find_if(table.begin(), table.end(), [&](const auto& a) { return a.name == single.name; }));
    }
  }

  bool has_gradients() const { return gradients[0] || gradients[1] || gradients[2]; }
};

/// Fills the rows from `first` on, one per point, of which there are at most points_per_block. Lanes that are not
/// regular are done again as single points, where the reason is found.
template <class Traits, class Parameters>
void compute_block_of_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                 std::size_t first, const Attribute_columns<Parameters>& columns,
                                 Vertex_attributes& result) {
  using Lanes = Pack<double>;
  const bool is_compact = get_parameter<Estimator_tag>(columns.parameters, Estimator::COMPACT) == Estimator::COMPACT;
  Block_of_jets block;
  const std::span jets(block.data(), (points.size() + Lanes::size - 1) / Lanes::size);
  expand_block(traits, points, jets);
  for (std::size_t n = 0; n < jets.size(); ++n) {
    const std::array<Lanes, 3> coordinates = {pack_of(points, n, [](const auto& p) { return p.x(); }),
                                              pack_of(points, n, [](const auto& p) { return p.y(); }),
                                              pack_of(points, n, [](const auto& p) { return p.z(); })};
    const Lanes roundings = pack_of(points, n, [&](const auto& p) { return rounding(traits, p); });
    Monge_chart_3<Lanes> chart(jets[n]);
    chart.disregard_rounding_of(coordinates, jets[n]);
    if constexpr (Has_rounding<Traits>) chart.disregard(jets[n], roundings);
    const Local_structure_lanes<Lanes> lanes(jets[n], chart);
    const std::size_t row = first + n * Lanes::size, count = std::min(Lanes::size, first + points.size() - row);
    for (std::size_t c = 0; c < columns.packs.size(); ++c) {
      const Lanes values = columns.packs[c].get(lanes.structure);
      for (std::size_t i = 0; i < count; ++i) result.columns[c].values[row + i] = values[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
      Point_status& status = (*result.status)[row + i];
      status = Point_status::REGULAR;
      if (lanes.is_regular[i] && is_compact) continue;
      const std::array<double, 3> point = {coordinates[0][i], coordinates[1][i], coordinates[2][i]};
      const auto structure = local_structure_by(columns.parameters, lane(jets[n], i), point, double(roundings[i]));
      for (std::size_t c = 0; c < columns.singles.size(); ++c)
        result.columns[c].values[row + i] = columns.singles[c].get(structure);
      status = structure.status;
    }
  }
  for (std::size_t i = 0; i < points.size() && columns.has_gradients(); ++i) {
    const auto norms = affine_gradient_norms(traits, points[i]);
    for (std::size_t n = 0; n < norms.size(); ++n)
      if (columns.gradients[n]) result.columns[*columns.gradients[n]].values[first + i] = norms[n];
  }
}

} // namespace internal

/// Attributes of points, one column per scalar, in double. One Taylor expansion of order 4 per point, 41 with a norm of
/// a gradient; the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Points are taken in packs; the
/// numbers are those of local_structure_at: bit for bit where the compiler rounds each product and each sum
/// (-ffp-contract=off), else to within rounding.
/// `sampled_status` is empty or has one entry per point. Named parameter: `estimator`.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class Parameters = internal::No_parameters>
Vertex_attributes compute_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                     const Attribute_selection& selection,
                                     std::span<const Point_status> sampled_status = {},
                                     const Parameters& parameters = {}) {
  static_assert(std::is_same_v<typename Traits::FT, double>);
  internal::check_parameters<Parameters, internal::Estimator_tag>();
  const internal::Attribute_columns<Parameters> columns(selection, parameters);
  Vertex_attributes result;
  for (const Attribute& attribute : selection.columns)
    result.columns.push_back({std::string(attribute.name), std::vector<double>(points.size())});
  if (selection.columns.empty() && !selection.has_status) return result;
  std::vector<Point_status>& status = result.status.emplace(points.size());
  constexpr std::size_t block = internal::points_per_block;
  internal::parallel_for<ConcurrencyTag>(
      0, (points.size() + block - 1) / block,
      [&](std::size_t n) {
        const std::size_t first = n * block, count = std::min(block, points.size() - first);
        internal::compute_block_of_attributes(traits, points.subspan(first, count), first, columns, result);
        for (std::size_t i = first; i < first + count && !sampled_status.empty(); ++i)
          if (sampled_status[i] == Point_status::UNCONVERGED && status[i] != Point_status::OUTSIDE)
            status[i] = Point_status::UNCONVERGED;
      },
      256 / block);
  if (!selection.has_status) result.status.reset();
  return result;
}

} // namespace equiaffine

#endif
