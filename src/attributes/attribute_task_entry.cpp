// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_task_entries.h"
#include "attributes/compute_with_library.h"

#include <type_traits>

namespace equiaffine {

namespace {

template <class... Traits>
constexpr std::tuple<Attribute_function<Traits>...> functions_for(std::type_identity<std::variant<Traits...>>) {
  return {compute_with_library<Traits>...};
}

constexpr Attribute_functions functions = functions_for(std::type_identity<Vectorized_function>());

} // namespace

} // namespace equiaffine

const equiaffine::Attribute_functions& EQUIAFFINE_ENTRY() { return equiaffine::functions; }
