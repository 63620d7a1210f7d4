// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimates.h"
#include "cli/command_line.h"
#include "system/front_end.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace equiaffine {

namespace {

template <class Names>
std::string joined(const Names& names, const std::string& separator) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : separator) + std::string(name);
  return text;
}

/// Breaks a text into the fewest lines of the width.
std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    const bool is_full = !line.empty() && line.size() + 1 + word.size() > width;
    if (is_full) result += line + '\n';
    line = is_full || line.empty() ? word : line + ' ' + word;
  }
  return result + line;
}

/// The names of the estimates other than errors.
std::vector<std::string> estimates_of_scale() {
  std::vector<std::string> names;
  for (const auto& attribute : estimate_attributes())
    if (attribute.kind != Estimate_kind::ERROR) names.push_back(attribute.name);
  return names;
}

/// The help of annotate's option --attributes, in lines of at most 88 characters, with names from the library's table.
std::string attributes_of_fit_help() {
  const Attribute_names names = attribute_names();
  return wrapped("attributes to compute: basic (the default) is " + joined(names.basic, ", ") + ", status, " +
                     joined(error_attributes(), ", ") + "; all adds " + joined(names.added_by_all, ", ") + ", " +
                     joined(estimates_of_scale(), ", ") + "; LIST is any of these names, separated by commas, also " +
                     joined(names.by_name, ", "),
                 88);
}

/// The same for other commands.
std::string attributes_help() {
  const Attribute_names names = attribute_names();
  return wrapped("attributes to compute: basic (the default) is " + joined(names.basic, ", ") + ", status; all adds " +
                     joined(names.added_by_all, ", ") + "; LIST is any of these names, separated by commas, also " +
                     joined(names.by_name, ", ") +
                     ", signature (affine curvatures, pick_invariant, and the norms of their gradients); for a "
                     "spline affine_gaussian_curvature_error, affine_mean_curvature_error; for a fit, basic also has "
                     "the estimate NAME_error of each NAME in it, and all adds " +
                     joined(estimates_of_scale(), ", "),
                 88);
}

using enum Option_group;

#ifdef EQUIAFFINE_WITH_VTK
const std::string vtp = " .vtp";
#else
const std::string vtp;
#endif

Attribute_selection select(const std::string& list, const std::string& option) {
  try {
    return select_attributes(list);
  } catch (const Input_error& error) {
    throw Input_error(option_text(option) + ": " + error.what());
  }
}

/// The words of a list of attributes: those that the library computes, and estimates, which the source provides.
struct Attribute_words {
  Words attributes;
  std::set<std::string> estimates;

  void add(Estimate_kind kind) {
    for (const auto& attribute : estimate_attributes())
      if (attribute.kind == kind) estimates.insert(attribute.name);
  }
};

Attribute_words split_attributes(const Option_words& option) {
  Attribute_words words;
  const auto& known = estimate_attributes();
  for (const std::string& name : split(option.word(), ',')) {
    const bool is_estimate = std::any_of(known.begin(), known.end(), [&](const auto& a) { return a.name == name; });
    if (is_estimate) words.estimates.insert(name);
    else words.attributes.push_back(name);
  }
  return words;
}

/// Stores the words in the request, estimates in the order of their table.
void select(const Attribute_words& words, const std::string& option, Request& request) {
  std::string list;
  for (const std::string& name : words.attributes) list += (list.empty() ? "" : ",") + name;
  request.attributes = select(list.empty() && !words.estimates.empty() ? "status" : list, option);
  request.estimates.clear();
  for (const auto& attribute : estimate_attributes())
    if (words.estimates.contains(attribute.name)) request.estimates.push_back(attribute.name);
}

/// Adds the estimates to the lists of attributes of a fit.
void add_estimates_of_lists(Attribute_words& words) {
  for (const std::string& name : words.attributes) {
    if (name == "all" || name == "basic") words.add(Estimate_kind::ERROR);
    if (name != "all") continue;
    words.add(Estimate_kind::NOISE);
    words.add(Estimate_kind::DETAIL);
  }
}

