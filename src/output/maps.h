// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_OUTPUT_MAPS_H
#define EQUIAFFINE_SRC_OUTPUT_MAPS_H

#include "system/kernel.h"
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Surface_registration_3.h>

#include <string>
#include <vector>

namespace equiaffine {

/// The result of `register`, and of what.
struct Registration_report {
  std::string source, target;
  Surface_registration_3<Kernel> registration;
  bool has_all_maps = false;       ///< whether all maps were asked for
  std::vector<std::string> advice; ///< what to try if no map was found
};

/// The result of `symmetries`, and of what.
struct Symmetries_report {
  std::string source;
  Affine_symmetries_3<Kernel> symmetries;
  std::vector<std::string> advice; ///< what to try if only the identity was found
};

double determinant_of(const CGAL::Aff_transformation_3<Kernel>& map);

/// "97 % of the source, 37 % of the target"
std::string overlap_text(const Registered_map_3<Kernel>& map);

/// "as good a one is expected 10^-196 times by chance"
std::string odds_text(const Registered_map_3<Kernel>& map);

/// "no map found: ..." and why.
std::string reason_for_none(const Registration_report& report);

/// How many symmetries have a positive determinant, and how many a negative one.
std::string determinants_text(const Symmetries_report& report);

/// One object, see the section on maps of doc/program.md.
std::string to_JSON(const Registration_report& report);
std::string to_JSON(const Symmetries_report& report);

/// Says what was found in a few lines.
std::string summary(const Registration_report& report);
std::string summary(const Symmetries_report& report);

} // namespace equiaffine

#endif
