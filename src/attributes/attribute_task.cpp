// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_task.h"

#include "attributes/attribute_task_entries.h"
#include "attributes/compute_with_library.h"

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

const Attribute_functions& attribute_functions([[maybe_unused]] Instruction_set set) {
#ifdef EQUIAFFINE_WITH_INSTRUCTION_SETS
  if (set == Instruction_set::AVX512) return equiaffine_attributes_avx512();
  if (set == Instruction_set::AVX2) return equiaffine_attributes_avx2();
#endif
  return equiaffine_attributes_baseline();
}

Vertex_attributes compute_attributes_of_fit(const Attribute_task<Fit_traits>& task) {
  return compute_with_library(task);
}

Vertex_attributes compute_attributes_of_fit(const Attribute_task<Transformed_function_traits_3<Fit_traits>>& task) {
  return compute_with_library(task);
}

} // namespace equiaffine
