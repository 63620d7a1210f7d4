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

/// The result of `register`.
struct Registration_report {
  std::string source, target;
  Surface_registration_3<Kernel> registration;
  bool has_all_maps = false; ///< whether all maps were requested
};

using Symmetries = Affine_symmetries_3<Kernel>;

/// The result of `symmetries`.
struct Symmetries_report {
  std::string source;
  Symmetries symmetries;
  bool is_complete = false;         ///< whether a search of all rotations was requested
  bool has_rigid_maps_only = false; ///< whether affine maps were requested but the search was impossible
};

/// "--kind affine, which allows all maps"
std::string advice_text(Registration_advice advice);

/// "97 % of the source, 37 % of the target"
std::string overlap_text(const Registered_map_3<Kernel>& map);

/// "; off the other surface, not near its boundary: 17 % of the source, 50 % of the target"; empty if negligible or
/// unknown.
std::string contradictions_text(const Registered_map_3<Kernel>& map);

/// "0.000119, 0.03 % of the size"
std::string rms_text(const Surface_registration_3<Kernel>& registration);

/// "expected number of equally good maps by chance: 10^-196"
std::string significance_text(const Registered_map_3<Kernel>& map);

/// "no map found: " and the reason.
std::string reason_for_none(const Registration_report& report);

/// Why the number of symmetries is undecided.
std::string reason_for_undecided(const Symmetries& symmetries);

/// "positive for 4, negative for 4": the numbers of symmetries by the sign of the determinant.
std::string determinants_text(const Symmetries& symmetries);

/// "6 exactly, 48 to within 2.9 % of the size"
std::string levels_text(const Symmetries& symmetries);

/// Sentences about what was not verified.
std::vector<std::string> limits_of(const Symmetries& symmetries);

/// One object, see the section on maps of doc/program.md.
std::string to_JSON(const Registration_report& report);
std::string to_JSON(const Symmetries_report& report);

/// The result in a few lines.
std::string summary(const Registration_report& report);
std::string summary(const Symmetries_report& report);

} // namespace equiaffine

#endif