/// Checks the estimates for a source that is not a fit, and adds those that are computed together.
void complete_estimates(const Option_words& option, const Request& request, Attribute_words& words) {
  if (words.estimates.empty()) return;
  for (const auto& attribute : estimate_attributes())
    if (!attribute.is_of_splines && words.estimates.contains(attribute.name))
      fail_option(option.name, "'" + attribute.name + "' is estimated only for fits",
                  by_front_end("use --fit", "use a fit") + " or leave it out");
  if (request.source.derivatives == Derivatives::JETS)
    fail_option(option.name, "errors are estimated only for splines and fits; the derivatives of a formula are exact",
                by_front_end("add --derivatives spline or ", "") + "leave them out");
  for (const auto& attribute : estimate_attributes())
    if (attribute.is_of_splines) words.estimates.insert(attribute.name);
}

/// Reads the attributes of the command annotate.
void read_attributes_of_fit(const Option_words& option, Request& request) {
  Attribute_words words = split_attributes(option);
  for (const std::string& name : words.attributes)
    if (name == "signature" || name.ends_with("_gradient"))
      fail_option(option.name, "'" + name + "' needs a function; fits at points have no gradients of curvatures",
                  "leave it out, or use " + by_front_end("mesh --fit", "fit(V).mesh()"));
  add_estimates_of_lists(words);
  select(words, option.name, request);
}

void read_output(const Option_words& option, Request& request) { request.output = option.word(); }

