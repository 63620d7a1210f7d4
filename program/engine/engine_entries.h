// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of engine_entry.cpp, which is compiled once per instruction set. The names are those of C, so that the
// build can tell them from everything else in the object files, see CMakeLists.txt.
#ifndef EQUIAFFINE_PROGRAM_ENGINE_ENGINE_ENTRIES_H
#define EQUIAFFINE_PROGRAM_ENGINE_ENGINE_ENTRIES_H

#include "engine/Engine.h"

extern "C" {
const equiaffine::Vectorized_engines* equiaffine_engines_baseline();
const equiaffine::Vectorized_engines* equiaffine_engines_avx2();
const equiaffine::Vectorized_engines* equiaffine_engines_avx512();
}

#endif
