// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/json_text.h"
#include "output/maps.h"

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
  if (!report.scales.empty()) json["scales"] = report.scales;
  if (!registration.found()) return text_of(json);
  json["matched_by"] = report.is_by_triangles ? "triangles" : "frames";
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
  if (is_undecided(symmetries)) json["undecided"] = reason_for_undecided(symmetries);
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
