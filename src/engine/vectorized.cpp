// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/Engine.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/engine/vectorized.h>

#include <algorithm>

namespace equiaffine::vectorized {

namespace {

template <class Function>
const Engine<Function>& engine(Instruction_set set) {
  const auto sets = instruction_sets();
  check_argument(std::find(sets.begin(), sets.end(), set) != sets.end(),
                 "this instruction set is not supported by the processor or the build: use one of instruction_sets()");
#ifdef EQUIAFFINE_WITH_AVX512
  if (set == Instruction_set::AVX512) return std::get<Engine<Function>>(*equiaffine_engines_avx512());
#endif
#ifdef EQUIAFFINE_WITH_AVX2
  if (set == Instruction_set::AVX2) return std::get<Engine<Function>>(*equiaffine_engines_avx2());
#endif
  return std::get<Engine<Function>>(*equiaffine_engines_baseline());
}

} // namespace

std::vector<Instruction_set> instruction_sets() {
  std::vector<Instruction_set> sets = {Instruction_set::BASELINE};
#ifdef EQUIAFFINE_WITH_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(Instruction_set::AVX2);
#endif
#ifdef EQUIAFFINE_WITH_AVX512
  if (__builtin_cpu_supports("fma") && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    sets.push_back(Instruction_set::AVX512);
#endif
  return sets;
}

Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Formula>& level_set, const Marching_cubes_options& options,
                                    Instruction_set set) {
  return engine<Formula>(set).marching_cubes(level_set, options);
}

Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Spline>& level_set, const Marching_cubes_options& options,
                                    Instruction_set set) {
  return engine<Spline>(set).marching_cubes(level_set, options);
}

Vertex_attributes compute_attributes(const Level_set_traits_3<Formula>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled, Instruction_set set) {
  return engine<Formula>(set).compute_attributes(level_set, points, selection, sampled);
}

Vertex_attributes compute_attributes(const Level_set_traits_3<Spline>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled, Instruction_set set) {
  return engine<Spline>(set).compute_attributes(level_set, points, selection, sampled);
}

double max_distance_to_surface(const Level_set_traits_3<Formula>& level_set, std::span<const Kernel::Point_3> points,
                               std::span<const Point_status> status, Instruction_set set) {
  return engine<Formula>(set).max_distance_to_surface(level_set, points, status);
}

double max_distance_to_surface(const Level_set_traits_3<Spline>& level_set, std::span<const Kernel::Point_3> points,
                               std::span<const Point_status> status, Instruction_set set) {
  return engine<Spline>(set).max_distance_to_surface(level_set, points, status);
}

} // namespace equiaffine::vectorized
