// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_OPTION_READER_H
#define EQUIAFFINE_PROGRAM_CLI_OPTION_READER_H

#include "cli/Draft.h"
#include "cli/command_line.h"

#include <initializer_list>
#include <set>
#include <string>

namespace equiaffine {

/// Reads the options of a command line into a draft, by their rows in the table. Only the first error is reported, so
/// the order of the calls matters to users.
class Option_reader {
public:
  explicit Option_reader(const Command_line& line) : line_(line) {}

  Draft& draft() { return draft_; }
  const Draft& draft() const { return draft_; }

  Command command() const { return line_.command; }
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
  Draft draft_;
};

} // namespace equiaffine

#endif
