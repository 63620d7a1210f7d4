// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_task_entries.h"
#include <equiaffine/attributes/attributes.h>

#include <CGAL/tags.h>

#include <type_traits>

namespace equiaffine {

namespace {

template <class Traits>
Vertex_attributes compute_with_library(const Attribute_task<Traits>& task) {
  const double isovalue = 0; // attributes do not depend on it
  const Level_set_traits_3<Traits> level_set(task.function, isovalue, task.orientation);
  return compute_attributes<CGAL::Parallel_if_available_tag>(
      level_set, task.points, task.selection, task.sampled_status, parameters::estimator(task.estimator));
}

template <class... Traits>
constexpr std::tuple<Attribute_function<Traits>...> functions_for(std::type_identity<std::variant<Traits...>>) {
  return {compute_with_library<Traits>...};
}

constexpr Attribute_functions functions = functions_for(std::type_identity<Source_function>());

} // namespace

} // namespace equiaffine

const equiaffine::Attribute_functions& EQUIAFFINE_ENTRY() { return equiaffine::functions; }
