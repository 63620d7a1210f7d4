// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_SIGNALS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_SIGNALS_H

namespace equiaffine {

/// From now on, every signal that ends the process and can be caught also removes the temporary folders, unless it was
/// ignored before. A signal that asks it to end (SIGINT, SIGTERM, SIGQUIT and the like) gives the exit status 128 + its
/// number. A crash (SIGSEGV, SIGABRT and the like) prints one line that asks for a report and ends as crashes do.
/// A reader of the output that goes away and a limit of file sizes become errors of writing. Call it before there are
/// threads.
void clean_up_at_signals();

/// Gives every signal its default effect again, for a child process.
void forget_signals();

} // namespace equiaffine

#endif
