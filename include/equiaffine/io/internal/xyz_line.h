// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_XYZ_LINE_H
#define EQUIAFFINE_IO_INTERNAL_XYZ_LINE_H

#include <equiaffine/io/internal/shared/fail_to_read.h>
#include <equiaffine/io/internal/text_input.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

/// The numbers in a line. Fails if there is a word that is none.
inline std::vector<double> numbers_of_line(std::string_view line, const std::string& where, const std::string& name) {
  std::vector<double> numbers;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::optional<double> number = parse_number<double>(word);
    if (!number) fail_to_read(name, where + ": '" + std::string(word) + "' is not a number", "correct it");
    numbers.push_back(*number);
  }
  return numbers;
}

} // namespace equiaffine::internal

#endif
