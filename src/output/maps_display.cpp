// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/maps_display.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace equiaffine {

namespace {

/// A surface of a page or picture, by its number in the column `surface`.
struct Shown_surface {
  std::string name, color; ///< the color of its number in the range from 0 to the last one
};

std::vector<Shown_surface> shown_surfaces(const Registration_report& report) {
  if (!report.registration.found()) return {{"target", "pale yellow"}, {"source, not moved", "dark violet"}};
  if (!report.registration.best().pair) return {{"target", "pale yellow"}, {"moved source", "dark violet"}};
  return {{"target", "pale yellow"},
          {"moved source", "orange"},
          {"frame of the target", "magenta"},
          {"frame of the source", "dark violet"}};
}

bool shows_surfaces(const Display_options& options) { return options.color == "surface"; }

void add_text(const std::string& text, std::vector<Surface_note>& notes) { notes.emplace_back().text = text; }

const std::string text_of_distances =
    "those of the distance from the other surface; --color surface tells the two apart";

} // namespace

Display_options display_of(const Registration_report& report, Display_options options) {
  if (options.color.empty() && !options.range) options.color = "surface";
  if (shows_surfaces(options) && !options.range) options.range = {0., double(shown_surfaces(report).size() - 1)};
  return options;
}

Description description_of(const Registration_report& report, const Display_options& options) {
  Description description = {{"Source", report.source}, {"Target", report.target}};
  if (!report.registration.found()) {
    description.emplace_back("Map", reason_for_none(report));
    for (const std::string& advice : report.advice) description.emplace_back("Try", advice);
  } else {
    const auto& best = report.registration.best();
    description.emplace_back("Map", "found");
    description.emplace_back("Determinant", number_text(determinant_of(best.map), 3));
    description.emplace_back("On the other surface", overlap_text(best));
    description.emplace_back("Rms distance", number_text(best.rms, 3));
    if (const auto& next = report.registration.next_best_rms)
      description.emplace_back("Rms distance of the next best", number_text(*next, 3));
    description.emplace_back("Odds", odds_text(best));
    description.emplace_back("log10 of false alarms", number_text(best.log10_false_alarms, 3));
  }
  std::string numbers;
  const auto surfaces = shown_surfaces(report);
  for (std::size_t n = 0; n < surfaces.size(); ++n)
    numbers += (n > 0 ? ", " : "") + std::to_string(n) + ' ' + surfaces[n].name +
               (shows_surfaces(options) ? " (" + surfaces[n].color + ')' : "");
  description.emplace_back("surface", numbers);
  if (!shows_surfaces(options)) description.emplace_back("Colors", text_of_distances);
  return description;
}

std::vector<Surface_note> notes_of(const Registration_report& report, const Display_options& options) {
  std::vector<Surface_note> notes;
  if (!report.registration.found()) {
    add_text(reason_for_none(report), notes);
    for (const std::string& advice : report.advice) add_text("try " + advice, notes);
  } else {
    const auto& best = report.registration.best();
    add_text("determinant " + number_text(determinant_of(best.map), 3) + ": " + odds_text(best), notes);
    add_text("on the other surface: " + overlap_text(best) + ", rms distance " + number_text(best.rms, 3), notes);
  }
  if (!shows_surfaces(options)) {
    add_text("colors are " + text_of_distances, notes);
    return notes;
  }
  const auto surfaces = shown_surfaces(report);
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    add_text(surfaces[n].name, notes);
    notes.back().number = double(n);
  }
  return notes;
}

Description description_of(const Symmetries_report& report) {
  const auto& symmetries = report.symmetries;
  const auto order = symmetries.order();
  double greatest = 0;
  for (const auto& symmetry : symmetries.maps) greatest = std::max(greatest, symmetry.rms);
  Description description = {{"Symmetries of", report.source},
                             {"Order", order ? std::to_string(*order) : "infinite"},
                             {"Generators", std::to_string(symmetries.continuous.dimension())},
                             {"Determinants", determinants_text(report)},
                             {"Rms distance", "at most " + number_text(greatest, 3)}};
  for (const std::string& advice : report.advice) description.emplace_back("To find more, try", advice);
  return description;
}

std::vector<Surface_note> notes_of(const Symmetries_report& report) {
  std::vector<Surface_note> notes;
  for (const auto& [name, text] : description_of(report)) add_text(name + ": " + text, notes);
  return notes;
}

} // namespace equiaffine
