// SPDX-License-Identifier: GPL-3.0-or-later
#include "request/options.h"

#include "attributes/error_columns.h"
#include "cli/command_line.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/io/input_file.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace equiaffine {

namespace {

const std::array<std::pair<const char*, Source_kind>, 3> sources = {{{"--function", Source_kind::FUNCTION},
                                                                     {"--volume", Source_kind::VOLUME},
                                                                     {"--distance-to", Source_kind::DISTANCE}}};

std::string needed_word(const Command_line& line, const std::string& option, const std::string& advice) {
  if (!line.has(option)) throw Input_error("the option " + option + " is missing; " + advice);
  return line.word(option, {});
}

/// The parts of a text between separators.
Words split(const std::string& text, char separator) {
  Words parts(1);
  for (const char c : text)
    if (c == separator) parts.emplace_back();
    else parts.back() += c;
  return parts;
}

std::optional<std::string> optional_word(const Command_line& line, const std::string& option) {
  if (!line.has(option)) return std::nullopt;
  return line.word(option, {});
}

Source_options read_kind(const Command_line& line) {
  Source_options source;
  const char* given = nullptr;
  for (const auto& [option, kind] : sources) {
    if (!line.has(option)) continue;
    if (given) throw Input_error(std::string(given) + " and " + option + " are both given; give one source");
    given = option;
    source.kind = kind;
    source.text = line.word(option, {});
  }
  if (!given)
    throw Input_error(std::string("no source is given; use ") + (line.command == "sample"
                                                                     ? "--function or --distance-to"
                                                                     : "--function, --volume or --distance-to"));
  return source;
}

std::array<double, 3> read_triple(const Command_line& line, const std::string& option, double otherwise) {
  std::array<double, 3> result = {otherwise, otherwise, otherwise};
  if (line.has(option))
    for (std::size_t a = 0; a < 3; ++a) result[a] = parse_finite_number(option, line.options.at(option)[a]);
  return result;
}

/// For a volume in a file `.raw`; the options are refused for others.
std::optional<Raw_layout> read_raw_layout(const Command_line& line, const Source_options& source) {
  if (line.command == "sample") return std::nullopt; // its --type is that of what it writes
  const bool is_raw = source.kind == Source_kind::VOLUME && has_extension(source.text, ".raw");
  for (const char* option : {"--dims", "--spacing", "--origin", "--type"})
    if (line.has(option) && !is_raw)
      fail_option(option, "it is for a --volume FILE.raw, which has no header", "leave it out");
  if (!is_raw) return std::nullopt;
  for (const char* option : {"--dims", "--type"})
    if (!line.has(option))
      throw Input_error(std::string("the option ") + option +
                        " is missing; a .raw has no header, say for instance --dims 256 256 128 --type int16");
  Raw_layout layout{};
  for (std::size_t a = 0; a < 3; ++a) layout.dims[a] = parse_count("--dims", line.options.at("--dims")[a], 2);
  layout.spacing = read_triple(line, "--spacing", 1);
  layout.origin = read_triple(line, "--origin", 0);
  layout.type =
      parse_choice("--type", line.word("--type", {}),
                   {"uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float", "double"});
  return layout;
}

std::optional<double> read_narrow_band(const Command_line& line, const Source_options& source) {
  if (!line.has("--narrow-band")) return std::nullopt;
  if (source.kind != Source_kind::DISTANCE) fail_option("--narrow-band", "it is for --distance-to", "leave it out");
  const std::string word = line.word("--narrow-band", {});
  const double band = parse_finite_number("--narrow-band", word);
  if (!(band >= 1)) fail_option("--narrow-band", "'" + word + "' is less than 1 voxel", "give some 16 voxels");
  return band;
}

void check_source(const Command_line& line, const Source_options& source) {
  if (line.has("--set") && source.kind != Source_kind::FUNCTION)
    fail_option("--set", "only a --function has constants", "leave it out");
  if (source.kind == Source_kind::VOLUME)
    for (const char* option : {"--box", "--resolution"})
      if (line.has(option)) fail_option(option, "a --volume has its own", "leave it out");
  if (source.kind != Source_kind::FUNCTION && source.derivatives == Derivatives::JETS)
    fail_option("--derivatives", "jets need a formula, and this source is known by samples only",
                "leave it out or use spline");
  const bool is_sampled = line.command != "evaluate" || source.derivatives == Derivatives::SPLINE;
  if (source.kind == Source_kind::FUNCTION && is_sampled && !source.box)
    throw Input_error(
        "the option --box is missing; say where the --function is to be sampled, such as --box -2 2 -2 2 -2 2");
}

Spline_options read_spline(const Command_line& line, Derivatives derivatives) {
  Spline_options spline;
  if (derivatives == Derivatives::JETS)
    for (const char* option : {"--spline-degree", "--spline-scheme", "--smoothing"})
      if (line.has(option))
        fail_option(option, "it is for splines, and the derivatives are those of the formula",
                    "add --derivatives spline or leave it out");
  constexpr std::array schemes = {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::INTERPOLATION,
                                  Spline_scheme::CONVOLUTION, Spline_scheme::PAPER};
  spline.scheme = schemes[parse_choice("--spline-scheme", line.word("--spline-scheme", "quasi-interpolation"),
                                       {"quasi-interpolation", "interpolation", "convolution", "paper"})];
  const bool is_paper = spline.scheme == Spline_scheme::PAPER;
  constexpr std::array degrees = {5, 7, 9};
  spline.degree =
      degrees[parse_choice("--spline-degree", line.word("--spline-degree", is_paper ? "5" : "7"), {"5", "7", "9"})];
  if (is_paper && spline.degree != 5)
    fail_option("--spline-degree", "the paper's spline has degree 5", "leave it out or use another --spline-scheme");
  if (const std::string smoothing = line.word("--smoothing", "0"); smoothing == "auto") spline.smoothing.reset();
  else {
    spline.smoothing = parse_finite_number("--smoothing", smoothing);
    constexpr double most = 100; // voxels
    if (!(*spline.smoothing >= 0 && *spline.smoothing <= most))
      fail_option("--smoothing", "'" + smoothing + "' is not between 0 and 100 voxels",
                  "use 0 for none, some 1.5 to 8 for noise, or auto");
  }
  return spline;
}

Source_options read_source(const Command_line& line) {
  Source_options source = read_kind(line);
  if (line.has("--set"))
    for (const std::string& word : line.options.at("--set"))
      if (!source.constants.insert(parse_constant("--set", word)).second)
        fail_option("--set " + word, "the name has a value already", "give each name once");
  if (line.has("--box")) source.box = parse_box("--box", line.options.at("--box"));
  if (line.has("--resolution")) source.resolution = parse_resolution("--resolution", line.options.at("--resolution"));
  if (line.has("--transform"))
    source.transformation = parse_transformation("--transform", line.options.at("--transform"));
  const std::string usual = source.kind == Source_kind::FUNCTION ? "jets" : "spline";
  source.derivatives =
      static_cast<Derivatives>(parse_choice("--derivatives", line.word("--derivatives", usual), {"jets", "spline"}));
  check_source(line, source);
  source.spline = read_spline(line, source.derivatives);
  source.raw = read_raw_layout(line, source);
  source.narrow_band = read_narrow_band(line, source);
  return source;
}

Orientation_of_level_set read_orientation(const Command_line& line) {
  return static_cast<Orientation_of_level_set>(
      parse_choice("--orientation", line.word("--orientation", "gradient"), {"gradient", "against"}));
}

/// The attributes of --attributes but for the error estimates, which `source` is told of.
Attribute_selection read_attributes(const Command_line& line, Source_options& source) {
  std::string list;
  for (const std::string& name : split(line.word("--attributes", "basic"), ',')) {
    const bool is_error = std::find(error_attributes.begin(), error_attributes.end(), name) != error_attributes.end();
    source.spline.estimates_errors = source.spline.estimates_errors || is_error;
    if (!is_error) list += (list.empty() ? "" : ",") + name;
  }
  if (source.spline.estimates_errors && source.derivatives == Derivatives::JETS)
    fail_option("--attributes", "errors are estimated for splines, and the derivatives of a formula have none",
                "add --derivatives spline or leave them out");
  try {
    return select_attributes(list.empty() && source.spline.estimates_errors ? "status" : list);
  } catch (const Input_error& error) {
    throw Input_error(std::string("--attributes: ") + error.what());
  }
}

Estimator read_estimator(const Command_line& line) {
  return static_cast<Estimator>(parse_choice("--estimator", line.word("--estimator", "compact"),
                                             {"compact", "transformation", "direct", "direct-z"}));
}

std::size_t read_threads(const Command_line& line) {
  constexpr std::size_t most = 1024; // what a thread pool of any computer today takes without harm
  const std::string word = line.word("--threads", {});
  const std::size_t threads = parse_count("--threads", word, 1);
  if (threads > most)
    fail_option("--threads", "'" + word + "' is more than " + std::to_string(most),
                "give the number of processor cores, or leave it out to use all of them");
  return threads;
}

std::string read_output(const Command_line& line) {
  return needed_word(line, "--output", "name the file to write, -o FILE");
}

Page_options read_page(const Command_line& line) {
  Page_options page;
  page.color = line.word("--color", "");
  page.up = {};
  page.up[parse_choice("--up", line.word("--up", "z"), {"x", "y", "z"})] = 1;
  return page;
}

Picture_options read_picture(const Command_line& line) {
  Picture_options picture;
  for (const char* option : {"--size", "--range", "--arrows"})
    if (line.has(option) && !line.has("--png"))
      fail_option(option, "it is for the picture of --png", "add --png or leave it out");
  if (line.has("--size"))
    for (std::size_t n = 0; n < 2; ++n) {
      constexpr std::size_t least = 100, most = 10'000; // for a legend, and for memory
      const std::string& word = line.options.at("--size")[n];
      picture.size[n] = parse_count("--size", word, least);
      if (picture.size[n] > most) fail_option("--size", "'" + word + "' is more than 10000", "give fewer pixels");
    }
  if (line.has("--range")) {
    const Words& words = line.options.at("--range");
    picture.range = {parse_finite_number("--range", words[0]), parse_finite_number("--range", words[1])};
    if (!((*picture.range)[0] < (*picture.range)[1]))
      fail_option("--range", "'" + words[0] + "' is not less than '" + words[1] + "'", "give the smaller number first");
  }
  picture.arrows = line.word("--arrows", "");
  return picture;
}

/// Checks that there is a page or picture, and that it will have the attributes it is to show.
void check_page(const Command_line& line, const Attribute_selection& attributes, const Spline_options& spline) {
  for (const char* option : {"--color", "--up"})
    if (line.has(option) && !line.has("--html") && !line.has("--png"))
      fail_option(option, "it is for the page of --html and the picture of --png", "add one of them or leave it out");
  const std::string arrows = line.word("--arrows", "");
  const bool has_arrows = std::count_if(attributes.columns.begin(), attributes.columns.end(),
                                        [&](const Attribute& attribute) { return attribute.group == arrows; }) == 3;
  if (!arrows.empty() && !has_arrows)
    fail_option("--arrows", "'" + arrows + "' is not among the vectors that are computed",
                "name one of them, such as affine_normal, or add it to --attributes");
  const std::string color = line.word("--color", "");
  if (color.empty()) return;
  const bool is_computed = std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                       [&](const Attribute& attribute) { return attribute.name == color; }) ||
                           (spline.estimates_errors && std::find(error_attributes.begin(), error_attributes.end(),
                                                                 color) != error_attributes.end());
  if (!is_computed && color != "plain" && !(color == "status" && attributes.has_status))
    fail_option("--color", "'" + color + "' is not among the attributes that are computed",
                "name one of them, such as affine_mean_curvature, or add it to --attributes");
}

