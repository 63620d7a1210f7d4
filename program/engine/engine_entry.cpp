// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/engine_entries.h"
#include "engine/engine_with_library.h"

#include <type_traits>

const equiaffine::Vectorized_engines* EQUIAFFINE_ENTRY() {
  static constexpr equiaffine::Vectorized_engines engines =
      equiaffine::engines_with_library(std::type_identity<equiaffine::Vectorized_function>());
  return &engines;
}
