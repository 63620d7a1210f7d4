// SPDX-License-Identifier: GPL-3.0-or-later
#include "Doubt.h"

#include <equiaffine/display/internal/trust.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace equiaffine {

Error_rows selected_errors(const Attribute_selection& selection, bool of_splines) {
  Error_rows rows;
  for (const Estimate_attribute& estimate : estimate_attributes())
    if (estimate.kind == Estimate_kind::ERROR && (estimate.is_of_splines || !of_splines) &&
        std::any_of(selection.columns.begin(), selection.columns.end(),
                    [&](const Attribute& a) { return attribute_table<double>[a.row].name == estimate.row->name; }))
      rows.push_back(estimate);
  return rows;
}

void Doubt::add(Vertex_attributes& block, std::span<const unsigned char> ghosts) {
  if (doubtful_ == Doubtful::UNTESTED) return;
  std::vector<std::vector<double>> sizes; // computed before any number is hidden
  for (const auto& row : rows_) sizes.push_back(sizes_of_numbers(*find_column(block, row.row->name), block));
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto column = std::find_if(block.columns.begin(), block.columns.end(),
                                     [&](const auto& c) { return c.name == rows_[r].row->name; });
    const auto& errors = find_errors(block, column->name)->values;
    for (std::size_t v = 0; v < ghosts.size(); ++v) {
      if (!std::isfinite(column->values[v])) continue;
      const bool is_unknown = !is_known(sizes[r][v], errors[v]);
      if (!ghosts[v]) {
        ++counts_[2 * r];
        counts_[2 * r + 1] += is_unknown;
      }
      if (is_unknown && doubtful_ == Doubtful::HIDDEN) column->values[v] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

Doubt::Verdict Doubt::verdict(const Ranks& ranks, const std::vector<std::string>& names, bool has_status) const {
  std::vector<std::int64_t> counts = counts_;
  ranks.sum(counts);
  // The rules need the numbers of all vertices. A sample with the same fractions of unknown numbers represents them.
  constexpr std::size_t vertices = 10000;
  Vertex_attributes sample;
  const auto add = [&](std::string name, double number) {
    if (!find_column(sample, name)) sample.columns.push_back({std::move(name), std::vector<double>(vertices, number)});
  };
  for (std::size_t r = 0; r < rows_.size(); ++r) { // including rows whose numbers are all hidden
    double unknown = counts[2 * r] == 0 ? 0 : double(counts[2 * r + 1]) / double(counts[2 * r]);
    if (doubtful_ == Doubtful::UNTESTED) unknown = 1;
    const bool exists = counts[2 * r] > 0 || std::find(names.begin(), names.end(), rows_[r].row->name) != names.end();
    add(std::string(rows_[r].row->name), exists ? 1 : std::numeric_limits<double>::quiet_NaN());
    add(rows_[r].name, 0);
    auto& errors = sample.columns.back().values;
    std::fill_n(errors.begin(), std::size_t(std::ceil(vertices * unknown)), std::numeric_limits<double>::infinity());
  }
  for (const std::string& name : names) add(name, 1);
  if (has_status) sample.status.emplace(vertices);
  Verdict verdict = {first_shown(sample), {}};
  if (doubtful_ != Doubtful::UNTESTED) verdict.sentences = sentences_of_doubt(sample);
  return verdict;
}

} // namespace equiaffine
