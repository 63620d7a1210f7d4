// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimate_names.h"

#include <cstddef>

namespace equiaffine {

const std::vector<Estimate_attribute>& estimate_attributes() {
  static const std::vector<Estimate_attribute> attributes = [] {
    constexpr std::size_t of_splines = 2; // the affine curvatures, of which there are all kinds
    std::vector<Estimate_attribute> result;
    const auto add = [&](Estimate_kind kind, const std::string& suffix, std::size_t count) {
      for (std::size_t n = 0; n < count; ++n) {
        const auto& row = error_table<double>[n];
        result.push_back(
            {std::string(row.attribute) + suffix, kind, &row, kind == Estimate_kind::ERROR && n < of_splines});
      }
    };
    add(Estimate_kind::ERROR, "_error", error_table<double>.size());
    add(Estimate_kind::NOISE, "_noise", of_splines);
    add(Estimate_kind::DETAIL, "_detail", of_splines);
    return result;
  }();
  return attributes;
}

std::vector<std::string> error_attributes() {
  std::vector<std::string> names;
  for (const auto& attribute : estimate_attributes())
    if (attribute.kind == Estimate_kind::ERROR) names.push_back(attribute.name);
  return names;
}

} // namespace equiaffine
