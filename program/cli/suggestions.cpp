// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/suggestions.h"

#include "system/files.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <vector>

namespace equiaffine {

namespace {

/// The number of insertions, deletions, replacements and swaps of neighboring letters that turn one word into the
/// other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j + 1] + 1, row[j] + 1, last[j] + (a[i] == b[j] ? 0 : 1)});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
        row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 1);
    }
    before_last = last;
    last = row;
  }
  return last.back();
}

enum class Word_kind { MESH_FILE, POINTS, VOLUME_FILE, FORMULA, PAGE, PICTURE, OTHER };

Word_kind kind_of(const std::string& word) {
  switch (file_format(word)) {
  case File_format::PLY:
  case File_format::OFF:
  case File_format::OBJ:
  case File_format::STL: return Word_kind::MESH_FILE;
  case File_format::CSV:
  case File_format::XYZ: return Word_kind::POINTS;
  case File_format::HTML: return Word_kind::PAGE;
  case File_format::PNG: return Word_kind::PICTURE;
  default: break;
  }
  if (is_volume(word)) return Word_kind::VOLUME_FILE;
  const bool is_formula =
      word.find_first_of("xyz") != std::string::npos && word.find_first_of("+*^=(") != std::string::npos;
  return is_formula ? Word_kind::FORMULA : Word_kind::OTHER;
}

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

std::string annotate(const std::string& path, const std::string& extension) {
  return "'equiaffine annotate " + path + " -o " + stem_of(path) + "-curvatures" + extension + "'";
}

/// What to write for an unexpected file or formula.
std::string advice_on_source(Command command, Word_kind kind, const std::string& word) {
  switch (kind) {
  case Word_kind::FORMULA: return "write --function '" + word + "' for a formula";
  case Word_kind::VOLUME_FILE:
    return command == SAMPLE ? "to mesh this volume, use 'equiaffine mesh --volume " + word + "'"
                             : "write --volume " + word;
  case Word_kind::MESH_FILE:
  case Word_kind::POINTS: {
    const bool is_mesh = kind == Word_kind::MESH_FILE;
    return "write --fit " + word + " for the smooth surface through its " +
           (is_mesh ? "vertices, --distance-to " + word + " for its facets" : "points") +
           (command == EVALUATE ? " with --points FILE" : "") + ", or " + annotate(word, is_mesh ? ".ply" : ".csv") +
           " for attributes at these " + (is_mesh ? "vertices" : "points") + " themselves";
  }
  default: return {};
  }
}

/// An option that some commands do not have, and what to use instead.
struct Misplaced_option {
  Commands commands;
  std::string_view option, advice;
};

constexpr std::array<Misplaced_option, 17> misplaced_options = {
    {{ANNOTATE, "--function",
      "for a formula use 'equiaffine mesh --function EXPR -o OUT.ply', or 'equiaffine evaluate --function EXPR "
      "--points FILE -o OUT.csv' at the points of a file"},
     {ANNOTATE, "--volume", "for a volume use 'equiaffine mesh --volume FILE -o OUT.ply'"},
     {ANNOTATE, "--distance-to", "leave out the option: 'equiaffine annotate FILE -o OUT.ply' fits the vertices"},
     {ANNOTATE, "--fit", "leave out the option: 'equiaffine annotate FILE -o OUT.ply' fits the vertices"},
     {ANNOTATE, "--points", "leave out the option: 'equiaffine annotate FILE -o OUT.csv' fits the points"},
     {VIEW, "--html", "name the page with -o PAGE.html"},
     {VIEW, "--function", "for a formula use 'equiaffine mesh --function EXPR -o OUT.ply --html PAGE.html'"},
     {VIEW, "--volume", "for a volume use 'equiaffine mesh --volume FILE -o OUT.ply --html PAGE.html'"},
     {VIEW, "--fit", "for a fit use 'equiaffine mesh --fit FILE -o OUT.ply --html PAGE.html'"},
     {VIEW, "--attributes", "view shows the attributes of the file; compute them with 'equiaffine annotate'"},
     {EVALUATE, "--html", "evaluate writes only tables; for a page use mesh or annotate"},
     {EVALUATE, "--png", "evaluate writes only tables; for a picture use mesh or annotate"},
     {SAMPLE, "--html", "sample writes only volumes; for a page use 'equiaffine mesh' with the same source"},
     {SAMPLE, "--png", "sample writes only volumes; for a picture use 'equiaffine mesh' with the same source"},
     {SAMPLE, "--volume", "a volume is sampled already; to mesh it use 'equiaffine mesh --volume FILE -o OUT.ply'"},
     {registering, "--points", "write FILE without an option, or --fit FILE"},
     {registering, "--attributes", "maps have no attributes; compute those of a surface with 'equiaffine annotate'"}}};

std::string first_source(const Command_line& line) { return line.has("FILE") ? line.word("FILE") : "SOURCE"; }

