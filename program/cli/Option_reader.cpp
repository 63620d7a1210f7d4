// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/Option_reader.h"

#include "cli/option_values.h"
#include "cli/suggestions.h"
#include "system/front_end.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

namespace equiaffine {

void Option_reader::read(const Option_row& row) {
  const std::string name = row.name();
  if (has(name) && names_read_.insert(name).second) row.read({name, line_.options.at(name), row.type}, request_);
}

void Option_reader::read(std::initializer_list<const char*> options) {
  for (const std::string option : options)
    for (const Option_row* row : options_of(command()))
      if (row->name() == option) read(*row);
}

void Option_reader::read_rest() {
  for (const Option_row* row : options_of(command())) read(*row);
}

void Option_reader::refuse(std::initializer_list<const char*> options, const std::string& reason,
                           const std::string& advice) const {
  for (const char* option : options)
    if (has(option)) fail_option(option, reason, advice);
}

void Option_reader::need(const std::string& option, const std::string& advice) const {
  if (!has(option)) throw Input_error(by_front_end("the option ", "") + option_text(option) + " is missing; " + advice);
}

namespace {

/// Resolves links and dots, so that paths of the same file are equal.
std::filesystem::path canonical_path(const std::string& path) {
  if (path == "-") return path;
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error),
                              canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

/// Whether two paths lead to the same file, also by symbolic or hard links.
bool are_same_file(const std::string& path, const std::string& other) {
  std::error_code error;
  return canonical_path(path) == canonical_path(other) || std::filesystem::equivalent(path, other, error);
}

} // namespace

std::vector<std::string> input_files(const Option_reader& reader) {
  std::vector<std::string> files;
  for (const char* option : {"FILE", "volume", "distance_to", "fit", "points", "range_of", "MESH.ply", "MESH"})
    if (reader.has(option)) files.push_back(reader.word(option));
  if (const Source_options& source = reader.request().source; source.kind == Source_kind::VOLUME && !source.raw)
    for (std::string& file : files_read_with(source.text)) files.push_back(std::move(file));
  if (reader.has("function"))
    if (const auto file = formula_file(reader.word("function"))) files.push_back(*file);
  return files;
}

void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::optional<std::string>>& outputs) {
  std::set<std::filesystem::path> paths;
  for (const auto& path : outputs) {
    if (!path) continue;
    if (!paths.insert(canonical_path(*path)).second)
      throw Input_error("two outputs go to " + (path == "-" ? "standard output" : "'" + *path + "'") +
                        "; give them different names");
    for (const std::string& input : inputs)
      if (path != "-" && input != "-" && are_same_file(*path, input))
        throw Input_error("the output '" + *path + "' would overwrite an input; give it another name");
  }
}

void need_output(const Option_reader& reader) { reader.need("output", "name the file to write, -o FILE"); }

void refuse_picture_options(const Option_reader& reader) {
  if (!reader.has("png"))
    reader.refuse({"size", "arrows"}, "it applies only to a picture",
                  by_front_end("add --png", "give a path with .png") + " or leave it out");
}

void refuse_page_options(const Option_reader& reader) {
  if (!reader.has("html") && !reader.has("png"))
    reader.refuse({"color", "up", "colors", "range", "range_of"}, "it applies only to --html and --png",
                  "add one of them or leave it out");
}

