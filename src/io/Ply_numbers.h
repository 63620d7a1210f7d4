// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_IO_PLY_NUMBERS_H
#define EQUIAFFINE_SRC_IO_PLY_NUMBERS_H

#include "io/Ply_header.h"
#include "io/text_input.h"
#include <equiaffine/base/internal/bit_cast.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

/// The numbers after the header of a PLY file, read from the first to the last. Each comes out as a double, which holds
/// the numbers of all types of PLY exactly.
class Ply_numbers {
public:
  Ply_numbers(std::string_view text, Ply_encoding encoding, const std::string& name)
      : rest_(text), encoding_(encoding), name_(name) {}

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    fail_to_read(name_, reason, advice);
  }

  /// Fails before memory is taken if the rest of the file cannot hold as many elements as the header announces.
  void check_length(const Ply_element& element) const {
    if (!element.properties.empty() && element.count > rest_.size()) fail_at_end();
  }

  double next(Ply_type type) {
    if (encoding_ == Ply_encoding::ASCII) return next_word();
    switch (type) {
    case Ply_type::INT8: return next_binary<std::int8_t>();
    case Ply_type::UINT8: return next_binary<std::uint8_t>();
    case Ply_type::INT16: return next_binary<std::int16_t>();
    case Ply_type::UINT16: return next_binary<std::uint16_t>();
    case Ply_type::INT32: return next_binary<std::int32_t>();
    case Ply_type::UINT32: return next_binary<std::uint32_t>();
    case Ply_type::FLOAT: return double(next_binary<float>());
    default: return next_binary<double>();
    }
  }

  /// Replaces `list` by the numbers of a list property.
  void next_list(const Ply_property& property, std::vector<double>& list) {
    const double count = next(*property.count_type);
    if (!(count >= 0 && count <= double(rest_.size()))) fail_at_end();
    list.clear();
    for (double i = 0; i < count; ++i) list.push_back(next(property.type));
  }

  /// Passes over all elements of a kind that nobody asks for.
  void skip(const Ply_element& element) {
    std::vector<double> list;
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Ply_property& property : element.properties)
        if (property.count_type) next_list(property, list);
        else next(property.type);
  }

private:
  [[noreturn]] void fail_at_end() const {
    fail("it ends before all the numbers that its header announces", "get the complete file again");
  }

  double next_word() {
    const std::string_view word = take_word(rest_);
    if (word.empty()) fail_at_end();
    const std::optional<double> value = parse_number<double>(word);
    if (!value) fail(std::string("'").append(word).append("' is not a number"), "correct the file");
    return *value;
  }

  template <class Number>
  Number next_binary() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) fail_at_end();
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    const bool is_big_endian = encoding_ == Ply_encoding::BINARY_BIG_ENDIAN;
    if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    return bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  Ply_encoding encoding_;
  const std::string& name_;
};

} // namespace equiaffine::internal

#endif