bool has_source(const Command_line& line) {
  return std::any_of(line.options.begin(), line.options.end(), [](const auto& option) {
    for (const char* name : {"FILE", "function", "volume", "distance_to", "fit", "MESH", "MESH.ply"})
      if (option.first == name) return true;
    return false;
  });
}

} // namespace

std::string suggestion(const std::string& word, const Words& candidates) {
  const auto starts_so = [&](const std::string& candidate) { return candidate.starts_with(word); };
  if (std::count_if(candidates.begin(), candidates.end(), starts_so) == 1)
    return ", did you mean '" + *std::find_if(candidates.begin(), candidates.end(), starts_so) + "'?";
  const std::string* best = nullptr;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t distance = edit_distance(word, candidate); distance < least) {
      least = distance;
      best = &candidate;
    }
  return best ? ", did you mean '" + *best + "'?" : "";
}

std::string advice_on_word(const Command_line& line, const std::string& word) {
  const Word_kind kind = kind_of(word);
  if (kind == Word_kind::PAGE)
    return (line.command == VIEW ? "name the page with -o " : "name the page with --html ") + word;
  if (kind == Word_kind::PICTURE) return "name the picture with --png " + word;
  const bool is_surface = kind == Word_kind::MESH_FILE || kind == Word_kind::POINTS || kind == Word_kind::VOLUME_FILE;
  if (line.command == SYMMETRIES && (word == "to" || (is_surface && has_source(line))))
    return "symmetries takes one surface; for maps between two use 'equiaffine register " + first_source(line) +
           " to " + (is_surface ? word : "OTHER") + " -o MAP.json'";
  if (!is_surface && line.has("function"))
    return is_number(word) ? "" : "quote a formula with spaces, for example --function 'x^2 + y^2 = 1'";
  if (!is_surface && kind != Word_kind::FORMULA) return {};
  if (line.command == REGISTER && is_surface)
    return "separate the two surfaces by the word 'to': 'equiaffine register " + first_source(line) + " to " + word +
           " -o MAP.json'";
  if (has_source(line)) return !is_surface || line.has("output") ? "" : "name the output with -o " + word;
  return advice_on_source(line.command, kind, word);
}

std::string advice_on_option(Command command, const std::string& option) {
  const auto found = std::find_if(misplaced_options.begin(), misplaced_options.end(), [&](const Misplaced_option& m) {
    return (m.commands & command) && m.option == option;
  });
  return found == misplaced_options.end() ? std::string() : std::string(found->advice);
}

std::string advice_on_command(const std::string& word) {
  const std::string output = " -o " + stem_of(word) + ".ply";
  switch (kind_of(word)) {
  case Word_kind::MESH_FILE: return "to compute at its vertices, use " + annotate(word, ".ply");
  case Word_kind::POINTS: return "to compute at its points, use " + annotate(word, ".csv");
  case Word_kind::VOLUME_FILE: return "to mesh it, use 'equiaffine mesh --volume " + word + output + "'";
  case Word_kind::FORMULA: return "to mesh it, use 'equiaffine mesh --function \"" + word + "\" --box ... -o OUT.ply'";
  default: return {};
  }
}

void check_is_no_formula(const std::string& path) {
  if (kind_of(path) == Word_kind::FORMULA)
    throw Input_error("'" + path + "' is not a file; write --function '" + path + "' for a formula");
}

void check_is_annotatable(const std::string& path) {
  const Word_kind kind = kind_of(path);
  const std::string output = " -o " + stem_of(path) + ".ply'";
  if (kind == Word_kind::FORMULA)
    throw Input_error("'" + path + "' is not a file; use 'equiaffine mesh --function \"" + path +
                      "\" --box ... -o OUT.ply' for a formula");
  if (kind == Word_kind::VOLUME_FILE && file_format(path) != File_format::UNNAMED)
    throw Input_error("cannot annotate '" + path + "': a volume has no vertices; use 'equiaffine mesh --volume " +
                      path + output + ", with --level for a level other than 0");
}

void check_is_viewable(const std::string& path) {
  const Word_kind kind = kind_of(path);
  const std::string stem = stem_of(path), outputs = " -o " + stem + ".ply --html " + stem + ".html'";
  if (kind == Word_kind::MESH_FILE && file_format(path) != File_format::PLY)
    throw Input_error("cannot show '" + path + "': its format has no attributes; use 'equiaffine annotate " + path +
                      outputs);
  if (kind == Word_kind::POINTS)
    throw Input_error("cannot show '" + path + "': points have no faces; use 'equiaffine mesh --fit " + path + outputs +
                      " for the surface through them");
  if (kind == Word_kind::VOLUME_FILE && file_format(path) != File_format::UNNAMED)
    throw Input_error("cannot show '" + path + "': a volume has no mesh; use 'equiaffine mesh --volume " + path +
                      outputs + ", with --level for a level other than 0");
}

} // namespace equiaffine
