// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/maps.h"

#include "output/json_text.h"
#include "system/front_end.h"
#include <equiaffine/registration/internal/searches.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>

namespace equiaffine {

namespace {

/// A power of ten such as "10^-151". Exponents below -300 only reflect the number of points.
std::string power_of_ten(double logarithm) {
  constexpr double least = -300;
  return logarithm < least ? "less than 10^-300" : "10^" + std::to_string(std::lround(logarithm));
}

/// "; try A, or B"
std::string try_text(const std::vector<Registration_advice>& advice) {
  std::string text;
  for (const Registration_advice each : advice) text += (text.empty() ? "; try " : ", or ") + advice_text(each);
  return text;
}

/// "0.14", or "0.14 and 0.2" for the source and the target.
std::string scales_text(const std::array<double, 2>& scales) {
  std::ostringstream text;
  text.precision(2);
  text << scales[0];
  if (scales[1] != scales[0]) text << " and " << scales[1];
  return text.str();
}

std::size_t reflections_of(const Symmetries& symmetries) {
  return std::size_t(std::count_if(symmetries.maps.begin(), symmetries.maps.end(),
                                   [](const auto& symmetry) { return internal::determinant_of(symmetry.map) < 0; }));
}

/// The level whose maps are the symmetries, if there is one.
const Symmetry_level_3<Kernel>* level_of_maps(const Symmetries& symmetries) {
  for (const auto& level : symmetries.levels)
    if (level.order() == symmetries.maps.size()) return &level;
  return nullptr;
}

/// Whether the symmetries are those of the first level, and exact up to rounding.
bool is_exact(const Symmetries& symmetries) {
  return symmetries.verdict == Symmetry_verdict::EXACT && !symmetries.levels.empty() &&
         symmetries.maps.size() == symmetries.levels.front().order();
}

/// "0.097 % of the size"
std::string part_text(double part) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * part << " % of the size";
  return text.str();
}

/// " to within 0.097 % of the size (rms; maximum 0.6 %)"; empty if exact up to rounding.
std::string within_text(double rms, double greatest) {
  constexpr double rounding = 1e-10;
  if (!(rms > rounding)) return "";
  std::ostringstream text;
  text.precision(2);
  text << " to within " << part_text(rms);
  if (greatest > 0) text << " (rms; maximum " << 100 * greatest << " %)";
  return text.str();
}

/// A line for each level with more maps than the symmetries.
std::string greater_levels(const Symmetries& symmetries) {
  std::string text;
  for (const auto& level : symmetries.levels)
    if (level.order() > symmetries.maps.size())
      text += std::to_string(level.order()) + " symmetries" + within_text(level.rms, level.greatest) + '\n';
  return text;
}

std::string completeness_text(const Symmetries& symmetries) {
  if (!symmetries.complete_to) return "the search does not cover all rotations\n";
  return "the search covers all rotations that move the surface onto itself to within " +
         part_text(*symmetries.complete_to) + '\n';
}

/// ", along and about (0, 0, 1)": the axis of one or two rigid motions; a single motion may be a screw. Empty for other
/// generators. `size` is that of the surface.
std::string axis_text(const Affine_slippage_3& slippage, double size) {
  constexpr double least = 0.05; // smaller rotations relative to translations, or vice versa, are errors of fits
  const std::size_t dimension = slippage.dimension();
  if (dimension == 0 || dimension > 2) return "";
  std::vector<Eigen::Vector3d> turns, shifts;
  for (const auto& [m, t] : slippage.generators) {
    if ((m + m.transpose()).norm() > least * m.norm()) return "";
    turns.emplace_back(size * Eigen::Vector3d(m(2, 1), m(0, 2), m(1, 0)));
    shifts.push_back(t);
  }
  const auto text_of = [](const std::string& how, const Eigen::Vector3d& v) {
    std::ostringstream text;
    text.precision(3);
    const Eigen::Array3d unit = (1000 * v.normalized().array()).round() / 1000 + 0.0; // no -0
    text << ", " << how << " (" << unit[0] << ", " << unit[1] << ", " << unit[2] << ')';
    return text.str();
  };
  // A rotation about a distant axis moves the origin at a right angle to the axis.
  const bool is_turn =
      turns[0].norm() > least * shifts[0].norm() ||
      (turns[0].norm() > 0 && std::abs(turns[0].normalized().dot(shifts[0])) < least * shifts[0].norm());
  if (dimension == 1) {
    const double rise = turns[0].dot(shifts[0]) / turns[0].squaredNorm() * size; // per radian
    if (!is_turn || std::abs(rise) < least * size)
      return is_turn ? text_of("about", turns[0]) : text_of("along", shifts[0]);
    std::ostringstream text;
    text.precision(3);
    text << text_of("as a screw about", turns[0]) << " with pitch " << 2 * std::numbers::pi * rise;
    return text.str();
  }
  const Eigen::Vector3d& axis = turns[turns[0].norm() < turns[1].norm() ? 1 : 0];
  const bool is_cylinder = axis.norm() > 0 && turns[0].cross(turns[1]).norm() < least * axis.squaredNorm();
  return is_cylinder ? text_of("along and about", axis) : "";
}

std::string degrees_of_freedom(std::size_t number) {
  return std::to_string(number) + (number == 1 ? " degree of freedom" : " degrees of freedom");
}

} // namespace