const std::vector<Option_row> rows_of_outputs = {
    {"-o,--output", MESH, OUTPUT, 1, "OUT",
     "the mesh, .ply .off .obj .stl .vtp, or its vertices, .csv; - writes OFF to standard output.\n"
     ".ply .csv .vtp contain the attributes, .obj the normals",
     read_output},
    {"-o,--output", EVALUATE, OUTPUT, 1, "OUT",
     "the points with their attributes, .csv or .ply; - writes CSV to standard output", read_output},
    {"-o,--output", SAMPLE, OUTPUT, 1, "VOLUME", "the volume: .nrrd .mhd .mha .nii .nii.gz .vti", read_output},
    {"-o,--output", VIEW, OUTPUT, 1, "PAGE.html", "the page, required without --png; - writes to standard output",
     read_output},
    {"-o,--output", ANNOTATE, OUTPUT, 1, "OUT",
     "the same vertices and faces with attributes, .ply .vtp, or the vertices, .csv; - writes CSV\n"
     "to standard output",
     read_output},
    {"-o,--output", REGISTER, OUTPUT, 1, "MAP.json", "the map, or \"found\": false; - writes to standard output",
     read_output},
    {"-o,--output", SYMMETRIES, OUTPUT, 1, "MAPS.json", "the maps; - writes to standard output", read_output},
    {"--moved", REGISTER, OUTPUT, 1, "OUT",
     "also write the moved source, a mesh with distances from the target: .ply .off .obj .stl\n"
     ".vtp .csv",
     [](const Option_words& option, Request& request) { request.moved = option.word(); }},
    {"--type", SAMPLE, OUTPUT, 1, "float|double", "type of the samples, by default double",
     [](const Option_words& option, Request& request) {
       request.samples_are_float = parse_choice(option, {true, false});
     }},
    {"--attributes", MESH | EVALUATE, OUTPUT, 1, "basic|all|none|LIST", attributes_help(),
     [](const Option_words& option, Request& request) {
       Attribute_words words = split_attributes(option);
       if (request.source.kind == Source_kind::FIT) add_estimates_of_lists(words);
       else complete_estimates(option, request, words);
       select(words, option.name, request);
     }},
    {"--attributes", ANNOTATE, OUTPUT, 1, "basic|all|none|LIST", attributes_of_fit_help(), read_attributes_of_fit},
    {"--estimator", MESH | EVALUATE, OUTPUT, 1, "compact|transformation|direct|direct-z",
     "formulas for conormal, affine_normal, affine_gaussian_curvature and affine_mean_curvature:\n"
     "ours (compact, the default), or those of Andrade and Lewiner, for comparison",
     [](const Option_words& option, Request& request) {
       request.estimator = parse_choice(
           option, {Estimator::COMPACT, Estimator::TRANSFORMATION, Estimator::DIRECT, Estimator::DIRECT_Z});
     }},
    {"--html", MESH | ANNOTATE | registering, OUTPUT, 1, "PAGE.html",
     "also write an interactive web page that works offline",
     [](const Option_words& option, Request& request) { request.display.html = option.word(); }},
    {"--png", MESH | VIEW | ANNOTATE | registering, OUTPUT, 1, "PICTURE.png",
     "also write a picture, the initial view of the page; needs no display",
     [](const Option_words& option, Request& request) { request.display.png = option.word(); }},
    {"--color", MESH | VIEW | ANNOTATE | registering, OUTPUT, 1, "NAME",
     "attribute that page and picture show first, or status or plain",
     [](const Option_words& option, Request& request) { request.display.color = option.word(); }},
    {"--up", MESH | VIEW | ANNOTATE | registering, OUTPUT, 1, "x|y|z|auto",
     "axis that points up: by default z for formulas and volumes; otherwise auto, which is y, as\n"
     "in most scans, or z if the shape has a wider base along z",
     [](const Option_words& option, Request& request) {
       using Up = std::optional<std::array<double, 3>>;
       const auto up = parse_choice<Up>(option, {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, std::nullopt});
       if (up) request.display.up = *up;
       request.display.guesses_up = !up;
     }},
    {"--colors", MESH | VIEW | ANNOTATE | registering, OUTPUT, 1, "linear|logarithmic|equalized|auto",
     "color scale; equalized maps equal areas of the surface to equal parts of the color bar, for\n"
     "each sign. By default (auto) the first of these scales that puts the median at least 1/8 of\n"
     "the bar away from white",
     [](const Option_words& option, Request& request) {
       using Scale = std::optional<Color_scale>;
       request.display.colors =
           parse_choice<Scale>(option, {Color_scale::LINEAR, Color_scale::ASINH, Color_scale::EQUALIZED, std::nullopt});
     }},
    {"--size", MESH | VIEW | ANNOTATE | registering, OUTPUT, 2, "WIDTH HEIGHT",
     "size of the picture in pixels, by default 1000 800",
     [](const Option_words& option, Request& request) {
       constexpr std::size_t least = 100, most = 10'000; // for a legend, and for memory
       for (std::size_t n = 0; n < 2; ++n) {
         const std::string& word = option.words[n];
         request.display.size[n] = parse_count(option.name, word, least);
         if (request.display.size[n] > most)
           fail_option(option.name, "'" + word + "' is more than 10000 pixels", "give fewer pixels");
       }
     }},
    {"--range", MESH | VIEW | ANNOTATE | registering, OUTPUT, 2, "LOW HIGH",
     "values at the ends of the color bar, by default quantiles; blue and red on both sides of\n"
     "white if LOW is -HIGH",
     [](const Option_words& option, Request& request) {
       const auto& [name, words, type] = option;
       const double low = parse_finite_number(name, words[0]), high = parse_finite_number(name, words[1]);
       if (!(low < high))
         fail_option(name, "'" + words[0] + "' is not less than '" + words[1] + "'", "give the smaller number first");
       request.display.range = {low, high};
     }},
    {"--range-of", MESH | VIEW | ANNOTATE | registering, OUTPUT, 1, "FILE",
     "take the color scale from a page of this program, .html, or from a mesh with the same\n"
     "attribute, .ply, to compare two surfaces",
     [](const Option_words& option, Request& request) {
       if (request.display.range)
         fail_option(option.name, option_text("range") + " also sets the ends of the color bar",
                     "leave one of them out");
       request.display.range_of = option.word();
     }},
    {"--arrows", MESH | VIEW | ANNOTATE | SYMMETRIES, OUTPUT, 1, "VECTOR",
     "vector to draw as arrows on the picture, such as affine_normal",
     [](const Option_words& option, Request& request) { request.display.arrows = option.word(); }},
    {"--parabolic-curves", MESH, OUTPUT, 1, "CURVES",
     "also write the curves on the surface where gaussian_curvature changes its sign:\n"
     ".obj" +
         vtp + "; - writes OBJ to standard output",
     [](const Option_words& option, Request& request) { request.parabolic_curves = option.word(); }},
    {"--stats", MESH | ANNOTATE, OUTPUT, 1, "FILE.json",
     "also write statistics: sizes, topology, status, accuracy, times",
     [](const Option_words& option, Request& request) { request.stats = option.word(); }},
};

} // namespace

std::span<const Option_row> output_options() { return rows_of_outputs; }

} // namespace equiaffine
