// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/data_files.h"

#include "system/front_end.h"
#include "volume/Nifti_header.h"
#include "volume/Shared_volume.h"
#include "volume/header_text.h"
#include <equiaffine/base/Input_error.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <climits>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <vector>

namespace equiaffine {

namespace fs = std::filesystem;

namespace {

double size_of_file(const fs::path& path) {
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  return error ? 0 : double(bytes);
}

/// A pattern of numbered names, such as slice%03d.raw.
struct Name_pattern {
  std::string_view before, after;
  std::size_t width = 0;
  char fill = ' ';

  std::string name(long long number) const {
    std::string digits = std::to_string(number);
    if (digits.size() < width) digits.insert(0, width - digits.size(), fill);
    return std::string(before).append(digits).append(after);
  }
};

/// The pattern in a word with one %; nothing unless it formats an integer.
std::optional<Name_pattern> pattern_in(std::string_view word) {
  constexpr std::size_t greatest_width = 20;
  const std::size_t percent = word.find('%'), letter = word.find_first_not_of("0123456789", percent + 1);
  if (letter == std::string_view::npos || word[letter] != 'd' || word.find('%', letter) != std::string_view::npos)
    return std::nullopt;
  Name_pattern pattern = {word.substr(0, percent), word.substr(letter + 1)};
  const std::string_view width = word.substr(percent + 1, letter - percent - 1);
  if (width.starts_with('0')) pattern.fill = '0';
  if (!width.empty()) std::from_chars(width.data(), width.data() + width.size(), pattern.width);
  return pattern.width <= greatest_width ? std::optional(pattern) : std::nullopt;
}

/// The names for numbers from a first to a last one by a step; without these, MetaIO numbers slices from 1.
std::optional<std::vector<std::string>> names_by_pattern(std::string_view content, std::size_t slices) {
  constexpr long long most_names = 100'000;
  const std::vector<std::string_view> words = words_of(content);
  const std::optional<Name_pattern> pattern = pattern_in(words.front());
  std::optional<long long> first = 1, last = std::min<long long>(most_names, (long long)(slices)), step = 1;
  if (words.size() > 1) {
    first = to_integer(words[1], 0, INT_MAX);
    last = to_integer(words.size() > 2 ? words[2] : "", 0, INT_MAX);
    step = to_integer(words.size() > 3 ? words[3] : "", -INT_MAX, INT_MAX);
  }
  if (!pattern || !first || !last || !step || *step == 0) return std::nullopt;
  const long long count = (*last - *first) / *step + 1;
  if (count < 1 || count > most_names) return std::nullopt;
  std::vector<std::string> names;
  for (long long n = 0; n < count; ++n) names.push_back(pattern->name(*first + n * *step));
  return names;
}

/// The files named by a header. The header of NRRD ends with an empty line.
Data_files data_files_of(const std::string& path, Volume_format format) {
  std::error_code error;
  if ((format != Volume_format::META && format != Volume_format::NRRD) || !fs::is_regular_file(path, error)) return {};
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  std::vector<std::size_t> sizes;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (format == Volume_format::NRRD && line.empty()) return {};
    if (const auto field = meta_field(line); format == Volume_format::META && field && field->name == "DimSize") {
      sizes.clear();
      for (const std::string_view word : words_of(field->content))
        sizes.push_back(std::size_t(to_integer(word, 1, INT_MAX).value_or(1)));
    }
    for (const std::string_view name : {"ElementDataFile", "data file:", "datafile:"})
      if (boost::istarts_with(line, name)) {
        std::string_view content = line.substr(std::min(line.find_first_of("=:"), line.size() - 1) + 1);
        return data_files_in(take_line(content), rest, sizes);
      }
  }
  return {};
}

/// Whether the path of a file leads out of a folder, ignoring links.
bool leads_out_of(const fs::path& folder, const std::string& name) {
  const fs::path absolute = fs::absolute(folder / "."),
                 way = (absolute / name).lexically_normal().lexically_relative(absolute.lexically_normal());
  return way.empty() || *way.begin() == "..";
}

} // namespace

