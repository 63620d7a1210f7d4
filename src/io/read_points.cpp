// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/Csv_scanner.h"
#include "io/Off_scanner.h"
#include "io/text_input.h"
#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

Vertex_attributes merge_attributes(Vertex_attributes first, const Vertex_attributes& second) {
  std::erase_if(first.columns, [&](const auto& old) {
    return std::any_of(second.columns.begin(), second.columns.end(), [&](const auto& c) { return c.name == old.name; });
  });
  first.columns.insert(first.columns.end(), second.columns.begin(), second.columns.end());
  if (second.status) first.status = second.status;
  const auto name = [](const std::string& comment) { return comment.substr(0, comment.find(':')); };
  std::erase_if(first.comments, [&](const auto& old) {
    return std::any_of(second.comments.begin(), second.comments.end(),
                       [&](const auto& c) { return name(c) == name(old); });
  });
  first.comments.insert(first.comments.end(), second.comments.begin(), second.comments.end());
  return first;
}

namespace internal {

const char* extension_of_text(std::string_view text) {
  const std::string_view word = take_word(text);
  return word == "ply" ? ".ply" : end_of_OFF_keyword(word) > 0 ? ".off" : ".csv";
}

std::vector<std::size_t> columns_to_keep(const std::vector<std::string>& header, const Vertex_attributes& attributes) {
  std::vector<std::size_t> kept;
  for (std::size_t column = 0; column < header.size(); ++column) {
    const std::string name = unquote(header[column]);
    const bool is_replaced =
        (name == "status" && attributes.status) || std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                                               [&](const auto& c) { return c.name == name; });
    if (!is_replaced) kept.push_back(column);
  }
  return kept;
}

} // namespace internal

} // namespace equiaffine