/// Names of the same file are equal after this, whatever links and dots lead there.
std::filesystem::path canonical_output(const std::string& path) {
  if (path == "-") return path;
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error),
                              canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

void check_outputs(const std::vector<std::string>& paths) {
  std::set<std::filesystem::path> outputs;
  for (const std::string& path : paths)
    if (!outputs.insert(canonical_output(path)).second)
      throw Input_error("two outputs go to " + (path == "-" ? "standard output" : "'" + path + "'") +
                        "; give each its own name");
}

double read_length(const Command_line& line, const std::string& option) {
  if (!line.has(option)) return 0; // its default
  const std::string word = line.word(option, {});
  const double length = parse_finite_number(option, word);
  if (!(length > 0)) fail_option(option, "'" + word + "' is not a length", "give a number above 0, or leave it out");
  return length;
}

Delaunay_options read_delaunay_options(const Command_line& line, const Source_options& source) {
  if (line.has("--resolution") && source.derivatives == Derivatives::JETS)
    fail_option("--resolution", "--method delaunay needs no grid for a formula",
                "leave it out and say with --radius how fine the mesh is to be");
  Delaunay_options options;
  const std::string angle = line.word("--angle", "30");
  options.criteria = {parse_finite_number("--angle", angle), read_length(line, "--radius"),
                      read_length(line, "--distance")};
  if (!(options.criteria.angle >= 0 && options.criteria.angle <= 30))
    fail_option("--angle", "'" + angle + "' is not between 0 and 30 degrees",
                "give a smaller one: with more than 30 the refinement need not end");
  options.sizing = static_cast<Facet_sizing>(
      parse_choice("--sizing", line.word("--sizing", "uniform"), {"uniform", "euclidean", "affine"}));
  options.clips_to_ball = parse_choice("--clip", line.word("--clip", "box"), {"box", "ball"}) == 1;
  return options;
}

