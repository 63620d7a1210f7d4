// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/header_checks.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

namespace {

Kernel::Vector_3 vector_in(const std::string& path, std::string_view element, const std::string& name,
                           double otherwise) {
  const std::optional<std::string_view> content = xml_attribute(element, name);
  if (!content) return {otherwise, otherwise, otherwise};
  const auto numbers = to_numbers(*content, 3);
  if (!numbers) fail_at_field(path, name, *content, "write 3 finite numbers");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

Lattice_3<Kernel>::Size size_in(const std::string& path, std::string_view element) {
  const std::string_view content = xml_attribute(element, "WholeExtent").value_or("");
  const std::vector<std::string_view> words = words_of(content);
  std::array<long long, 6> extent;
  for (std::size_t i = 0; i < extent.size(); ++i) {
    const auto number = words.size() == extent.size() ? to_integer(words[i], INT_MIN, INT_MAX) : std::nullopt;
    if (!number) fail_at_field(path, "WholeExtent", content, "write 6 integers of 32 bits");
    extent[i] = *number;
  }
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5])
    fail_at_field(path, "WholeExtent", content, "write the first and the last node along each axis");
  Lattice_3<Kernel>::Size size;
  for (std::size_t axis = 0; axis < 3; ++axis) size[axis] = std::size_t(extent[2 * axis + 1] - extent[2 * axis] + 1);
  return size;
}

/// VTK's reader crashes at arrays of strings. They may stand anywhere before the appended data, which are no XML.
void check_arrays(const std::string& path) {
  constexpr std::array<std::string_view, 11> types = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32", "UInt32",
                                                      "Int64", "UInt64", "Float32", "Float64", "Bit"};
  std::ifstream file(path, std::ios::binary);
  std::string element;
  while (file.ignore(std::numeric_limits<std::streamsize>::max(), '<') && std::getline(file, element, '>')) {
    if (element.starts_with("AppendedData")) return;
    if (!element.starts_with("DataArray")) continue;
    const std::string_view type = xml_attribute(element, "type").value_or("");
    if (std::find(types.begin(), types.end(), type) == types.end())
      fail_at_field(path, "a DataArray of type", type, "convert it to Float32 or Float64");
  }
}

} // namespace

void check_vti_header(const std::string& path) {
  constexpr std::size_t longest_beginning = 1 << 16;
  const std::string beginning = beginning_of(path, longest_beginning);
  const std::size_t begin = beginning.find("<ImageData");
  if (begin == std::string::npos)
    fail_to_read_volume(path, "its header is damaged, it has no element ImageData", "get the complete file again");
  const std::string_view element = std::string_view(beginning).substr(begin, beginning.find('>', begin) - begin);
  const Kernel::Vector_3 spacing = vector_in(path, element, "Spacing", 1),
                         origin = vector_in(path, element, "Origin", 0);
  if (const auto direction = xml_attribute(element, "Direction"); direction && !to_numbers(*direction, 9))
    fail_at_field(path, "Direction", *direction, "write 9 finite numbers");
  make_lattice(
      path, size_in(path, element), CGAL::ORIGIN + origin,
      {Kernel::Vector_3(spacing.x(), 0, 0), Kernel::Vector_3(0, spacing.y(), 0), Kernel::Vector_3(0, 0, spacing.z())});
  check_arrays(path);
}

} // namespace equiaffine