std::string advice_text(Registration_advice advice) {
  switch (advice) {
  case Registration_advice::SIMILARITIES_OF_FRAMES:
    return option_text("kind", "similarity") + ", whose frames need fewer derivatives and also exist on quadrics";
  case Registration_advice::SIMILARITIES_OF_OTHER_SIZE:
    return option_text("kind", "similarity") + ", which allows other sizes";
  case Registration_advice::SIMILARITIES_OF_TRIANGLES:
    return option_text("kind", "similarity") + ", which needs no curvature";
  case Registration_advice::ALL_MAPS: return option_text("kind", "affine") + ", which allows all maps";
  case Registration_advice::RIGID_MAPS: return option_text("kind", "rigid") + ", which needs no solid";
  case Registration_advice::REFLECTIONS: return by_front_end("leaving out --no-reflections", "reflections=True");
  case Registration_advice::SAME_SCALE: return "the same " + option_text("scale", "R") + " on both sides";
  case Registration_advice::LARGER_SAME_SCALE: return "a larger " + option_text("scale") + ", the same on both sides";
  case Registration_advice::A_SCALE: return option_text("scale", "R") + " for the fit";
  case Registration_advice::LARGER_SCALE: return "a larger " + option_text("scale");
  case Registration_advice::FIT_OF_MESH: return "--fit instead of --distance-to, since facets have no affine curvature";
  case Registration_advice::SMOOTHING: return option_text("smoothing", "auto") + " for the volume";
  case Registration_advice::LARGER_TOLERANCE: return "a larger " + option_text("tolerance");
  case Registration_advice::OTHER_TOLERANCE: return "another " + option_text("tolerance");
  case Registration_advice::SMALLER_OVERLAP: return "a smaller " + option_text("min_overlap");
  case Registration_advice::MORE_IN_COMMON: break;
  }
  return "surfaces with a larger overlap";
}

std::string overlap_text(const Registered_map_3<Kernel>& map) {
  return std::to_string(std::lround(100 * map.inliers[0])) + " % of the source, " +
         std::to_string(std::lround(100 * map.inliers[1])) + " % of the target";
}

std::string contradictions_text(const Registered_map_3<Kernel>& map) {
  constexpr double least = 1e-3; // smaller fractions of the points are not reported
  if (!map.contradictions || std::max(map.contradictions->at(0), map.contradictions->at(1)) < least) return "";
  std::ostringstream text;
  text.precision(2);
  text << "; off the other surface, not near its boundary: " << 100 * map.contradictions->at(0) << " % of the source, "
       << 100 * map.contradictions->at(1) << " % of the target";
  return text.str();
}

std::string rms_text(const Surface_registration_3<Kernel>& registration) {
  const double rms = registration.best().rms;
  std::ostringstream text;
  text.precision(3);
  text << rms;
  text.precision(2);
  if (registration.size > 0) text << ", " << 100 * rms / registration.size << " % of the size";
  return text.str();
}

std::string significance_text(const Registered_map_3<Kernel>& map) {
  return "expected number of equally good maps by chance: " + power_of_ten(map.log10_false_alarms);
}

std::string reason_for_none(const Registration_report& report) {
  const std::size_t n = report.registration.hypotheses;
  const std::string& reason = report.registration.reason;
  const std::string of_triangles = reason.empty() ? "" : "; by triangles, without curvature: " + reason;
  const bool slides = report.registration.slippage.dimension() > 0;
  if (n == 0)
    return std::string("no map found: the surfaces have no ") + (slides ? "unique frames" : "frames") + " that agree" +
           of_triangles;
  std::string scales;
  for (const auto& pair : report.registration.scales)
    scales += (scales.empty() ? " (at the scales " : "; ") + scales_text(pair);
  if (!scales.empty()) scales += ')';
  return "no map found: " +
         (n == 1 ? "the only hypothesis is not" : "none of " + std::to_string(n) + " hypotheses is") +
         " better than chance" +
         (report.registration.maps_left_out > 0 ? " on more than a small part of the surfaces" : "") + scales +
         of_triangles;
}