/// `--method` and the options that belong to it.
std::variant<Marching_cubes_options, Delaunay_options> read_method(const Command_line& line,
                                                                   const Source_options& source) {
  const std::initializer_list<std::string_view> methods = {"marching-cubes", "delaunay"};
  const bool is_delaunay = parse_choice("--method", line.word("--method", "marching-cubes"), methods) == 1;
  const Words others =
      is_delaunay ? Words{"--vertices"} : Words{"--angle", "--radius", "--distance", "--sizing", "--clip"};
  for (const std::string& option : others)
    if (line.has(option))
      fail_option(option, std::string("it is for --method ") + (is_delaunay ? "marching-cubes" : "delaunay"),
                  is_delaunay ? "leave it out" : "add --method delaunay or leave it out");
  if (is_delaunay) return read_delaunay_options(line, source);
  return Marching_cubes_options{static_cast<Vertex_position>(
      parse_choice("--vertices", line.word("--vertices", "projected"), {"projected", "linear"}))};
}

/// The expansions of the paper's scheme are those of no function, which other ways to find a surface need.
void check_scheme(const Mesh_options& options) {
  if (options.source.spline.scheme != Spline_scheme::PAPER) return;
  const auto* cubes = std::get_if<Marching_cubes_options>(&options.method);
  if (!cubes || cubes->vertices != Vertex_position::LINEAR || options.curves)
    fail_option("--spline-scheme", "paper is for Marching Cubes with linear vertices and without parabolic curves",
                "add --vertices linear, or use convolution");
}

