// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_COMMANDS_FAIL_WITHOUT_SURFACE_H
#define EQUIAFFINE_COMMANDS_FAIL_WITHOUT_SURFACE_H

#include "request/options.h"
#include "source/source_function.h"

#include <string>

namespace equiaffine {

/// What is known of a search for a surface that found none.
struct Vain_search {
  std::string place;         ///< where it was looked for, "box" or "ball"
  std::string refinement;    ///< what may find more of the surface, such as "a smaller --radius"; empty if nothing can
  bool met_poles;            ///< whether f changes its sign at poles or jumps only
  bool is_certified = false; ///< whether it is proved that there is none
};

/// Whether f - isovalue changes its sign between the nodes of a grid at poles and jumps, and nowhere else.
bool changes_sign_at_poles_only(const Source_function& function, double isovalue);

/// Throws the error that says why there is no surface, and what to choose instead.
[[noreturn]] void fail_without_surface(const Source_function& function, const Source_options& source, double isovalue,
                                       const Vain_search& search);

} // namespace equiaffine

#endif
