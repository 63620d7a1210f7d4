// SPDX-License-Identifier: GPL-3.0-or-later
// The results of `register` and `symmetries` as JSON, as a summary, and as phrases for pages and pictures.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_MAPS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_MAPS_H

#include "system/kernel.h"
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/register_surfaces.h>

#include <string>
#include <vector>

namespace equiaffine {

/// The result of `register`, and of what.
struct Registration_report {
  std::string source, target;
  Surface_registration_3<Kernel> registration;
  bool has_all_maps = false; ///< whether all maps were asked for
};

using Symmetries = Affine_symmetries_3<Kernel>;

/// The result of `symmetries`, and of what.
struct Symmetries_report {
  std::string source;
  Symmetries symmetries;
  bool is_complete = false;         ///< whether a search of all rotations was asked for
  bool has_rigid_maps_only = false; ///< whether affine maps were asked for and could not be sought
};

/// "--kind affine, which allows all maps"
std::string advice_text(Registration_advice advice);

/// "97 % of the source, 37 % of the target"
std::string overlap_text(const Registered_map_3<Kernel>& map);

/// ", off it although it does not end there: 17 % of the source, 50 % of the target"; nothing if there is hardly
/// such a part, or if it is not known.
std::string contradictions_text(const Registered_map_3<Kernel>& map);

/// "0.000119, 0.03 % of the size"
std::string rms_text(const Surface_registration_3<Kernel>& registration);

/// "as good a one is expected 10^-196 times by chance"
std::string odds_text(const Registered_map_3<Kernel>& map);

/// "no map found: ..." and why.
std::string reason_for_none(const Registration_report& report);

/// Why it is not known how many symmetries there are.
std::string reason_for_undecided(const Symmetries& symmetries);

/// How many symmetries have a positive determinant, and how many a negative one.
std::string determinants_text(const Symmetries& symmetries);

/// "6 exactly, 48 to within 2.9 % of the size"
std::string levels_text(const Symmetries& symmetries);

/// Returns a sentence for each thing that limits what is known of the symmetries.
std::vector<std::string> limits_of(const Symmetries& symmetries);

/// One object, see the section on maps of doc/program.md.
std::string to_JSON(const Registration_report& report);
std::string to_JSON(const Symmetries_report& report);

/// Says what was found in a few lines.
std::string summary(const Registration_report& report);
std::string summary(const Symmetries_report& report);

} // namespace equiaffine

#endif
