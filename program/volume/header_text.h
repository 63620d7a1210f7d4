// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the beginnings of volume files, also compressed ones, and parses fields and numbers of headers.
#ifndef EQUIAFFINE_PROGRAM_VOLUME_HEADER_TEXT_H
#define EQUIAFFINE_PROGRAM_VOLUME_HEADER_TEXT_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// The first bytes of a file, at most `size`, decompressed if it is a gzip file.
std::string beginning_of(const std::string& path, std::size_t size);

/// Reads `size` bytes from the offset `first` of a file, decompressed if it is a gzip file. Returns false if it is
/// shorter.
bool read_decompressed(const std::string& path, std::size_t first, std::size_t size, char* bytes);

/// The number of bytes of a file, decompressed if it is a gzip file; nothing if it cannot be decompressed completely.
std::optional<double> decompressed_size(const std::string& path);

/// The maximum length of the header of a MetaImage or NRRD file.
constexpr std::size_t longest_header = 1 << 20;

/// Whether a file is a gzip file.
bool is_gzip(const std::string& path);

/// Removes the first line of a text and returns it without surrounding spaces.
std::string_view take_line(std::string_view& text);

/// A line of a MetaImage header: a name, = or :, and its content.
struct Meta_field {
  std::string_view name, content;
};

/// The field in a line of a MetaImage header, or nothing if it has no separator.
std::optional<Meta_field> meta_field(std::string_view line);

/// The content of an attribute of an XML element, or nothing if it does not have the attribute.
std::optional<std::string_view> xml_attribute(std::string_view element, std::string_view name);

/// The words of a text, separated by spaces, tabs and line breaks.
std::vector<std::string_view> words_of(std::string_view text);

/// The whole text as a finite number.
std::optional<double> to_number(std::string_view text);

/// The whole text as an integer in [lowest, highest].
std::optional<long long> to_integer(std::string_view text, long long lowest, long long highest);

/// The whole text as `count` finite numbers, separated by spaces.
std::optional<std::vector<double>> to_numbers(std::string_view text, std::size_t count);

/// Throws `Input_error`: "cannot read the volume 'path': its header has field 'content'; advice".
[[noreturn]] void fail_at_field(const std::string& path, std::string_view field, std::string_view content,
                                const std::string& advice);

} // namespace equiaffine

#endif