Mesh_options read_mesh_options(const Command_line& line) {
  Mesh_options options;
  options.source = read_source(line);
  options.isovalue = parse_finite_number("--isovalue", line.word("--isovalue", "0"));
  options.source.spline.isovalue = options.isovalue;
  options.orientation = read_orientation(line);
  options.method = read_method(line, options.source);
  options.attributes = read_attributes(line, options.source);
  options.estimator = read_estimator(line);
  options.output = read_output(line);
  options.html = optional_word(line, "--html");
  options.png = optional_word(line, "--png");
  options.curves = optional_word(line, "--parabolic-curves");
  options.stats = optional_word(line, "--stats");
  options.page = read_page(line);
  options.picture = read_picture(line);
  check_page(line, options.attributes, options.source.spline);
  check_scheme(options);
  std::vector<std::string> outputs = {options.output};
  for (const auto& output : {options.html, options.png, options.curves, options.stats})
    if (output) outputs.push_back(*output);
  check_outputs(outputs);
  return options;
}

Evaluate_options read_evaluate_options(const Command_line& line) {
  Evaluate_options options;
  options.source = read_source(line);
  options.orientation = read_orientation(line);
  options.attributes = read_attributes(line, options.source);
  options.estimator = read_estimator(line);
  options.points = needed_word(line, "--points", "name the file with the points");
  options.output = read_output(line);
  if (options.source.kind == Source_kind::DISTANCE && options.source.text == "-" && options.points == "-")
    throw Input_error("--distance-to and --points both read standard input; name a file for one of them");
  return options;
}

Sample_options read_sample_options(const Command_line& line) {
  return {read_source(line), parse_choice("--type", line.word("--type", "double"), {"float", "double"}) == 0,
          read_output(line)};
}

View_options read_view_options(const Command_line& line) {
  if (!line.has("MESH.ply")) throw Input_error("no mesh is given; write 'equiaffine view MESH.ply -o PAGE.html'");
  View_options options{line.word("MESH.ply", {}), optional_word(line, "--output"), optional_word(line, "--png"),
                       read_page(line), read_picture(line)};
  if (!options.html && !options.png)
    throw Input_error("no output is given; name the page, -o PAGE.html, or the picture, --png FILE.png");
  if (options.html && options.png) check_outputs({*options.html, *options.png});
  return options;
}

} // namespace

std::array<std::size_t, 3> default_resolution(Source_kind kind) {
  const std::size_t n = kind == Source_kind::DISTANCE ? 129 : 64;
  return {n, n, n};
}

Options parse_options(const std::vector<std::string>& arguments) {
  const Command_line line = split_command_line(arguments);
  if (line.information) return {Information{*line.information}, {}};
  Options options;
  if (line.has("--threads")) options.threads = read_threads(line);
  if (line.command == "mesh") options.command = read_mesh_options(line);
  else if (line.command == "evaluate") options.command = read_evaluate_options(line);
  else if (line.command == "sample") options.command = read_sample_options(line);
  else options.command = read_view_options(line);
  return options;
}

} // namespace equiaffine
