// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/data_files.h"

#include "volume/header_text.h"
#include <equiaffine/base/internal/printable.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <charconv>
#include <climits>
#include <filesystem>
#include <system_error>

namespace equiaffine {

namespace {

namespace fs = std::filesystem;

double size_of_file(const fs::path& path) {
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  return error ? 0 : double(bytes);
}

/// What a pattern such as slice%03d.raw says of the numbers in the names.
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

/// The pattern in a word that has one %; nothing unless it stands for an integer.
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

/// The names for the numbers from a first to a last one by a step. Without these, MetaIO numbers slices from 1.
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

/// The files that a header names. The header of NRRD ends with an empty line.
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

/// Whether the way to a file, without regard to links, leads out of a folder.
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
    // "LIST 2D" says how many axes a file has, by default all but the last one.
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
                  "write one such as slice%03d.raw with the first and the last number and the step after it");
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  for (const std::string& name : files.names) {
    if (!allows_outside && leads_out_of(folder, name))
      fail_to_read_volume(path, "its header names the file '" + printable(name) + "' outside of its folder",
                          "put it beside the header, or add --allow-outside if that is right");
    if (!fs::exists(folder / name, error))
      fail_to_read_volume(path, "the file with its data, '" + printable(name) + "', is missing",
                          "put it beside the header");
    if (!fs::is_regular_file(folder / name, error))
      fail_to_read_volume(path, "'" + printable(name) + "', which its header names, is no regular file",
                          "correct the name");
  }
  if (files.expected > 0 && files.names.size() != files.expected)
    fail_to_read_volume(path,
                        "its header names " +
                            (files.names.empty() ? "no file" : std::to_string(files.names.size()) + " files") +
                            " with its data, and its sizes ask for " + std::to_string(files.expected),
                        "correct one of them");
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

} // namespace equiaffine
