// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_IO_CSV_SCANNER_H
#define EQUIAFFINE_SRC_IO_CSV_SCANNER_H

#include "io/text_input.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

/// The text of a cell, without the quotes around it; two quotes within them stand for one.
inline std::string unquote(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"' && cell[i + 1] == '"') ++i;
  }
  return text;
}

/// The character that separates the cells of a file with this header: the one of comma, semicolon and tab that it has
/// most often.
inline char separator_of(std::string_view header) {
  const auto count = [&](char c) { return std::count(header.begin(), header.end(), c); };
  char separator = ',';
  for (const char c : {';', '\t'})
    if (count(c) > count(separator)) separator = c;
  return separator;
}

/// Takes the rows off the text of a CSV file. A quoted cell may hold separators and line ends.
class Csv_scanner {
public:
  Csv_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    const std::size_t first = std::min(rest_.find_first_not_of("\r\n"), rest_.size());
    separator_ = separator_of(rest_.substr(first, rest_.find('\n', first) - first));
  }

  /// The character between cells.
  char separator() const { return separator_; }

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    fail_to_read(name_, reason, advice);
  }

  /// The line in which the row taken last begins.
  std::size_t line_number() const { return line_number_; }

  /// Takes the next row that is not blank: its cells as they are written; none at the end of the file.
  std::vector<std::string_view> next_row() {
    Progress_observer::step();
    std::size_t end = 0;
    do {
      line_number_ = next_line_number_;
      rest_.remove_prefix(end);
      end = end_of_row();
    } while (end > 0 && trim(rest_.substr(0, end)).empty());
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return split(text);
  }

private:
  /// The length of the next row, with its line end.
  std::size_t end_of_row() {
    bool is_quoted = false;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (rest_[i] == '"') is_quoted = !is_quoted;
      if (rest_[i] != '\n') continue;
      ++next_line_number_;
      if (!is_quoted) return i + 1;
    }
    if (is_quoted) fail("line " + std::to_string(line_number_) + " opens a quote that is never closed", "close it");
    return rest_.size();
  }

  /// The cells between the separators of a row.
  std::vector<std::string_view> split(std::string_view text) const {
    if (text.ends_with('\n')) text.remove_suffix(1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    std::vector<std::string_view> cells;
    if (text.empty()) return cells;
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '"') is_quoted = !is_quoted;
      if (text[i] != separator_ || is_quoted) continue;
      cells.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
    cells.push_back(text.substr(begin));
    return cells;
  }

  std::string_view rest_;
  const std::string& name_;
  char separator_ = ',';
  std::size_t line_number_ = 1;
  std::size_t next_line_number_ = 1;
};

} // namespace equiaffine::internal

#endif
