// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/Engine.h"

#include "engine/engine_entries.h"
#include "engine/engine_with_library.h"

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

const Vectorized_engines& vectorized_engines([[maybe_unused]] Instruction_set set) {
#ifdef EQUIAFFINE_WITH_INSTRUCTION_SETS
  if (set == Instruction_set::AVX512) return *equiaffine_engines_avx512();
  if (set == Instruction_set::AVX2) return *equiaffine_engines_avx2();
#endif
  return *equiaffine_engines_baseline();
}

const Engine<Fit_function>& fit_engine() {
  static constexpr Engine<Fit_function> engine = engine_with_library<Fit_function>();
  return engine;
}

} // namespace equiaffine
