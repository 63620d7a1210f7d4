// SPDX-License-Identifier: GPL-3.0-or-later
// The local structure at points of level sets, as structures or as named columns of numbers.
#ifndef EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H
#define EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/number/Pack.h>
#include <equiaffine/surface/internal/affine_gradients.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Columns of attributes are computed block by block: f is expanded at the points of a block, and their attributes
// are computed in packs. Points that are not regular are computed again one by one.
namespace equiaffine::internal {

/// The expansions of f at a block of points, and the errors of its second derivatives. Point i is lane i %
/// Lanes::size of pack i / Lanes::size; copies of the last point fill up the last pack.
template <class Pack_of_numbers>
struct Expanded_block_of {
  using Lanes = Pack_of_numbers;
  static constexpr std::size_t packs = 8, points = packs * Lanes::size;

  std::size_t number_of_points;
  std::array<Lanes, packs> x, y, z, roundings;
  std::array<Jet_3<Lanes>, packs> jets;
  bool has_roundings; ///< if false, second derivatives are exact up to rounding of their own size

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

/// The alias differs between translation units for different processors, which have different packs.
using Expanded_block = Expanded_block_of<Pack<double>>;

/// Sets the jets with the model's own taylor_packs(). Returns false if the model has no such member, or if the
/// function branches differently in the lanes of a pack.
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

/// The rows of the result for the points of one block.
struct Attribute_rows {
  const std::vector<Attribute>& attributes;
  std::vector<Vertex_attributes::Column>& columns; ///< one per attribute
  std::vector<Point_status>& statuses;
  std::span<const double> areas;        ///< of vertices of a mesh, or empty
  std::span<const std::size_t> numbers; ///< indices of the points of the block, and of their rows

  double& number(std::size_t row, std::size_t column) const { return columns[column].values[numbers[row]]; }
  Point_status& status(std::size_t row) const { return statuses[numbers[row]]; }
  double area(std::size_t row) const { return areas[numbers[std::min(row, numbers.size() - 1)]]; }

