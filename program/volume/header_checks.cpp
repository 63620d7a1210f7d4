// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the headers of MetaImage and VTI, also in a program without ITK and VTK, which read them.
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

constexpr long long largest_number_of_axes = 10; // of the MetaIO library

/// Checks a field with one number per axis or, for a matrix, per pair of axes.
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
      if (!count) fail_at_field(path, field, content, "write the number of axes, 3 for a volume");
      axes = std::size_t(*count);
    } else if (field == "ElementDataFile") return;
    else if (axes > 0) check_numbers(path, field, content, axes);
  }
}

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

/// VTK's reader crashes for arrays of strings.
void check_type(const std::string& path, std::string_view array) {
  constexpr std::array<std::string_view, 11> types = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32", "UInt32",
                                                      "Int64", "UInt64", "Float32", "Float64", "Bit"};
  const std::string_view type = xml_attribute(array, "type").value_or("");
  if (std::find(types.begin(), types.end(), type) == types.end())
    fail_at_field(path, "a DataArray of the type", type, "convert it to Float32 or Float64");
}

/// The format of the length of an array before its bytes.
struct Length_format {
  std::size_t size;
  bool is_big_endian, is_compressed;

  explicit Length_format(std::string_view file_element)
      : size(xml_attribute(file_element, "header_type") == "UInt64" ? 8 : 4),
        is_big_endian(xml_attribute(file_element, "byte_order") == "BigEndian"),
        is_compressed(xml_attribute(file_element, "compressor").has_value()) {}

  double length(std::string_view bytes) const {
    double length = 0;
    for (std::size_t i = 0; i < size; ++i)
      length = length * 256 + double(static_cast<unsigned char>(bytes[is_big_endian ? i : size - 1 - i]));
    return length;
  }
};

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Decodes base64 up to the first other character; blanks are skipped.
std::string decode_base64(std::string_view text) {
  std::string bytes;
  unsigned group = 0, bits = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const std::size_t digit = base64_digits.find(c);
    if (digit == std::string_view::npos) break;
    group = (group << 6 | unsigned(digit)) & 0xFFFF;
    if ((bits += 6) >= 8) bytes += char(group >> (bits -= 8) & 0xFF);
  }
  return bytes;
}

/// The offset of the last end tag of appended data in a file, or 0.
std::streamoff end_of_appended_data(std::ifstream& file) {
  constexpr std::streamoff longest_rest = 1 << 12;
  file.clear();
  const std::streamoff size = file.seekg(0, std::ios::end).tellg(),
                       begin = std::max<std::streamoff>(size - longest_rest, 0);
  std::string rest(std::size_t(size - begin), '\0');
  file.seekg(begin).read(rest.data(), std::streamsize(rest.size()));
  const std::size_t end = rest.rfind("</AppendedData");
  return end == std::string::npos ? 0 : begin + std::streamoff(end);
}

/// Checks that arrays end within the appended data. For others, VTK returns uninitialized memory.
void check_appended_arrays(const std::string& path, std::ifstream& file, bool is_raw, const Length_format& format,
                           const std::vector<std::streamoff>& places) {
  constexpr std::size_t longest_length = 12; // 8 bytes in base64
  file.ignore(std::numeric_limits<std::streamsize>::max(), '_');
  const std::streamoff begin = file.tellg(), end = end_of_appended_data(file);
  for (const std::streamoff place : places) {
    if (place > end - begin) fail_to_read_volume_data(path);
    std::string bytes(longest_length, '\0');
    file.seekg(begin + place).read(bytes.data(), std::streamsize(bytes.size()));
    if (!is_raw) bytes = decode_base64(bytes);
    const double available = double(end - begin - place) * (is_raw ? 1 : 0.75);
    if (!file || bytes.size() < format.size || double(format.size) + format.length(bytes) > available)
      fail_to_read_volume_data(path);
  }
}

/// Checks the arrays of a file. They may be anywhere before the appended data, which are not XML.
void check_arrays(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string element, text;
  Length_format format("");
  std::vector<std::streamoff> places; // of appended arrays
  while (file.ignore(std::numeric_limits<std::streamsize>::max(), '<') && std::getline(file, element, '>')) {
    if (element.starts_with("VTKFile")) format = Length_format(element);
    if (element.starts_with("AppendedData")) break;
    if (!element.starts_with("DataArray")) continue;
    check_type(path, element);
    const std::string_view encoding = xml_attribute(element, "format").value_or("");
    if (encoding == "appended")
      places.push_back(to_integer(xml_attribute(element, "offset").value_or(""), 0, LLONG_MAX).value_or(0));
    if (encoding != "binary" || format.is_compressed) continue;
    std::getline(file, text, '<');
    file.unget();
    const std::string bytes = decode_base64(text);
    if (bytes.size() < format.size || double(bytes.size() - format.size) < format.length(bytes))
      fail_to_read_volume_data(path);
  }
  if (!places.empty() && !format.is_compressed)
    check_appended_arrays(path, file, xml_attribute(element, "encoding") == "raw", format, places);
}

} // namespace

void check_vti_header(const std::string& path) {
  constexpr std::size_t longest_beginning = 1 << 16;
  const std::string beginning = beginning_of(path, longest_beginning);
  const std::size_t begin = beginning.find("<ImageData");
  if (begin == std::string::npos)
    fail_to_read_volume(path, "its header has no element ImageData", "get the complete file again");
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