std::string reason_for_undecided(const Symmetries& symmetries) {
  if (!symmetries.reason.empty()) return symmetries.reason;
  return "other maps exceed the tolerance only slightly";
}

std::string determinants_text(const Symmetries& symmetries) {
  const std::size_t reflections = reflections_of(symmetries);
  return "positive for " + std::to_string(symmetries.maps.size() - reflections) + ", negative for " +
         std::to_string(reflections);
}

std::vector<std::string> limits_of(const Symmetries& symmetries) {
  std::vector<std::string> limits;
  const std::size_t dimension = symmetries.continuous.dimension();
  if (dimension > 0 && !symmetries.levels.empty())
    limits.push_back("the surface that the facets approximate is symmetric under rotations about " +
                     std::string(dimension == 1 ? "an axis" : "any axis") + within_text(symmetries.continuous.rms, 0));
  if (symmetries.order_in_box) {
    std::string text = "the surface continues outside the box, where nothing was verified";
    if (const auto order = symmetries.order(); order && *symmetries.order_in_box < *order)
      text += "; " + std::to_string(*symmetries.order_in_box) + " of the symmetries map" +
              (*symmetries.order_in_box == 1 ? "s" : "") + " the part in the box onto itself";
    limits.push_back(text);
  }
  if (symmetries.spacing && symmetries.is_decided && (dimension > 0 || symmetries.maps.size() > 1))
    limits.push_back("verified at points " + part_text(*symmetries.spacing) +
                     " apart, which may miss narrower details");
  return limits;
}

std::string levels_text(const Symmetries& symmetries) {
  std::string text;
  for (const auto& level : symmetries.levels) {
    const bool is_first = &level == &symmetries.levels.front();
    const std::string within =
        is_first && symmetries.verdict == Symmetry_verdict::EXACT ? "" : within_text(level.rms, level.greatest);
    text += (text.empty() ? "" : ", ") + std::to_string(level.order()) + (within.empty() ? " exactly" : within);
  }
  return text;
}

std::string summary(const Registration_report& report) {
  const auto& registration = report.registration;
  const std::size_t dimension = registration.slippage.dimension();
  std::ostringstream text;
  if (!registration.found()) {
    text << reason_for_none(report) << try_text(registration.advice) << '\n';
  } else {
    const auto& best = registration.best();
    text.precision(3);
    text << "map found, determinant " << internal::determinant_of(best.map) << "; " << significance_text(best) << '\n';
    text << "overlap: " << overlap_text(best) << contradictions_text(best) << '\n';
    text << "rms distance " << rms_text(registration) << '\n';
    text << registration.hypotheses << (registration.hypotheses == 1 ? " hypothesis" : " hypotheses");
    if (registration.is_by_triangles) text << ", the last ones by triangles, without curvature";
    else if (!registration.scales.empty())
      text << ", the last ones at scale " << scales_text(registration.scales.back());
    if (registration.next_best_rms) text << ", next best rms distance " << *registration.next_best_rms;
    text << '\n';
    if (report.has_all_maps) text << registration.maps.size() << (registration.maps.size() == 1 ? " map\n" : " maps\n");
  }
  if (registration.found() && registration.equally_good > 0)
    text << "at least " << registration.equally_good
         << (registration.equally_good == 1 ? " other map fits" : " other maps fit") << " equally well"
         << (report.has_all_maps ? "" : "; list them with " + option_text("number_of_maps", "N")) << '\n';
  if (dimension > 0)
    text << "the source slides over itself" << within_text(registration.slippage.rms, 0) << " with "
         << degrees_of_freedom(dimension) << axis_text(registration.slippage, registration.size)
         << (registration.found() ? ": the map is one of a continuous family\n" : "\n");
  return text.str();
}

std::string summary(const Symmetries_report& report) {
  const auto& symmetries = report.symmetries;
  const std::size_t dimension = symmetries.continuous.dimension();
  std::string text, rest = greater_levels(symmetries);
  for (const std::string& limit : limits_of(symmetries)) rest += limit + '\n';
  if (report.is_complete) rest += completeness_text(symmetries);
  if (report.has_rigid_maps_only) text = "only rigid symmetries, since affine ones need a mesh that bounds a solid:\n";
  if (symmetries.is_undecided()) {
    text += "undecided: " + reason_for_undecided(symmetries) + try_text(symmetries.advice) + '\n';
  } else if (dimension > 0 && symmetries.levels.empty()) {
    text += "infinitely many symmetries" + within_text(symmetries.continuous.rms, 0) +
            ": the surface slides over itself with " + degrees_of_freedom(dimension) + '\n';
  } else if (symmetries.maps.size() == 1) {
    text += "1 symmetry, the identity" + try_text(symmetries.advice) + '\n';
  } else {
    const std::size_t reflections = reflections_of(symmetries);
    const auto* const level = level_of_maps(symmetries);
    text += std::to_string(symmetries.maps.size()) + " symmetries" +
            (level && !is_exact(symmetries) ? within_text(level->rms, level->greatest) : "") + ", " +
            std::to_string(reflections) + " of them reverse" + (reflections == 1 ? "s" : "") + " orientation\n";
  }
  return text + rest;
}