  void set(std::size_t row, const Local_structure_3<double>& structure) const {
    status(row) = structure.status;
    Attribute_sample<double> sample(structure);
    if (!areas.empty()) sample.vertex_area = area(row);
    for (std::size_t c = 0; c < attributes.size(); ++c) number(row, c) = attributes[c].get(sample);
  }
};

/// Fills the rows of pack n: regular points all at once, the others one by one, which also determines their status.
inline void measure_pack(const Expanded_block& block, std::size_t n, const Attribute_rows& rows) {
  using Lanes = Expanded_block::Lanes;
  const auto pack = regular_structure(block.jets[n], block.points_of_pack(n), block.rounding_of_pack(n));
  const std::size_t begin = n * Lanes::size, count = std::min(Lanes::size, block.number_of_points - begin);
  Attribute_sample<Lanes> sample(pack.structure);
  if (!rows.areas.empty()) sample.vertex_area = Lanes::generate([&](std::size_t i) { return rows.area(begin + i); });
  for (std::size_t c = 0; c < rows.attributes.size(); ++c) {
    const Lanes numbers = rows.attributes[c].get(sample);
    for (std::size_t i = 0; i < count; ++i) rows.number(begin + i, c) = numbers[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    rows.status(begin + i) = Point_status::REGULAR;
    if (!pack.is_regular[i])
      rows.set(begin + i, irregular_structure(block.jet(begin + i), pack.is_steep[i], block.rounding(begin + i)));
  }
}

/// Fills the selected columns of norms of gradients.
template <class Traits>
void measure_gradients(const Traits& traits, std::span<const typename Traits::Point_3> points,
                       const Attribute_rows& rows) {
  const auto gradient = [&](std::size_t c) { return attribute_table<double>[rows.attributes[c].row].gradient; };
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < rows.attributes.size(); ++c)
    if (gradient(c)) columns.push_back(c);
  for (std::size_t i = 0; i < points.size() && !columns.empty(); ++i) {
    const auto norms = affine_gradient_norms(traits, points[i]);
    for (const std::size_t c : columns) rows.number(i, c) = norms[*gradient(c)];
  }
}

/// Implements compute_attributes().
template <class ConcurrencyTag, class Traits>
Vertex_attributes compute_columns(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                  const Attribute_selection& selection, const Sampled_vertices& sampled) {
  for (const std::size_t size : {sampled.status.size(), sampled.areas.size()})
    check_argument(size == 0 || size == points.size(),
                   "the number of statuses or areas does not match the number of points: give one per point, or none");
  Vertex_attributes result;
  if (selection.columns.empty() && !selection.has_status) return result;
  for (const Attribute& attribute : selection.columns) {
    Progress_observer::step();
    auto& column = result.columns.emplace_back(Vertex_attributes::Column{std::string(attribute.name), {}});
    resize_with_large_pages(column.values, points.size());
  }
  std::vector<Point_status> status(points.size());
  const bool looks_beside_points =
      std::any_of(selection.columns.begin(), selection.columns.end(),
                  [](const Attribute& attribute) { return bool(attribute_table<double>[attribute.row].gradient); });
  for_each_point_block<ConcurrencyTag>(
      traits, points, Expanded_block::points, looks_beside_points ? 1 : 0,
      [&](const Traits& local, std::span<const std::size_t> numbers) {
        std::array<typename Traits::Point_3, Expanded_block::points> points_of_block;
        for (std::size_t n = 0; n < numbers.size(); ++n) points_of_block[n] = points[numbers[n]];
        const auto block = std::span<const typename Traits::Point_3>(points_of_block).first(numbers.size());
        const Attribute_rows rows{selection.columns, result.columns, status, sampled.areas, numbers};
        const Expanded_block expanded = expand_block(local, block);
        for (std::size_t n = 0; n < expanded.number_of_packs(); ++n) measure_pack(expanded, n, rows);
        measure_gradients(local, block, rows);
        if (sampled.status.empty()) return;
        for (const std::size_t n : numbers) status[n] = status_after_sampling(status[n], sampled.status[n]);
      });
  if (selection.has_status) result.status = std::move(status);
  return result;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Returns the local structure of the level set of f through p. `sampled_status` is the status of p according to a
/// sampler: an UNCONVERGED point keeps that status, with the numbers that exist, unless it is OUTSIDE. The named
/// parameters `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
template <ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Local_structure_3<typename Traits::FT> local_structure_at(const Traits& traits, const typename Traits::Point_3& p,
                                                          Point_status sampled_status = Point_status::REGULAR,
                                                          const Parameters&...) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Geom_traits_tag,
                             internal::Verbose_tag>();
  auto structure =
      local_structure<typename Traits::FT>(traits.taylor(p), {p.x(), p.y(), p.z()}, equiaffine::rounding(traits, p));
  structure.status = status_after_sampling(structure.status, sampled_status);
  return structure;
}

/// Computes the selected attributes of points, one column of doubles per scalar. Takes one Taylor expansion of order
/// 4 per point, and one of order 5, or up to 40 more of order 4, if the norm of a gradient is selected.
/// CGAL::Sequential_tag and CGAL::Parallel_tag give the same numbers, bit for bit. Points are computed in packs. The
/// numbers equal those of local_structure_at bit for bit if the compiler rounds each product and each sum
/// (-ffp-contract=off), else to within rounding.
///
/// `sampled` contains statuses, as in local_structure_at, and the areas for `vertex_area` and `affine_area`, which
/// are NaN without them. Each is empty or has one entry per point. The named parameters `geom_traits` and `verbose`
/// are accepted for compatibility with CGAL, and ignored.
/// \throw std::invalid_argument if their number does not match that of the points
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Vertex_attributes compute_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                     const Attribute_selection& selection, const Sampled_vertices& sampled = {},
                                     const Parameters&...) {
  static_assert(std::is_same_v<typename Traits::FT, double>);
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Geom_traits_tag,
                             internal::Verbose_tag>();
  return internal::compute_columns<ConcurrencyTag>(traits, points, selection, sampled);
}

/// The same for the vertices of a mesh, with the areas of its triangles.
/// \throw Input_error if an attribute needs triangles, and there are none
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Kernel,
          internal::Parameter_chain... Parameters>
Vertex_attributes compute_attributes(const Traits& traits, const Indexed_triangle_mesh_3<Kernel>& mesh,
                                     const Attribute_selection& selection,
                                     std::span<const Point_status> sampled_status = {},
                                     const Parameters&... parameters) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Geom_traits_tag,
                             internal::Verbose_tag>();
  const auto areas = selected_vertex_areas(selection, mesh.points, mesh.triangles);
  return compute_attributes<ConcurrencyTag>(traits, std::span(mesh.points), selection,
                                            Sampled_vertices(sampled_status, areas), parameters...);
}

} // namespace equiaffine

#endif
