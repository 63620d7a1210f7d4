// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/header_text.h"

#include "volume/volume_formats.h"
#include <equiaffine/base/Input_error.h>

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <memory>
#include <system_error>

namespace equiaffine {

namespace {

constexpr std::string_view spaces = " \t\r\n";

using Gzip_file = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

/// zlib also reads uncompressed files.
Gzip_file open_gzip(const std::string& path) { return {gzopen(path.c_str(), "rb"), gzclose}; }

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number number;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

} // namespace

std::string beginning_of(const std::string& path, std::size_t size) {
  const Gzip_file file = open_gzip(path);
  std::string bytes(size, '\0');
  const int count = file ? gzread(file.get(), bytes.data(), unsigned(size)) : 0;
  bytes.resize(std::size_t(std::max(count, 0)));
  return bytes;
}

bool read_decompressed(const std::string& path, std::size_t first, std::size_t size, char* bytes) {
  constexpr std::size_t most_at_once = 1 << 30;
  const Gzip_file file = open_gzip(path);
  if (!file || gzseek(file.get(), z_off_t(first), SEEK_SET) < 0) return false;
  for (std::size_t done = 0, count; done < size; done += count) {
    count = std::min(size - done, most_at_once);
    if (gzread(file.get(), bytes + done, unsigned(count)) != int(count)) return false;
  }
  return true;
}

std::optional<double> decompressed_size(const std::string& path) {
  const Gzip_file file = open_gzip(path);
  if (!file) return std::nullopt;
  std::string bytes(std::size_t(1) << 20, '\0');
  double size = 0;
  int count = 0;
  while ((count = gzread(file.get(), bytes.data(), unsigned(bytes.size()))) > 0) size += count;
  int error = Z_OK;
  gzerror(file.get(), &error);
  if (error != Z_OK) return std::nullopt;
  return size;
}

bool is_gzip(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return file.get() == 0x1f && file.get() == 0x8b;
}

std::optional<Meta_field> meta_field(std::string_view line) {
  constexpr std::string_view separators = "=:";
  const std::size_t at = line.find_first_of(separators);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view name = line.substr(0, at), content = line.substr(at);
  content.remove_prefix(std::min(content.find_first_not_of("=: \t"), content.size())); // as the MetaIO library does
  return Meta_field{take_line(name), take_line(content)};
}

std::string_view take_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

std::optional<std::string_view> xml_attribute(std::string_view element, std::string_view name) {
  for (std::size_t at = 0; (at = element.find(name, at)) != std::string_view::npos; ++at) {
    std::string_view rest = element.substr(at + name.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    if (at == 0 || std::string_view(" \t\r\n").find(element[at - 1]) == std::string_view::npos ||
        !rest.starts_with('='))
      continue;
    rest.remove_prefix(1);
    rest.remove_prefix(std::min(rest.find_first_of("\"'"), rest.size()));
    if (rest.empty()) return std::nullopt;
    const std::size_t end = rest.find(rest[0], 1);
    if (end == std::string_view::npos) return std::nullopt;
    return rest.substr(1, end - 1);
  }
  return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
    if (text.empty()) return words;
    words.push_back(text.substr(0, text.find_first_of(spaces)));
    text.remove_prefix(words.back().size());
  }
}

std::optional<double> to_number(std::string_view text) {
  const std::optional<double> number = parse<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<long long> to_integer(std::string_view text, long long lowest, long long highest) {
  const std::optional<long long> number = parse<long long>(text);
  return number && lowest <= *number && *number <= highest ? number : std::nullopt;
}

std::optional<std::vector<double>> to_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text)) {
    const std::optional<double> number = to_number(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

void fail_at_field(const std::string& path, std::string_view field, std::string_view content,
                   const std::string& advice) {
  constexpr std::size_t longest = 60;
  const std::string text = printable(content.substr(0, longest)) + (content.size() > longest ? "..." : "");
  fail_to_read_volume(path, "its header has " + std::string(field) + " '" + text + "'", advice);
}

} // namespace equiaffine
