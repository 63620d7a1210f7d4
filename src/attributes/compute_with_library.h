// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_COMPUTE_WITH_LIBRARY_H
#define EQUIAFFINE_SRC_ATTRIBUTES_COMPUTE_WITH_LIBRARY_H

#include "attributes/attribute_task.h"
#include <equiaffine/attributes/attributes.h>

#include <CGAL/tags.h>

namespace equiaffine {

/// Calls compute_attributes of the library, compiled for the instruction set of the file that includes this.
template <class Traits>
Vertex_attributes compute_with_library(const Attribute_task<Traits>& task) {
  const double isovalue = 0; // attributes do not depend on it
  const Level_set_traits_3<Traits> level_set(task.function, isovalue, task.orientation);
  return compute_attributes<CGAL::Parallel_if_available_tag>(
      level_set, task.points, task.selection, task.sampled_status, parameters::estimator(task.estimator));
}

} // namespace equiaffine

#endif