Data_files data_files_in(std::string_view content, std::string_view following_lines,
                         const std::vector<std::size_t>& sizes) {
  if (content == "LOCAL" || content == "Local" || content == "local") return {};
  Data_files files;
  files.content = content;
  const bool is_list = content.starts_with("LIST");
  if (content.find('%') != std::string_view::npos && !is_list) {
    if (!sizes.empty()) files.expected = sizes.back();
    const auto names = names_by_pattern(content, files.expected);
    files.are_understood = names.has_value();
    files.names = names.value_or(std::vector<std::string>());
  } else if (is_list) {
    while (!following_lines.empty())
      if (const std::string_view name = take_line(following_lines); !name.empty()) files.names.emplace_back(name);
    // "LIST 2D" states the number of axes of each file, by default all but the last one.
    std::size_t axes = sizes.empty() ? 0 : sizes.size() - 1;
    if (const auto words = words_of(content); words.size() > 1) {
      const std::string_view digits = words[1].substr(0, words[1].find_first_not_of("0123456789"));
      if (const auto given = to_integer(digits, 1, (long long)(sizes.size()))) axes = std::size_t(*given);
    }
    if (!sizes.empty()) files.expected = 1;
    for (std::size_t axis = axes; axis < sizes.size(); ++axis) files.expected *= sizes[axis];
  } else files.names.emplace_back(content);
  return files;
}

void check_data_files(const std::string& path, Volume_format format, bool allows_outside) {
  const Data_files files = data_files_of(path, format);
  if (!files.are_understood)
    fail_at_field(path, "the pattern of names", files.content,
                  "write a pattern such as slice%03d.raw, and after it the first and last number and the step");
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  for (const std::string& name : files.names) {
    if (!allows_outside && leads_out_of(folder, name))
      fail_to_read_volume(path, "its header names the file '" + printable(name) + "' outside its folder",
                          "move it to the header's folder" +
                              by_front_end(", or add --allow-outside if you trust the header", ""));
    if (!fs::exists(folder / name, error))
      fail_to_read_volume(path, "the data file '" + printable(name) + "' is missing",
                          "move it to the header's folder, or correct the name");
    if (!fs::is_regular_file(folder / name, error))
      fail_to_read_volume(path, "the data file '" + printable(name) + "' is not a regular file", "correct the name");
  }
  if (files.expected > 0 && files.names.size() != files.expected)
    fail_to_read_volume(path,
                        "its header names " + std::to_string(files.names.size()) +
                            (files.names.size() == 1 ? " data file" : " data files") + ", but its sizes require " +
                            std::to_string(files.expected),
                        "correct the names or the sizes");
}

double size_of_volume(const std::string& path, std::optional<Volume_format> format) {
  double size = format ? size_of_file(path) : 0;
  for (const std::string& file : files_of_volume(path, format)) size += size_of_file(file);
  return size;
}

std::vector<std::string> files_of_volume(const std::string& path, std::optional<Volume_format> format) {
  std::vector<std::string> files;
  if (format) {
    for (const std::string& name : data_files_of(path, *format).names)
      files.push_back((fs::absolute(path).parent_path() / name).string());
    return files;
  }
  std::error_code error;
  for (fs::directory_iterator entry(path, error), none; !error && entry != none; entry.increment(error))
    files.push_back(entry->path().string());
  return files;
}

namespace {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);
constexpr bool is_little_endian = std::endian::native == std::endian::little;

std::optional<Raw_data> in_meta_image(const std::string& path) {
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (line.empty()) continue;
    const auto field = meta_field(line);
    if (!field || field->content.empty()) return std::nullopt; // the content may be on the next line
    const auto is_true = [&] { return boost::istarts_with(field->content, "t") || field->content.starts_with('1'); };
    if (field->name == "BinaryData" && !is_true()) return std::nullopt;
    if (field->name == "CompressedData" && is_true()) return std::nullopt;
    if ((field->name == "BinaryDataByteOrderMSB" || field->name == "ElementByteOrderMSB") &&
        is_true() == is_little_endian)
      return std::nullopt;
    if (field->name == "HeaderSize") return std::nullopt;
    if (field->name != "ElementDataFile") continue;
    const Data_files files = data_files_in(field->content, rest, {});
    if (files.content.empty()) return Raw_data{path, std::size_t(rest.data() - header.data())};
    if (files.names != std::vector{files.content}) return std::nullopt;
    return Raw_data{(fs::path(path).parent_path() / files.content).string(), 0};
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
  const Nifti_header header(path);
  const bool is_as_in_memory =
      header.sample_type() == type && header.numbers_side_by_side() == 1 && !header.is_swapped() && !header.scaling();
  return is_as_in_memory ? std::optional(Raw_data{path, header.first_byte()}) : std::nullopt;
}

/// The start tags of the elements of this name in a text.
std::vector<std::string_view> xml_elements(std::string_view text, const std::string& name) {
  std::vector<std::string_view> elements;
  for (std::size_t at = 0; (at = text.find("<" + name, at)) != std::string_view::npos; ++at) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) break;
    if (std::string_view(" \t\r\n/>").find(text[at + 1 + name.size()]) != std::string_view::npos)
      elements.push_back(text.substr(at + 1, end - at - 1));
  }
  return elements;
}

