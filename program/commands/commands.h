// SPDX-License-Identifier: GPL-3.0-or-later
// The program, its commands, and the parts of them that bindings call.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_COMMANDS_H
#define EQUIAFFINE_PROGRAM_COMMANDS_COMMANDS_H

#include "output/Outputs.h"
#include "request/Request.h"
#include "source/source.h"
#include "system/progress.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// The streams for messages. Data for standard output are written elsewhere.
struct Streams {
  std::ostream& out;
  std::ostream& error;
  bool error_is_terminal = false; ///< if true, a long computation shows its progress there
};

/// Runs the program with the arguments (without the program's name) and returns the exit status: 0 for success; 2 for
/// an error of the user, which is written to `error` in one line, plus an excerpt of the input if it helps; 1 for a
/// defect of the program.
int run(const std::vector<std::string>& arguments, const Streams& streams);

// Each command writes all its outputs or none, and a summary to `out` unless an output goes to standard output. They
// throw Input_error.
void run_mesh(const Request& options, std::ostream& out, Progress& progress);
void run_evaluate(const Request& options, std::ostream& out, Progress& progress);
void run_sample(const Request& options, std::ostream& out, Progress& progress);
void run_annotate(const Request& options, std::ostream& out, Progress& progress);
void run_register(const Request& options, std::ostream& out, Progress& progress);
void run_symmetries(const Request& options, std::ostream& out, Progress& progress);
void run_view(const Request& options, std::ostream& out);

/// The attributes of a source at the points of a mesh, or at points alone, and the requested estimates. Points at
/// infinity are OUTSIDE.
Vertex_attributes evaluate_points(const Request& options, const Source& source,
                                  const Indexed_triangle_mesh_3<Kernel>& at, Progress& progress);

/// Writes the requested page and picture of a mesh, and returns them. Throws `Input_error`, also for a page of a mesh
/// without faces, and for a missing attribute.
Outputs show(const Annotated_mesh_3<Kernel>& surface, const std::string& name, const Request& options);

} // namespace equiaffine

#endif
