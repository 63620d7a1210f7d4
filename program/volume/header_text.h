// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the beginnings of volume files, also of compressed ones, and splits the text of headers into fields and
// numbers.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_HEADER_TEXT_H
#define EQUIAFFINE_PROGRAM_VOLUME_HEADER_TEXT_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// The first bytes of a file, at most `size`; those of a file that gzip compressed are decompressed.
std::string beginning_of(const std::string& path, std::size_t size);

/// Reads bytes of a file, decompressed if gzip compressed it, from a place on; returns whether it has them.
bool read_decompressed(const std::string& path, std::size_t first, std::size_t size, char* bytes);

/// The number of bytes in a file, decompressed if gzip compressed it; nothing if it cannot be decompressed to its end.
std::optional<double> decompressed_size(const std::string& path);

/// How much of a MetaImage or NRRD file is read as its header.
constexpr std::size_t longest_header = 1 << 20;

/// Whether gzip compressed a file.
bool is_gzip(const std::string& path);

/// Removes the first line from a text and returns it without the spaces at its ends.
std::string_view take_line(std::string_view& text);

/// A line of a MetaImage header: a name and, behind = or :, its content.
struct Meta_field {
  std::string_view name, content;
};

/// The field that a line of a MetaImage header holds, or nothing if it has no separator.
std::optional<Meta_field> meta_field(std::string_view line);

/// The content of an attribute of an XML element, or nothing if the element has none of that name.
std::optional<std::string_view> xml_attribute(std::string_view element, std::string_view name);

/// The words of a text, which spaces, tabs and ends of lines separate.
std::vector<std::string_view> words_of(std::string_view text);

/// The finite number that a text is, and nothing but that.
std::optional<double> to_number(std::string_view text);

/// The integer in [lowest, highest] that a text is, and nothing but that.
std::optional<long long> to_integer(std::string_view text, long long lowest, long long highest);

/// The finite numbers that a text is, separated by spaces; nothing if there are not exactly `count`.
std::optional<std::vector<double>> to_numbers(std::string_view text, std::size_t count);

/// Throws `Input_error` that says what a field of a header holds and gives the advice.
[[noreturn]] void fail_at_field(const std::string& path, std::string_view field, std::string_view content,
                                const std::string& advice);

} // namespace equiaffine

#endif
