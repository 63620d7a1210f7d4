// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_H
#define EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_H

#include "source/source_function.h"
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/attributes.h>
#include <equiaffine/geometry/Estimator.h>

#include <span>
#include <vector>

namespace equiaffine {

/// What compute_attributes needs: points of level sets of f, which pass through them whatever the value there.
struct Attribute_task {
  const Source_function& function;
  Orientation_of_level_set orientation;
  std::span<const Kernel::Point_3> points;
  const Attribute_selection& selection;
  Estimator estimator = Estimator::COMPACT;
  std::span<const Point_status> sampled_status = {}; ///< empty, or one per point
};

/// Which vector instructions are used. All have the same results, bit for bit.
enum class Instruction_set { BASELINE, AVX2, AVX512 };

/// Those that this program was compiled for and this processor has, the narrowest first.
std::vector<Instruction_set> instruction_sets();

/// compute_attributes of the library, with all threads.
Vertex_attributes compute_attributes(const Attribute_task& task, Instruction_set set = instruction_sets().back());

} // namespace equiaffine

#endif