namespace {

[[noreturn]] void fail_without_source(Command command) {
  const std::string options =
      command == SAMPLE ? "--function, --distance-to or --fit" : "--function, --volume, --distance-to or --fit";
  throw Input_error("the source is missing" +
                    (command == REGISTER     ? " on one side of the word 'to'; name a file there or use " + options
                     : command == SYMMETRIES ? "; name a file or use " + options
                                             : "; use " + options));
}

/// Throws for options of fits if the source is not a fit.
void refuse_fit_options(const Option_reader& reader) {
  const auto refuse = [&](const std::string& reason, const std::string& advice) {
    reader.refuse({"scale", "noise", "degree", "feature_angle"}, "it applies only to fits; " + reason, advice);
  };
  const Source_options& source = reader.request().source;
  switch (source.kind) {
  case Source_kind::FUNCTION: return refuse("a formula has no points to fit", "leave it out");
  case Source_kind::VOLUME:
    return refuse("a volume gets a spline",
                  "leave it out, and smooth the samples with " + option_text("smoothing", "auto"));
  case Source_kind::DISTANCE:
    return refuse("a distance gets a spline", "use --fit " + source.text + " instead of --distance-to");
  case Source_kind::FIT: return;
  }
}

void read_kind(Option_reader& reader) {
  std::string given;
  for (const char* option : {"FILE", "function", "volume", "distance_to", "fit"}) {
    if (!reader.has(option)) continue;
    const std::string text = option == std::string("FILE") ? "'" + reader.word(option) + "'" : option_text(option);
    if (!given.empty()) throw Input_error(given + " and " + text + " are both given; give one source");
    given = text;
    reader.read({option});
  }
  if (given.empty()) fail_without_source(reader.command());
  if (reader.has("FILE")) check_is_no_formula(reader.word("FILE"));
  Source_options& source = reader.request().source;
  const bool has_derivatives = source.kind == Source_kind::FUNCTION || source.kind == Source_kind::FIT;
  source.derivatives = has_derivatives ? Derivatives::JETS : Derivatives::SPLINE;
}

/// Checks that the options suit the kind of the source, and that a formula that is sampled has a box.
void check_kind(const Option_reader& reader) {
  const Source_options& source = reader.request().source;
  if (source.kind != Source_kind::FUNCTION)
    reader.refuse({"constants"}, "only a formula has constants", "leave it out");
  if (source.kind == Source_kind::VOLUME)
    reader.refuse({"box", "resolution"}, "a volume has its own grid", "leave it out");
  const bool is_sampled_only = source.kind == Source_kind::VOLUME || source.kind == Source_kind::DISTANCE;
  if (source.kind == Source_kind::FIT && source.derivatives == Derivatives::SPLINE)
    fail_option("derivatives", "a fit is defined only near its points, which is too little for a spline",
                "leave it out to use the fit's own derivatives");
  if (is_sampled_only && source.derivatives == Derivatives::JETS)
    fail_option("derivatives", "jets need a formula or a fit, and this source has only samples",
                "leave it out or use spline");
  const bool is_sampled = reader.command() != EVALUATE || source.derivatives == Derivatives::SPLINE;
  if (source.kind == Source_kind::FUNCTION && is_sampled)
    reader.need("box", "give the region where the formula is sampled, such as " +
                           by_front_end("--box -2 2 -2 2 -2 2", "box=2"));
}

void read_spline(Option_reader& reader) {
  if (reader.request().source.derivatives == Derivatives::JETS)
    reader.refuse({"spline_degree", "spline_scheme", "smoothing"},
                  "it applies only to splines, and the derivatives are those of the formula or the fit",
                  reader.request().source.kind == Source_kind::FIT
                      ? "leave it out"
                      : "add " + option_text("derivatives", "spline") + " or leave it out");
  reader.read({"spline_scheme", "spline_degree"});
  const Volume_options& spline = reader.request().source.spline;
  if (spline.spline_scheme == Spline_scheme::PAPER && spline.spline_degree != 5)
    fail_option("spline_degree", option_text("spline_scheme", "paper") + " has degree 5",
                "leave it out or use another " + option_text("spline_scheme"));
  reader.read({"smoothing"});
}

/// Reads the layout of a .raw file; refuses these options for other files.
void read_raw_layout(Option_reader& reader) {
  if (reader.command() == SAMPLE) return; // its --type is the type that it writes
  const Source_options& source = reader.request().source;
  const bool is_raw = source.kind == Source_kind::VOLUME && has_extension(source.text, ".raw");
  if (!is_raw)
    return reader.refuse({"dims", "spacing", "origin", "type"},
                         "it applies only to --volume FILE.raw, which has no header", "leave it out");
  for (const char* option : {"dims", "type"})
    reader.need(option, by_front_end("write for example --dims 256 256 128 --type int16, since ", "give it, since ") +
                            "a .raw file has no header");
  reader.read({"dims", "spacing", "origin", "type"});
}

/// Reads the options that select a part of a volume file; refuses them for other sources.
void read_selection(Option_reader& reader) {
  const Source_options& source = reader.request().source;
  if (source.kind != Source_kind::VOLUME)
    reader.refuse({"component", "time", "allow_outside"}, "it applies only to --volume", "leave it out");
  if (source.raw) reader.refuse({"component", "time", "allow_outside"}, "a .raw file has no header", "leave it out");
  reader.read({"component", "time", "allow_outside"});
}

} // namespace

void read_source(Option_reader& reader) {
  read_kind(reader);
  reader.read({"constants", "box", "resolution", "transform", "derivatives"});
  check_kind(reader);
  read_spline(reader);
  read_raw_layout(reader);
  read_selection(reader);
  if (reader.request().source.kind != Source_kind::DISTANCE)
    reader.refuse({"narrow_band"}, "it applies only to --distance-to", "leave it out");
  refuse_fit_options(reader);
  reader.read({"narrow_band", "scale", "noise", "degree", "feature_angle"});
}

} // namespace equiaffine