namespace {

/// Adds `matrix`, row by row, and `translation`.
void add(const CGAL::Aff_transformation_3<Kernel>& map, Json& json) {
  for (int row = 0; row < 3; ++row) {
    json["matrix"].push_back({map.m(row, 0), map.m(row, 1), map.m(row, 2)});
    json["translation"].push_back(map.m(row, 3));
  }
}

void add(const Registered_map_3<Kernel>& map, Json& json) {
  add(map.map, json);
  json["determinant"] = internal::determinant_of(map.map);
  json["log10_false_alarms"] = map.log10_false_alarms;
  json["inliers"] = map.inliers;
  json["rms"] = map.rms;
  json["contradictions"] = nullptr;
  if (map.contradictions) json["contradictions"] = *map.contradictions;
}

Json to_JSON(const Affine_slippage_3& slippage) {
  Json json = {{"dimension", slippage.dimension()}, {"rms", slippage.rms}, {"generators", Json::array()}};
  for (const auto& [matrix, translation] : slippage.generators) {
    Json generator;
    for (int row = 0; row < 3; ++row) {
      generator["matrix"].push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2)});
      generator["translation"].push_back(translation[row]);
    }
    json["generators"].push_back(generator);
  }
  return json;
}

std::string verdict_text(Symmetry_verdict verdict) {
  switch (verdict) {
  case Symmetry_verdict::EXACT: return "exact";
  case Symmetry_verdict::APPROXIMATE: return "approximate";
  case Symmetry_verdict::NONE: return "none";
  case Symmetry_verdict::UNDECIDED: break;
  }
  return "undecided";
}

} // namespace

std::string to_JSON(const Registration_report& report) {
  const auto& registration = report.registration;
  Json json = begin_JSON(report.source);
  json["target"] = report.target;
  json["found"] = registration.found();
  for (const auto& scales : registration.scales) json["scales"].push_back(scales_text(scales));
  if (!registration.found()) return text_of(json);
  json["matched_by"] = registration.is_by_triangles ? "triangles" : "frames";
  add(registration.best(), json);
  json["hypotheses"] = registration.hypotheses;
  json["equally_good"] = registration.equally_good;
  json["size"] = registration.size;
  json["next_best_rms"] = nullptr;
  if (registration.next_best_rms) json["next_best_rms"] = *registration.next_best_rms;
  json["slippage"] = to_JSON(registration.slippage);
  if (!report.has_all_maps) return text_of(json);
  for (const auto& map : registration.maps) add(map, json["maps"].emplace_back());
  return text_of(json);
}

std::string to_JSON(const Symmetries_report& report) {
  const auto& symmetries = report.symmetries;
  Json json = begin_JSON(report.source);
  json["order"] = nullptr;
  if (const auto order = symmetries.order()) json["order"] = *order;
  json["verdict"] = verdict_text(symmetries.verdict);
  json["undecided"] = nullptr;
  if (symmetries.is_undecided()) json["undecided"] = reason_for_undecided(symmetries);
  json["complete_to"] = nullptr;
  if (symmetries.complete_to) json["complete_to"] = *symmetries.complete_to;
  json["kind"] = keeps_angles(symmetries.kind) ? "rigid" : "affine";
  json["spacing"] = nullptr;
  if (symmetries.spacing) json["spacing"] = *symmetries.spacing;
  json["order_in_box"] = nullptr;
  if (symmetries.order_in_box) json["order_in_box"] = *symmetries.order_in_box;
  json["levels"] = Json::array();
  for (const auto& level : symmetries.levels)
    json["levels"].push_back({{"order", level.order()}, {"rms", level.rms}, {"greatest", level.greatest}});
  json["maps"] = Json::array();
  for (const auto& symmetry : symmetries.maps) {
    Json& map = json["maps"].emplace_back();
    add(symmetry.map, map);
    map["rms"] = symmetry.rms;
    map["greatest"] = symmetry.greatest;
  }
  json["continuous"] = to_JSON(symmetries.continuous);
  return text_of(json);
}

} // namespace equiaffine
