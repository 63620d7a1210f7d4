// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/maps_display.h"

#include "output/symmetry_marks.h"

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

void add_surfaces(const std::vector<Shown_surface>& surfaces, std::vector<Surface_note>& notes) {
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    add_text(surfaces[n].name, notes);
    notes.back().number = double(n);
  }
}

/// "0 target (pale yellow), 1 moved source (orange)"
std::string numbers_text(const std::vector<Shown_surface>& surfaces, bool has_colors) {
  std::string text;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    text += (n > 0 ? ", " : "") + std::to_string(n) + ' ' + surfaces[n].name;
    if (has_colors) text += " (" + surfaces[n].color + ')';
  }
  return text;
}

std::vector<Shown_surface> shown_surfaces(const Symmetries& symmetries) {
  const Symmetry_marks marks = marks_of(symmetries);
  std::vector<Shown_surface> surfaces = {{"surface", "pale yellow"}};
  if (!marks.planes.empty())
    surfaces.push_back({"planes of reflection", marks.axes.empty() ? "dark violet" : "magenta"});
  if (!marks.axes.empty()) surfaces.push_back({"axes of rotation", "dark violet"});
  return surfaces;
}

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
    description.emplace_back("On the other surface", overlap_text(best) + contradictions_text(best));
    description.emplace_back("Rms distance", rms_text(report.registration));
    if (const auto& next = report.registration.next_best_rms)
      description.emplace_back("Rms distance of the next best", number_text(*next, 3));
    description.emplace_back("Odds", odds_text(best));
    description.emplace_back("log10 of false alarms", number_text(best.log10_false_alarms, 3));
  }
  description.emplace_back("surface", numbers_text(shown_surfaces(report), shows_surfaces(options)));
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
    add_text("on the other surface: " + overlap_text(best) + contradictions_text(best), notes);
    add_text("rms distance " + rms_text(report.registration), notes);
  }
  if (!shows_surfaces(options)) {
    add_text("colors are " + text_of_distances, notes);
    return notes;
  }
  add_surfaces(shown_surfaces(report), notes);
  return notes;
}

Display_options display_of(const Symmetries_report& report, Display_options options) {
  const auto surfaces = shown_surfaces(report.symmetries);
  if (options.color.empty() && !options.range && surfaces.size() > 1) options.color = "surface";
  if (shows_surfaces(options) && !options.range) options.range = {0., double(surfaces.size() - 1)};
  return options;
}

Description description_of(const Symmetries_report& report, const Display_options& options) {
  const Symmetries& symmetries = report.symmetries;
  const auto order = symmetries.order();
  Description description = {{"Symmetries of", report.source}};
  if (is_undecided(symmetries)) description.emplace_back("Order", "undecided: " + reason_for_undecided(symmetries));
  else description.emplace_back("Order", order ? std::to_string(*order) : "infinite");
  if (!symmetries.levels.empty()) description.emplace_back("Levels", levels_text(symmetries));
  if (symmetries.continuous.dimension() > 0)
    description.emplace_back("Generators", std::to_string(symmetries.continuous.dimension()));
  if (order) description.emplace_back("Determinants", determinants_text(symmetries));
  if (report.has_rigid_maps_only) description.emplace_back("Kind", "rigid ones only, since the mesh bounds no solid");
  for (const std::string& limit : limits_of(symmetries)) description.emplace_back("Limit", limit);
  for (const std::string& advice : report.advice) description.emplace_back("To find more, try", advice);
  description.emplace_back("surface", numbers_text(shown_surfaces(symmetries), shows_surfaces(options)));
  return description;
}

std::vector<Surface_note> notes_of(const Symmetries_report& report, const Display_options& options) {
  std::vector<Surface_note> notes;
  for (const auto& [name, text] : description_of(report, options))
    if (name != "surface") add_text(name + ": " + text, notes);
  if (shows_surfaces(options)) add_surfaces(shown_surfaces(report.symmetries), notes);
  return notes;
}

} // namespace equiaffine
