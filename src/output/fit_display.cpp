// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/fit_display.h"

#include <optional>

namespace equiaffine {

std::string label_suffix(const Fit_statistics& fit) {
  return fit.scale ? " at scale " + number_text(*fit.scale, 3) : std::string();
}

Description description_of(const Fit_statistics& fit) {
  return {{"Scale", fit.scale ? number_text(*fit.scale, 3) : "none: the curvatures are the surface's own"},
          {"Noise", number_text(fit.noise, 2)},
          {"Known to 20 / 50 %", "at so many percent of the vertices: " + table_of_known(fit)}};
}

std::vector<Surface_note> notes_of(const Fit_statistics& fit) {
  return {{std::nullopt, "noise " + number_text(fit.noise, 2) +
                             "; known to 20 / 50 % at so many percent of the vertices: " + table_of_known(fit)}};
}

} // namespace equiaffine
