// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_OUTPUTS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_OUTPUTS_H

#include "request/options.h"
#include "system/atomic_file.h"

#include <CGAL/assertions.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace equiaffine {

/// The purposes of the files that commands write.
enum class Output_kind { RESULT, PAGE, PICTURE, CURVES, MOVED, STATISTICS };

/// The output files of a command, of which all appear or none.
class Outputs {
public:
  Outputs() = default;

  /// Adds the result, then page and picture, as far as they are asked for.
  Outputs(const std::string& result, const Display_options& display);

  /// Throws `Input_error` if the file cannot be written, which is to be known before a long computation. Without a path
  /// there is no such output.
  void add(Output_kind kind, const std::optional<std::string>& path);

  /// Adds page and picture, as far as they are asked for.
  void add_displays(const Display_options& options);

  /// Forgets the file of that kind, if there is one, so that nothing is written.
  void remove(Output_kind kind);

  /// The file of that kind, or null.
  Output_file* find(Output_kind kind);

  /// The file of that kind. \pre it was added.
  Output_file& operator[](Output_kind kind) {
    CGAL_precondition(find(kind) != nullptr);
    return *find(kind);
  }

  /// Ends writing to all files but that of the statistics, which tell how long it took.
  void close_results();

  /// Ends writing and puts all files in place. Throws `Input_error` if one could not be stored, and then leaves what was
  /// there.
  void commit();

  /// Whether one of them is standard output, where nothing else may be written then.
  bool use_standard_output() const { return equiaffine::use_standard_output(files_); }

  /// Tells people which files were written, in the order in which they were added, a line each.
  void report(std::ostream& out) const { report_written(out, files_); }

private:
  std::vector<Output_kind> kinds_;
  std::vector<Output_file> files_;
};

} // namespace equiaffine

#endif
