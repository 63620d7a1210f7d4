// SPDX-License-Identifier: GPL-3.0-or-later
// The first members and the text of the JSON objects of the program.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_JSON_TEXT_H
#define EQUIAFFINE_PROGRAM_OUTPUT_JSON_TEXT_H

#include <nlohmann/json.hpp>

#include <string>

namespace equiaffine {

using Json = nlohmann::ordered_json;

/// An object with the version of the program and the source.
inline Json begin_JSON(const std::string& source) { return {{"equiaffine", EQUIAFFINE_VERSION}, {"source", source}}; }

/// Replaces invalid UTF-8, since texts come from the command line.
inline std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

} // namespace equiaffine

#endif