/// The array at the points of a VTI file that is read.
std::optional<std::string_view> array_of_VTI(std::string_view header) {
  const std::size_t begin = header.find("<PointData"), end = header.find("</PointData>");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return std::nullopt;
  const std::string_view data = header.substr(begin, end - begin);
  const std::vector<std::string_view> arrays = xml_elements(data, "DataArray");
  if (arrays.size() == 1) return arrays[0];
  const auto scalars = xml_attribute(data.substr(0, data.find('>')), "Scalars");
  for (const std::string_view array : arrays)
    if (scalars && xml_attribute(array, "Name") == scalars) return array;
  return std::nullopt;
}

/// Reads the length in bytes at the beginning of an array, in VTK's `header_type`.
std::optional<std::uint64_t> length_of_array(const std::string& path, std::size_t place, std::size_t size_of_length) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t length = 0;
  std::array<char, sizeof length> bytes{};
  const auto offset = is_little_endian ? 0 : sizeof length - size_of_length;
  if (!file.seekg(std::streamoff(place)) || !file.read(bytes.data() + offset, std::streamsize(size_of_length)))
    return std::nullopt;
  std::memcpy(&length, bytes.data(), sizeof length);
  return length;
}

std::optional<Raw_data> in_VTI(const std::string& path, std::size_t type, std::size_t count) {
  constexpr std::array<std::string_view, raw_types.size()> names = {"UInt8", "Int8",   "UInt16", "Int16",   "UInt32",
                                                                    "Int32", "UInt64", "Int64",  "Float32", "Float64"};
  constexpr std::string_view appended = "<AppendedData";
  const std::string beginning = beginning_of(path, longest_header);
  const std::size_t begin_of_data = beginning.find(appended);
  if (begin_of_data == std::string::npos) return std::nullopt;
  const std::string_view header = std::string_view(beginning).substr(0, begin_of_data);
  const std::vector<std::string_view> files = xml_elements(header, "VTKFile"),
                                      images = xml_elements(header, "ImageData"),
                                      pieces = xml_elements(header, "Piece"),
                                      data = xml_elements(std::string_view(beginning).substr(begin_of_data),
                                                          "AppendedData");
  const auto array = array_of_VTI(header);
  if (files.size() != 1 || images.size() != 1 || pieces.size() != 1 || data.empty() || !array) return std::nullopt;
  const auto whole = xml_attribute(images[0], "WholeExtent"), extent = xml_attribute(pieces[0], "Extent");
  const bool is_one_piece = whole && extent && words_of(*whole) == words_of(*extent);
  const bool is_as_in_memory =
      xml_attribute(files[0], "byte_order") == (is_little_endian ? "LittleEndian" : "BigEndian") &&
      !xml_attribute(files[0], "compressor") && xml_attribute(data[0], "encoding") == "raw" &&
      xml_attribute(*array, "format") == "appended" && xml_attribute(*array, "type") == names[type] &&
      xml_attribute(*array, "NumberOfComponents").value_or("1") == "1";
  const auto offset =
      to_integer(xml_attribute(*array, "offset").value_or(""), 0, std::numeric_limits<long long>::max());
  if (!is_one_piece || !is_as_in_memory || !offset) return std::nullopt;
  const std::size_t end_of_element = std::size_t(data[0].data() + data[0].size() + 1 - beginning.data());
  const std::size_t underscore = beginning.find('_', end_of_element);
  const std::size_t size_of_length =
      xml_attribute(files[0], "header_type") == "UInt64" ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
  if (underscore == std::string::npos) return std::nullopt;
  const std::size_t place = underscore + 1 + std::size_t(*offset);
  if (length_of_array(path, place, size_of_length) != count * size_of_sample(type)) return std::nullopt;
  return Raw_data{path, place + size_of_length};
}

} // namespace

std::optional<Raw_data> find_raw_data(const std::string& path, Volume_format format, std::size_t type,
                                      std::size_t count) {
  if (is_gzip(path)) return std::nullopt;
  const auto data = format == Volume_format::META    ? in_meta_image(path)
                    : format == Volume_format::NRRD  ? in_NRRD(path)
                    : format == Volume_format::NIFTI ? in_NIfTI(path, type)
                    : format == Volume_format::VTI   ? in_VTI(path, type, count)
                                                     : std::nullopt;
  if (!data) return std::nullopt;
  std::error_code error;
  const auto size = fs::file_size(data->path, error);
  return !error && size >= data->first && (size - data->first) / size_of_sample(type) >= count ? data : std::nullopt;
}

} // namespace equiaffine
