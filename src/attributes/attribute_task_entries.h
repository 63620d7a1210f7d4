// SPDX-License-Identifier: GPL-3.0-or-later
// Where attribute_task_entry.cpp is entered, which is compiled once per instruction set. The names are those of C, so
// that the build can tell them from everything else in the object files, see CMakeLists.txt.
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_ENTRIES_H
#define EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_ENTRIES_H

#include "attributes/attribute_task.h"

extern "C" {
void equiaffine_attributes_baseline(const equiaffine::Attribute_task& task, equiaffine::Vertex_attributes& result);
void equiaffine_attributes_avx2(const equiaffine::Attribute_task& task, equiaffine::Vertex_attributes& result);
void equiaffine_attributes_avx512(const equiaffine::Attribute_task& task, equiaffine::Vertex_attributes& result);
}

#endif
