// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/raw_data.h"

#include "volume/data_files.h"
#include "volume/header_text.h"
#include "volume/sample_type.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

namespace equiaffine {

namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);
constexpr bool is_little_endian = std::endian::native == std::endian::little;

std::optional<Raw_data> in_meta_image(const std::string& path) {
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (line.empty()) continue;
    const auto field = meta_field(line);
    if (!field || field->content.empty()) return std::nullopt; // the content may stand on the next line
    const auto is_true = [&] { return boost::istarts_with(field->content, "t") || field->content.starts_with('1'); };
    if (field->name == "BinaryData" && !is_true()) return std::nullopt;
    if (field->name == "CompressedData" && is_true()) return std::nullopt;
    if ((field->name == "BinaryDataByteOrderMSB" || field->name == "ElementByteOrderMSB") &&
        is_true() == is_little_endian)
      return std::nullopt;
    if (field->name == "HeaderSize") return std::nullopt;
    if (field->name != "ElementDataFile") continue;
    const std::vector<std::string> names = data_files_in(field->content, rest);
    if (names.empty() && !field->content.starts_with("LIST"))
      return Raw_data{path, std::size_t(rest.data() - header.data())};
    if (names.size() != 1 || field->content.starts_with("LIST") || names[0].find('%') != std::string::npos)
      return std::nullopt;
    return Raw_data{(fs::path(path).parent_path() / names[0]).string(), 0};
  }
  return std::nullopt;
}

std::optional<Raw_data> in_NRRD(const std::string& path) {
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  bool is_raw = false, has_right_order = true;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (line.empty())
      return is_raw && has_right_order ? std::optional(Raw_data{path, std::size_t(rest.data() - header.data())})
                                       : std::nullopt;
    std::string_view content = line, name = line.substr(0, line.find(':'));
    content.remove_prefix(std::min(name.size() + 1, line.size()));
    name = take_line(name);
    content = take_line(content);
    if (boost::iequals(name, "encoding")) is_raw = boost::iequals(content, "raw");
    if (boost::iequals(name, "endian")) has_right_order = boost::iequals(content, is_little_endian ? "little" : "big");
    for (const char* const other : {"data file", "datafile", "line skip", "lineskip", "byte skip", "byteskip"})
      if (boost::iequals(name, other)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Raw_data> in_NIfTI(const std::string& path, std::size_t type) {
  constexpr std::size_t header_size = 348, place_of_type = 70, place_of_offset = 108, place_of_magic = 344;
  constexpr std::array<std::int16_t, raw_types.size()> codes = {2, 256, 512, 4, 768, 8, 1280, 1024, 16, 64};
  constexpr float greatest_offset = 1e9F; // beyond which a float would not be exact
  const std::string header = beginning_of(path, header_size);
  std::int32_t size = 0;
  std::int16_t datatype = 0;
  std::array<float, 3> numbers{}; // vox_offset, scl_slope, scl_inter
  if (header.size() < header_size || header.compare(place_of_magic, 3, "n+1") != 0) return std::nullopt;
  std::memcpy(&size, header.data(), sizeof size);
  std::memcpy(&datatype, header.data() + place_of_type, sizeof datatype);
  std::memcpy(numbers.data(), header.data() + place_of_offset, sizeof numbers);
  const auto& [offset, slope, intercept] = numbers;
  const bool is_scaled = (slope != 0 && slope != 1) || intercept != 0;
  if (size != std::int32_t(header_size) || datatype != codes[type] || is_scaled ||
      !(offset >= 0 && offset <= greatest_offset))
    return std::nullopt;
  return Raw_data{path, std::size_t(offset)};
}

} // namespace

std::optional<Raw_data> find_raw_data(const std::string& path, Volume_format format, std::size_t type,
                                      std::size_t count) {
  if (is_gzip(path)) return std::nullopt;
  const auto data = format == Volume_format::META    ? in_meta_image(path)
                    : format == Volume_format::NRRD  ? in_NRRD(path)
                    : format == Volume_format::NIFTI ? in_NIfTI(path, type)
                                                     : std::nullopt;
  if (!data) return std::nullopt;
  std::error_code error;
  const auto size = fs::file_size(data->path, error);
  return !error && size >= data->first && (size - data->first) / size_of_sample(type) >= count ? data : std::nullopt;
}

} // namespace equiaffine
