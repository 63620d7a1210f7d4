// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace equiaffine {

const Vertex_attributes::Column* find_errors(const Vertex_attributes& attributes, const std::string& name) {
  return find_column(attributes, name + "_error");
}

bool is_known(double size, double error) { return error <= size / 2; }

std::vector<double> sizes_of_numbers(const Vertex_attributes::Column& column, const Vertex_attributes& attributes) {
  std::vector<double> sizes = column.values;
  const auto* const row = find_row(column.name);
  const auto number = [&, missing = std::numeric_limits<double>::quiet_NaN()](const char* name) {
    const auto* const other = find_column(attributes, name);
    return [other, missing](std::size_t i) { return other ? other->values[i] : missing; };
  };
  const auto k1 = number("k1"), k2 = number("k2"), euclidean_K = number("gaussian_curvature"),
             K = number("affine_gaussian_curvature"), H = number("affine_mean_curvature"), J = number("pick_invariant");
  Local_structure_3<double> s{};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = std::abs(sizes[i]); // used if the columns to compute the size from are missing
    if (row == nullptr || !row->error.exists()) continue;
    s.euclidean.k1 = k1(i);
    s.euclidean.k2 = k2(i);
    s.euclidean.gaussian_curvature = euclidean_K(i);
    s.affine.gaussian_curvature = K(i);
    s.affine.mean_curvature = H(i);
    s.affine.pick_invariant = J(i);
    const double size = row->error.size(s);
    if (!std::isnan(size)) sizes[i] = size;
    sizes[i] = std::max(sizes[i], 2 * row->error.negligible(euclidean_K(i)));
  }
  return sizes;
}

double unknown_fraction(const Vertex_attributes::Column& column, const std::vector<double>& errors,
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

std::vector<std::string> sentences_of_doubt(const Vertex_attributes& attributes) {
  std::vector<std::string> sentences;
  for (const auto& column : attributes.columns) {
    const auto* errors = find_errors(attributes, column.name);
    const double part = errors == nullptr ? 0 : unknown_fraction(column, errors->values, attributes);
    if (!(part > 0.5)) continue;
    const Quantity* const quantity = find_quantity(column.name);
    sentences.push_back((quantity ? std::string(quantity->label) : column.name) + " is unknown at " +
                        std::to_string(std::lround(100 * part)) +
                        " % of the vertices: its error exceeds half its size");
  }
  return sentences;
}

bool is_trusted(const Vertex_attributes::Column& column, const Vertex_attributes& attributes) {
  if (const auto* errors = find_errors(attributes, column.name))
    return unknown_fraction(column, errors->values, attributes) <= 0.5;
  const auto is_affine = [](const auto& other) {
    const Quantity* const quantity = find_quantity(other.name);
    return quantity != nullptr && quantity->group == "Affine";
  };
  return !is_affine(column) ||
         std::all_of(attributes.columns.begin(), attributes.columns.end(), [&](const auto& other) {
           return !is_affine(other) || !find_errors(attributes, other.name) || is_trusted(other, attributes);
         });
}

bool is_component_or_error(const std::string& name, const Vertex_attributes& attributes) {
  for (const std::string suffix : {"_error", "_noise", "_detail"})
    if (name.ends_with(suffix)) {
      const std::string of = name.substr(0, name.size() - suffix.size());
      if (of == "normal" || find_column(attributes, of) || find_column(attributes, of + "_x")) return true;
    }
  return name.size() > 1 && (name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z") || name == "nx" ||
                             name == "ny" || name == "nz" || name.starts_with("metric_"));
}

std::string first_shown(const Vertex_attributes& attributes) {
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

double color_doubt(double value, double error, const Color_mapping& mapping) {
  if (!std::isfinite(value)) return 0;
  if (!std::isfinite(error)) return 1;
  const double span = mapping.position(value + error) - mapping.position(value - error);
  return std::min(1., mapping.range.is_diverging ? span : 2 * span);
}

} // namespace equiaffine
