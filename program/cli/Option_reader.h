// SPDX-License-Identifier: GPL-3.0-or-later
// How options become a request, by their rows in the table.
#ifndef EQUIAFFINE_PROGRAM_CLI_OPTION_READER_H
#define EQUIAFFINE_PROGRAM_CLI_OPTION_READER_H

#include "cli/command_line.h"

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace equiaffine {

/// Reads options into a request, by their rows in the table. Only the first error is reported, so the order of the
/// calls matters to users.
class Option_reader {
public:
  explicit Option_reader(const Command_line& line) : line_(line) {
    request_.command = line.command;
    request_.information = line.information;
  }

  Request& request() { return request_; }
  const Request& request() const { return request_; }

  Command command() const { return line_.command; }
  bool writes_files() const { return line_.writes_files; }
  bool has(const std::string& option) const { return line_.has(option); }
  const std::string& word(const std::string& option) const { return line_.word(option); }

  /// Reads those of the options that are given.
  void read(std::initializer_list<const char*> options);

  /// Reads all options that are given and were not read yet, in the order of the table.
  void read_rest();

  /// Throws for an option that is given.
  void refuse(std::initializer_list<const char*> options, const std::string& reason, const std::string& advice) const;

  /// Throws for an option that is not given.
  void need(const std::string& option, const std::string& advice) const;

private:
  void read(const Option_row& row);

  const Command_line& line_;
  std::set<std::string> names_read_;
  Request request_;
};

/// The paths of the files that the command line says to read, and of those that the headers of volumes among them name.
std::vector<std::string> input_files(const Option_reader& reader);

/// Throws if an output would replace what is read, or another output.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::optional<std::string>>& outputs);

/// Throws if there is no `--output`.
void need_output(const Option_reader& reader);

/// Throws for options of a picture without `--png`.
void refuse_picture_options(const Option_reader& reader);

/// Throws for options of a page and of a picture without either.
void refuse_page_options(const Option_reader& reader);

/// Reads the options of the source, and checks that they go together.
void read_source(Option_reader& reader);

/// Reads the command line of `register`: one source stands before the word `to`, the other one after it, and options
/// that belong to neither may stand on both sides. Throws `Input_error`.
Request parse_register_options(const Words& arguments);

void read_symmetries_options(Option_reader& reader);

} // namespace equiaffine

#endif
