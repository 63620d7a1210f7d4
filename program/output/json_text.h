// SPDX-License-Identifier: GPL-3.0-or-later
// The beginning and the text of the JSON objects that the program writes.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_JSON_TEXT_H
#define EQUIAFFINE_PROGRAM_OUTPUT_JSON_TEXT_H

#include <nlohmann/json.hpp>

#include <string>

namespace equiaffine {

using Json = nlohmann::ordered_json;

/// Begins an object of the program with its version and the source.
inline Json begin_JSON(const std::string& source) { return {{"equiaffine", EQUIAFFINE_VERSION}, {"source", source}}; }

/// Texts come from the command line and need not be UTF-8.
inline std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

} // namespace equiaffine

#endif
