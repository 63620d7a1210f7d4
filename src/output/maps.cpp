// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/maps.h"

#include "output/json_text.h"

#include <CGAL/determinant.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace equiaffine {

namespace {

/// Adds `matrix`, by its rows, and `translation`.
void add(const CGAL::Aff_transformation_3<Kernel>& map, Json& json) {
  for (int row = 0; row < 3; ++row) {
    json["matrix"].push_back({map.m(row, 0), map.m(row, 1), map.m(row, 2)});
    json["translation"].push_back(map.m(row, 3));
  }
}

void add(const Registered_map_3<Kernel>& map, Json& json) {
  add(map.map, json);
  json["determinant"] = determinant_of(map.map);
  json["log10_false_alarms"] = map.log10_false_alarms;
  json["inliers"] = map.inliers;
  json["rms"] = map.rms;
}

Json to_JSON(const Affine_slippage_3& slippage) {
  Json json = {{"dimension", slippage.dimension()}, {"generators", Json::array()}};
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

/// A power of ten such as "10^-151".
std::string power_of_ten(double logarithm) {
  std::ostringstream text;
  text << "10^" << std::lround(logarithm);
  return text.str();
}

/// "; try this, or that"
std::string advice_text(const std::vector<std::string>& advice) {
  std::string text;
  for (const std::string& each : advice) text += (text.empty() ? "; try " : ", or ") + each;
  return text;
}

std::string ways(std::size_t number) { return std::to_string(number) + (number == 1 ? " way" : " ways"); }

} // namespace

double determinant_of(const CGAL::Aff_transformation_3<Kernel>& map) {
  return CGAL::determinant(map.m(0, 0), map.m(0, 1), map.m(0, 2), map.m(1, 0), map.m(1, 1), map.m(1, 2), map.m(2, 0),
                           map.m(2, 1), map.m(2, 2));
}

std::string overlap_text(const Registered_map_3<Kernel>& map) {
  return std::to_string(std::lround(100 * map.inliers[0])) + " % of the source, " +
         std::to_string(std::lround(100 * map.inliers[1])) + " % of the target";
}

std::string odds_text(const Registered_map_3<Kernel>& map) {
  return "as good a one is expected " + power_of_ten(map.log10_false_alarms) + " times by chance";
}

std::string reason_for_none(const Registration_report& report) {
  const std::size_t n = report.registration.hypotheses;
  if (n == 0) return "no map found: no points of the two have frames that agree";
  return "no map found: " + (n == 1 ? "the only hypothesis is no" : "none of " + std::to_string(n) + " hypotheses is") +
         " better than chance";
}

std::string determinants_text(const Symmetries_report& report) {
  const auto& maps = report.symmetries.maps;
  const auto reflections =
      std::count_if(maps.begin(), maps.end(), [](const auto& symmetry) { return determinant_of(symmetry.map) < 0; });
  return "positive for " + std::to_string(std::ptrdiff_t(maps.size()) - reflections) + ", negative for " +
         std::to_string(reflections);
}

std::string to_JSON(const Registration_report& report) {
  const auto& registration = report.registration;
  Json json = begin_JSON(report.source);
  json["target"] = report.target;
  json["found"] = registration.found();
  if (!registration.found()) return text_of(json);
  add(registration.best(), json);
  json["hypotheses"] = registration.hypotheses;
  json["next_best_rms"] = nullptr;
  if (registration.next_best_rms) json["next_best_rms"] = *registration.next_best_rms;
  json["slippage"] = to_JSON(registration.slippage);
  if (!report.has_all_maps) return text_of(json);
  for (const auto& map : registration.maps) add(map, json["maps"].emplace_back());
  return text_of(json);
}

std::string to_JSON(const Symmetries_report& report) {
  Json json = begin_JSON(report.source);
  json["order"] = nullptr;
  json["maps"] = Json::array();
  if (const auto order = report.symmetries.order()) json["order"] = *order;
  for (const auto& symmetry : report.symmetries.maps) {
    Json& map = json["maps"].emplace_back();
    add(symmetry.map, map);
    map["rms"] = symmetry.rms;
  }
  json["continuous"] = to_JSON(report.symmetries.continuous);
  return text_of(json);
}

std::string summary(const Registration_report& report) {
  const auto& registration = report.registration;
  const std::size_t dimension = registration.slippage.dimension();
  std::ostringstream text;
  if (!registration.found()) {
    text << reason_for_none(report) << advice_text(report.advice) << '\n';
  } else {
    const auto& best = registration.best();
    text.precision(3);
    text << "map found, determinant " << determinant_of(best.map) << ": " << odds_text(best) << '\n';
    text << "on the other surface: " << overlap_text(best) << ", rms distance " << best.rms << '\n';
    text << registration.hypotheses << (registration.hypotheses == 1 ? " hypothesis" : " hypotheses");
    if (registration.next_best_rms) text << ", next best rms distance " << *registration.next_best_rms;
    text << '\n';
    if (report.has_all_maps) text << registration.maps.size() << (registration.maps.size() == 1 ? " map\n" : " maps\n");
  }
  if (dimension > 0)
    text << "the source slips over itself in " << ways(dimension)
         << (registration.found() ? ": the map is one of a continuous family\n" : "\n");
  return text.str();
}

std::string summary(const Symmetries_report& report) {
  const auto& [maps, continuous] = report.symmetries;
  if (continuous.dimension() > 0)
    return "infinitely many symmetries: the surface slips over itself in " + ways(continuous.dimension()) + '\n';
  std::size_t reflections = 0;
  for (const auto& symmetry : maps) reflections += determinant_of(symmetry.map) < 0;
  if (maps.size() == 1) return "1 symmetry, the identity" + advice_text(report.advice) + '\n';
  return std::to_string(maps.size()) + " symmetries, " + std::to_string(reflections) +
         " of them change left and right\n";
}

} // namespace equiaffine
