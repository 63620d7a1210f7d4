// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_task.h"

#include "attributes/attribute_task_entries.h"

namespace equiaffine {

std::vector<Instruction_set> instruction_sets() {
  std::vector<Instruction_set> sets = {Instruction_set::BASELINE};
#ifdef EQUIAFFINE_WITH_INSTRUCTION_SETS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(Instruction_set::AVX2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
      sets.push_back(Instruction_set::AVX512);
  }
#endif
  return sets;
}

Vertex_attributes compute_attributes(const Attribute_task& task, [[maybe_unused]] Instruction_set set) {
  Vertex_attributes result;
#ifdef EQUIAFFINE_WITH_INSTRUCTION_SETS
  if (set == Instruction_set::AVX512) equiaffine_attributes_avx512(task, result);
  else if (set == Instruction_set::AVX2) equiaffine_attributes_avx2(task, result);
  else equiaffine_attributes_baseline(task, result);
#else
  equiaffine_attributes_baseline(task, result);
#endif
  return result;
}

} // namespace equiaffine
