// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_COMMANDS_H
#define EQUIAFFINE_PROGRAM_COMMANDS_COMMANDS_H

#include "request/options.h"
#include "system/progress.h"

#include <ostream>

namespace equiaffine {

// Each command writes its outputs, all of them or none, and on `out` a summary unless an output goes there. They throw
// Input_error.
void run_mesh(const Mesh_options& options, std::ostream& out, Progress& progress);
void run_evaluate(const Evaluate_options& options, std::ostream& out, Progress& progress);
void run_sample(const Sample_options& options, std::ostream& out, Progress& progress);
void run_annotate(const Annotate_options& options, std::ostream& out, Progress& progress);
void run_register(const Register_options& options, std::ostream& out, Progress& progress);
void run_symmetries(const Symmetries_options& options, std::ostream& out, Progress& progress);
void run_view(const View_options& options, std::ostream& out);

} // namespace equiaffine

#endif
