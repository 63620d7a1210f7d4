// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/data_files.h"

#include "volume/header_text.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cstddef>
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

/// The bytes of the files in a folder whose names have this beginning and this end.
double size_of_files(const fs::path& folder, std::string_view beginning, std::string_view end) {
  double size = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), none; !error && entry != none; entry.increment(error))
    if (const std::string name = entry->path().filename(); name.starts_with(beginning) && name.ends_with(end))
      size += size_of_file(entry->path());
  return size;
}

/// The bytes of a file, or of all files that a name with a conversion such as %03d may stand for.
double size_of_data(const fs::path& path) {
  const std::string name = path.filename();
  const std::size_t percent = name.find('%');
  if (percent == std::string::npos) return size_of_file(path);
  const std::size_t letter = std::min(name.find_first_not_of("0123456789", percent + 1), name.size() - 1);
  return size_of_files(path.parent_path(), name.substr(0, percent), name.substr(letter + 1));
}

/// The files with the data that a MetaImage or NRRD header names. The header of NRRD ends with an empty line.
std::vector<std::string> data_files_of(const std::string& path, Volume_format format) {
  const std::string header = beginning_of(path, longest_header);
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    if (format == Volume_format::NRRD && line.empty()) return {};
    for (const std::string_view field : {"ElementDataFile", "data file:", "datafile:"})
      if (boost::istarts_with(line, field)) {
        std::string_view content = line.substr(std::min(line.find_first_of("=:"), line.size() - 1) + 1);
        return data_files_in(take_line(content), rest);
      }
  }
  return {};
}

} // namespace

std::vector<std::string> data_files_in(std::string_view content, std::string_view following_lines) {
  if (content == "LOCAL" || content == "Local" || content == "local") return {};
  if (content.find('%') != std::string_view::npos) return {std::string(words_of(content).front())};
  if (!content.starts_with("LIST")) return {std::string(content)};
  std::vector<std::string> names;
  while (!following_lines.empty())
    if (const std::string_view name = take_line(following_lines); !name.empty()) names.emplace_back(name);
  return names;
}

double size_of_volume(const std::string& path, std::optional<Volume_format> format) {
  if (!format) return size_of_files(path, "", "");
  double size = size_of_file(path);
  std::error_code error;
  const bool has_header = *format == Volume_format::META || *format == Volume_format::NRRD;
  if (has_header && fs::is_regular_file(path, error))
    for (const std::string& name : data_files_of(path, *format))
      size += size_of_data(fs::absolute(path).parent_path() / name);
  return size;
}

} // namespace equiaffine
