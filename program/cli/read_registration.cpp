// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/Option_reader.h"
#include "cli/parse_options.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace equiaffine {

namespace {

constexpr const char* usage = "write 'equiaffine register SOURCE to SOURCE -o MAP.json'";

/// The number of words that an option takes whatever they look like; 0 if the word is not an option.
std::size_t words_taken(const std::string& word) {
  for (const Option_row* row : options_of(REGISTER)) {
    if (row->has_name(word)) return std::size_t(row->words.least);
    if (word.starts_with("--") && row->has_name(word.substr(0, word.find('='))))
      return std::size_t(std::max(row->words.least, 1)) - 1;
  }
  return 0;
}

/// The word `to` between the sources; values of options are skipped. The end if there is none.
Words::const_iterator find_to(const Words& arguments) {
  auto word = arguments.begin();
  while (word != arguments.end() && *word != "to")
    word += std::min<std::ptrdiff_t>(1 + std::ptrdiff_t(words_taken(*word)), arguments.end() - word);
  return word;
}

/// Moves the options that belong to neither source to the line of the first one.
void move_common_options(Command_line& from, Command_line& to) {
  for (const Option_row* row : options_of(REGISTER)) {
    if (belongs_to_source(row->group) || !from.has(row->name())) continue;
    if (to.has(row->name())) fail_option(row->name(), "it is given more than once", "give it once");
    to.options.insert(from.options.extract(row->name()));
  }
}

void read_surface(Option_reader& reader) {
  read_source(reader);
  reader.read({"level"});
  Source_options& source = reader.request().source;
  if (source.spline.spline_scheme == Spline_scheme::PAPER)
    fail_option("spline_scheme", "paper does not define a function, which maps need", "use quasi-interpolation");
  source.spline.level = source.level;
  source.is_registered = true;
}

/// Reads the remaining options, and checks those of the page and the picture.
void read_outputs(Option_reader& reader, std::initializer_list<std::string_view> colors) {
  need_output(reader);
  refuse_picture_options(reader);
  refuse_page_options(reader);
  reader.read_rest();
  const std::string& color = reader.request().display.color;
  if (!color.empty() && std::find(colors.begin(), colors.end(), color) == colors.end())
    fail_option("color", "unknown value '" + color + "'", "use distance or plain");
}

} // namespace

Request read_options(const Command_line& source, const Command_line& target) {
  Option_reader reader(source), target_reader(target);
  reader.read({"threads"});
  read_surface(reader);
  read_surface(target_reader);
  Request& request = reader.request();
  request.target = target_reader.request().source;
  if (!reader.writes_files()) {
    reader.read_rest();
    return request;
  }
  if (request.source.text == "-" && request.target.text == "-")
    throw Input_error("both sources read standard input; name a file for one of them");
  read_outputs(reader, {"distance", "surface", "plain"});
  std::vector<std::string> inputs = input_files(reader);
  for (const std::string& file : input_files(target_reader)) inputs.push_back(file);
  check_outputs(inputs, {request.output, request.moved, request.display.html, request.display.png});
  for (const auto* side : {&request.source, &request.target}) choose_up(side->kind, request.display);
  return request;
}

Request parse_register_options(const Words& arguments) {
  const auto to = find_to(arguments);
  Command_line line = split_command_line(Words(arguments.begin(), to));
  if (line.information) return Option_reader(line).request();
  if (to == arguments.end())
    throw Input_error(std::string("the word 'to' between the two sources is missing; ") + usage);
  Words rest = {arguments.front()};
  rest.insert(rest.end(), to + 1, arguments.end());
  Command_line target = split_command_line(rest);
  if (target.information) return Option_reader(target).request();
  move_common_options(target, line);
  return read_options(line, target);
}

void read_symmetries_options(Option_reader& reader) {
  read_surface(reader);
  if (!reader.writes_files()) return reader.read_rest();
  read_outputs(reader, {"distance", "surface", "plain"});
  Request& request = reader.request();
  check_outputs(input_files(reader), {request.output, request.display.html, request.display.png});
  choose_up(request.source.kind, request.display);
}

} // namespace equiaffine
