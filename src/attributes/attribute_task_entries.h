// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of attribute_task_entry.cpp, which is compiled once per instruction set. The names are those of C, so
// that the build can tell them from everything else in the object files, see CMakeLists.txt.
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_ENTRIES_H
#define EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_ENTRIES_H

#include "attributes/attribute_task.h"

extern "C" {
const equiaffine::Attribute_functions& equiaffine_attributes_baseline();
const equiaffine::Attribute_functions& equiaffine_attributes_avx2();
const equiaffine::Attribute_functions& equiaffine_attributes_avx512();
}

#endif
