// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/any_level_set.h"

#include <variant>

namespace equiaffine {

Any_function_3 any_level_set(const Source_function& function, double isovalue, Orientation_of_level_set orientation) {
  return std::visit([&](const auto& f) { return Any_function_3::make(Level_set_traits_3(f, isovalue, orientation)); },
                    function);
}

} // namespace equiaffine
