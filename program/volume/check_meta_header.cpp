// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/header_checks.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <climits>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace equiaffine {

namespace {

constexpr long long largest_number_of_axes = 10; // that of the MetaIO library

/// Checks a field that holds numbers, one per axis or, for a matrix, one per pair of axes.
void check_numbers(const std::string& path, std::string_view field, std::string_view content, std::size_t axes) {
  for (const std::string_view name : {"ElementSpacing", "ElementSize", "Offset", "Position", "Origin"})
    if (field == name && !to_numbers(content, axes))
      fail_at_field(path, field, content, "write " + std::to_string(axes) + " finite numbers");
  for (const std::string_view name : {"TransformMatrix", "Rotation", "Orientation"})
    if (field == name && !to_numbers(content, axes * axes))
      fail_at_field(path, field, content, "write " + std::to_string(axes * axes) + " finite numbers");
  if (field != "DimSize") return;
  const auto sizes = words_of(content);
  const bool are_sizes = std::all_of(sizes.begin(), sizes.end(),
                                     [](std::string_view size) { return to_integer(size, 1, INT_MAX).has_value(); });
  if (sizes.size() != axes || !are_sizes)
    fail_at_field(path, field, content, "write " + std::to_string(axes) + " positive integers");
}

} // namespace

void check_meta_header(const std::string& path) {
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  std::size_t axes = 0;
  while (!rest.empty()) {
    const auto found = meta_field(take_line(rest));
    if (!found) continue;
    const auto& [field, content] = *found;
    if (field == "NDims") {
      const std::optional<long long> count = to_integer(content, 1, largest_number_of_axes);
      if (!count) fail_at_field(path, field, content, "write the number of axes, which is 3");
      axes = std::size_t(*count);
    } else if (field == "ElementDataFile") return;
    else if (axes > 0) check_numbers(path, field, content, axes);
  }
}

} // namespace equiaffine
