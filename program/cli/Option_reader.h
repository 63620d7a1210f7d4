// SPDX-License-Identifier: GPL-3.0-or-later
// Turns options into a request, by their rows in the table.
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

  /// Reads the options that are given among these.
  void read(std::initializer_list<const char*> options);

  /// Reads all other given options, in the order of the table.
  void read_rest();

  /// Throws if one of the options is given.
  void refuse(std::initializer_list<const char*> options, const std::string& reason, const std::string& advice) const;

  /// Throws if the option is not given.
  void need(const std::string& option, const std::string& advice) const;

private:
  void read(const Option_row& row);

  const Command_line& line_;
  std::set<std::string> names_read_;
  Request request_;
};

/// The files that the command line reads, including those named by headers of volumes.
std::vector<std::string> input_files(const Option_reader& reader);

/// Throws if an output would overwrite an input or another output.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::optional<std::string>>& outputs);

/// Throws if there is no `--output`.
void need_output(const Option_reader& reader);

/// Throws for options of a picture without `--png`.
void refuse_picture_options(const Option_reader& reader);

/// Throws for options of pages and pictures without `--html` and `--png`.
void refuse_page_options(const Option_reader& reader);

/// Reads the options of the source, and checks that they are consistent.
void read_source(Option_reader& reader);

/// Reads the command line of `register`: the word `to` separates the two sources; options that belong to neither source
/// are accepted on both sides. Throws `Input_error`.
Request parse_register_options(const Words& arguments);

void read_symmetries_options(Option_reader& reader);

} // namespace equiaffine

#endif
