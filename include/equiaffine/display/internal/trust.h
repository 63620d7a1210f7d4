// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H
#define EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H

#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/attributes/internal/quantities.h>
#include <equiaffine/display/Color_mapping.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// \file
/// How far pictures trust the numbers of a column: the column NAME_error has estimates of the errors of those in NAME.

namespace equiaffine {

inline const Vertex_attributes::Column* find_errors(const Vertex_attributes& attributes, const std::string& name) {
  return find_column(attributes, name + "_error");
}

/// Returns whether a number is known to one digit: the estimated error is at most half of the size of the number.
inline bool is_known(double size, double error) { return error <= size / 2; }

/// Returns the numbers that errors of a column are called parts of: those of error_table.h, or the numbers themselves, but
/// at least twice a negligible error.
inline std::vector<double> sizes_of_numbers(const Vertex_attributes::Column& column,
                                            const Vertex_attributes& attributes) {
  std::vector<double> sizes = column.values;
  const auto *K = find_column(attributes, "affine_gaussian_curvature"),
             *H = find_column(attributes, "affine_mean_curvature");
  const auto *k1 = find_column(attributes, "k1"), *k2 = find_column(attributes, "k2");
  const bool is_principal = column.name == "k1" || column.name == "k2" || column.name == "mean_curvature";
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (column.name == "affine_normal_angle") sizes[i] = internal::whole_angle;
    else if (k1 && k2 && (is_principal || column.name == "gaussian_curvature")) {
      const double curved = curvedness(k1->values[i], k2->values[i]);
      sizes[i] = is_principal ? curved : curved * curved;
    } else if (K && H && (&column == K || &column == H)) {
      const double size = std::abs(K->values[i]) + H->values[i] * H->values[i];
      sizes[i] = &column == K ? size : std::sqrt(size);
    } else sizes[i] = std::abs(sizes[i]);
  }
  const auto* euclidean_K = find_column(attributes, "gaussian_curvature");
  for (const auto& row : error_table<double>)
    if (euclidean_K && row.attribute == column.name && row.power_of_negligible > 0)
      for (std::size_t i = 0; i < sizes.size(); ++i)
        sizes[i] = std::max(sizes[i], 2 * internal::negligible_error(euclidean_K->values[i], row.power_of_negligible));
  return sizes;
}

/// Returns the part of the numbers of a column that are not known to one digit: the estimated error is more than half of
/// the size of the number. It is 0 without numbers.
inline double part_in_doubt(const Vertex_attributes::Column& column, const std::vector<double>& errors,
                            const Vertex_attributes& attributes) {
  const std::vector<double> sizes = sizes_of_numbers(column, attributes);
  std::size_t unknown = 0, all = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!std::isfinite(column.values[i])) continue;
    ++all;
    unknown += !is_known(sizes[i], errors[i]);
  }
  return all == 0 ? 0 : double(unknown) / double(all);
}

/// Returns a sentence for every column of which less than half of the numbers are known to one digit.
inline std::vector<std::string> sentences_of_doubt(const Vertex_attributes& attributes) {
  std::vector<std::string> sentences;
  for (const auto& column : attributes.columns) {
    const auto* errors = find_errors(attributes, column.name);
    const double part = errors == nullptr ? 0 : part_in_doubt(column, errors->values, attributes);
    if (!(part > 0.5)) continue;
    const Quantity* const quantity = find_quantity(column.name);
    sentences.push_back((quantity ? std::string(quantity->label) : column.name) + " is unknown at " +
                        std::to_string(std::lround(100 * part)) + " % of the vertices: error above half of its size");
  }
  return sentences;
}

/// Returns whether at least half of the numbers are known to one digit. Numbers without estimates are trusted, unless
/// they are affine ones beside others that are not: they are made of the same derivatives.
inline bool is_trusted(const Vertex_attributes::Column& column, const Vertex_attributes& attributes) {
  if (const auto* errors = find_errors(attributes, column.name))
    return part_in_doubt(column, errors->values, attributes) <= 0.5;
  const auto is_affine = [](const auto& other) {
    const Quantity* const quantity = find_quantity(other.name);
    return quantity != nullptr && quantity->group == "Affine";
  };
  return !is_affine(column) ||
         std::all_of(attributes.columns.begin(), attributes.columns.end(), [&](const auto& other) {
           return !is_affine(other) || !find_errors(attributes, other.name) || is_trusted(other, attributes);
         });
}

/// Returns whether a column is shown on request only: a component of a vector or of the metric, errors, or what noise
/// or detail make of numbers. The error of a vector, an angle, has no column of that name beside it.
inline bool is_component_or_error(const std::string& name, const Vertex_attributes& attributes) {
  for (const std::string suffix : {"_error", "_noise", "_detail"})
    if (name.ends_with(suffix)) {
      const std::string of = name.substr(0, name.size() - suffix.size());
      if (of == "normal" || find_column(attributes, of) || find_column(attributes, of + "_x")) return true;
    }
  return name.size() > 1 && (name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z") || name == "nx" ||
                             name == "ny" || name == "nz" || name.starts_with("metric_"));
}

/// Returns what pages and pictures show first: of our attributes with numbers that are trusted the one of the least rank, or
/// of all with numbers if none is trusted, or another column with numbers; else `status` or `plain`.
inline std::string first_shown(const Vertex_attributes& attributes) {
  const Vertex_attributes::Column* first = nullptr;
  std::array<int, 3> first_order{};
  for (const auto& column : attributes.columns) {
    const bool has_numbers =
        std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
    if (!has_numbers || is_component_or_error(column.name, attributes)) continue;
    const int rank = rank_of_quantity(column.name);
    const std::array<int, 3> order = {rank == Quantity::unranked, !is_trusted(column, attributes), rank};
    if (first != nullptr && !(order < first_order)) continue;
    first = &column;
    first_order = order;
  }
  if (first != nullptr) return first->name;
  return attributes.status ? "status" : "plain";
}

/// Returns how little the color of a number says, from 0 for an exact one to 1 if the numbers within the error take half
/// of the color bar or more. An error that is not known is infinite.
inline double color_doubt(double value, double error, const Color_mapping& mapping) {
  if (!std::isfinite(value)) return 0;
  if (!std::isfinite(error)) return 1;
  const double span = mapping.position(value + error) - mapping.position(value - error);
  return std::min(1., mapping.range.is_diverging ? span : 2 * span);
}

} // namespace equiaffine

#endif
