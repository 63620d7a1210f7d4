// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_task_entries.h"

void EQUIAFFINE_ENTRY(const equiaffine::Attribute_task& task, equiaffine::Vertex_attributes& result) {
  using namespace equiaffine;
  result = std::visit(
      [&](const auto& function) {
        // Any isovalue will do.
        const Level_set_traits_3 level_set(function, 0., task.orientation);
        return compute_attributes<CGAL::Parallel_if_available_tag>(
            level_set, task.points, task.selection, task.sampled_status, parameters::estimator(task.estimator));
      },
      task.function);
}
