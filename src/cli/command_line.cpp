// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include "cli/help_texts.h"
#include <equiaffine/Input_error.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <memory>

namespace equiaffine {

namespace {

/// Help as CLI11 makes it, but with our own usage lines (they are part of the descriptions), and in the list of
/// commands only what each one does.
class Help_formatter : public CLI::Formatter {
public:
  Help_formatter() { column_width(30); }
  std::string make_usage(const CLI::App*, std::string) const override { return {}; }
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_name().empty() ? "" : " " + option->get_type_name();
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::string name = "  " + command->get_name();
    name.resize(14, ' ');
    const std::string description = command->get_description();
    return name + description.substr(0, description.find('\n')) + '\n';
  }
};

/// The command line's grammar as a CLI::App, and what was found.
class Grammar {
public:
  Grammar() : app_(program_description, "equiaffine") {
    app_.formatter(std::make_shared<Help_formatter>());
    app_.get_formatter()->label("Subcommands", "Commands");
    app_.set_help_flag("-h,--help", "show this help");
    app_.set_version_flag("--version", "equiaffine " EQUIAFFINE_VERSION, "show the version");
    app_.footer(program_footer);
    app_.require_subcommand(0, 1);
    app_.allow_extras();
    add_mesh();
    add_evaluate();
    add_sample();
    add_view();
  }

  Command_line split(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());
    try {
      app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
      result_.information = CLI::detail::find_and_replace(app_.help(), "\n\n\n", "\n\n");
      return result_;
    } catch (const CLI::CallForVersion& version) {
      result_.information = std::string(version.what()) + '\n';
      return result_;
    } catch (const CLI::ArgumentMismatch& error) { // "--box: 6 required .. missing"
      const std::string text = error.what(), option = text.substr(0, text.find(':'));
      fail_option(option, "it needs " + app_.get_subcommands().front()->get_option(option)->get_type_name(),
                  see_help());
    } catch (const CLI::ParseError& error) {
      throw Input_error(std::string(error.what()) + "; " + see_help());
    }
    check_words();
    return result_;
  }

private:
  CLI::App& add_command(const std::string& name, const std::string& description, const std::string& footer) {
    CLI::App& command = *app_.add_subcommand(name, description);
    command.group("Commands");
    command.footer(footer);
    command.allow_extras();
    return command;
  }

  /// An option with `size` words; its key is the last of its names.
  CLI::Option& add(CLI::App& command, const std::string& names, int size, const std::string& type,
                   const std::string& description) {
    const std::string key = names.substr(names.find(',') + 1);
    CLI::Option& option = *command.add_option(
        names,
        [this, key](const CLI::results_t& words) {
          result_.options[key] = words;
          return true;
        },
        description);
    option.type_name(type)->type_size(size)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    option.group(group_);
    return option;
  }

  void add_function_and_mesh(CLI::App& command, const std::string& choices) {
    group_ = "Source (one of " + choices + ")";
    add(command, "--function", 1, "EXPR",
        "a formula in x, y, z: + - * / ^ ( ) pi e sqrt cbrt exp log sin cos tan\n"
        "asin acos atan atan2 sinh cosh tanh abs min max hypot pow; lhs = rhs means lhs - rhs");
    add(command, "--set", 1, "NAME=VALUE ...", "constants of the formula")
        .expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args();
    add(command, "--distance-to", 1, "MESH",
        "the signed distance, negative inside, to a closed mesh: .off .ply .obj .stl; - reads\n"
        "OFF from standard input");
    add(command, "--narrow-band", 1, "N",
        "measure distances up to N voxels only, which is faster; 16 are enough without --smoothing");
  }

  void add_box(CLI::App& command) {
    add(command, "--box", 6, "XMIN XMAX YMIN YMAX ZMIN ZMAX",
        "where a formula is looked at, before --transform; for a distance the mesh's box,\n"
        "widened on all sides by 10 % of its longest side, if not given");
  }

  void add_resolution(CLI::App& command) {
    add(command, "--resolution", 1, "N [NY NZ]",
        "nodes of the grid per axis, 2 or more: 64, for a distance 129; a volume has its own")
        .expected(1, 3);
  }

  void add_source(CLI::App& command) {
    add_function_and_mesh(command, "--function, --volume, --distance-to");
    add(command, "--volume", 1, "FILE",
        "a volume of samples: .nrrd .nhdr .mhd .mha .nii .nii.gz .inr .inr.gz .vti .raw, or a\n"
        "folder with a DICOM series");
    add(command, "--dims", 3, "NX NY NZ", "nodes of a .raw, which has no header; x runs fastest");
    add(command, "--type", 1, "TYPE",
        "type of the samples of a .raw: uint8 int8 uint16 int16 uint32 int32 uint64 int64\n"
        "float double");
    add(command, "--spacing", 3, "DX DY DZ", "steps between the nodes of a .raw, by default 1 1 1");
    add(command, "--origin", 3, "X Y Z", "place of the first node of a .raw, by default 0 0 0");
    add_box(command);
  }

  void add_surface(CLI::App& command) {
    add(command, "--transform", 9, "A11 A12 .. A33",
        "take the image of the surface under p -> A p, A given row by row");
    add(command, "--derivatives", 1, "jets|spline",
        "from the formula (jets, its default), or from a spline through samples\n"
        "on the grid (spline, the only way for volumes and distances)");
    add(command, "--spline-degree", 1, "5|7|9", "the degree of that spline, by default 7");
    add(command, "--spline-scheme", 1, "quasi-interpolation|interpolation|convolution|paper",
        "how samples become a spline: by a local filter (quasi-interpolation, the default) or a\n"
        "recursive one (interpolation), both of order degree + 1; with the samples as\n"
        "coefficients (convolution, order 2); or this in degree 5 at the nodes, linearly between\n"
        "them, as Andrade and Lewiner do (paper, with --vertices linear)");
    add(command, "--smoothing", 1, "S|auto",
        "smooth the samples first: the standard deviation of the weights in voxels, more than 1\n"
        "to have an effect, 0 by default, or what suits the noise in the samples (auto)");
    add(command, "--orientation", 1, "gradient|against",
        "normals towards larger f (gradient, the default) or smaller f (against)");
  }

  void add_attributes(CLI::App& command) {
    add(command, "--attributes", 1, "basic|all|none|LIST",
        "what to compute: basic (the default) is normal, k1, k2, gaussian_curvature,\n"
        "mean_curvature, conormal, affine_normal, affine_gaussian_curvature,\n"
        "affine_mean_curvature, pick_invariant, status; all adds affine_k1, affine_k2,\n"
        "direction1, direction2, metric; LIST is some of these words with commas between, also\n"
        "quadric_defect, signature (affine curvatures, pick_invariant, and the norms of their\n"
        "gradients), and for a spline affine_gaussian_curvature_error and\n"
        "affine_mean_curvature_error");
    add(command, "--estimator", 1, "compact|transformation|direct|direct-z",
        "how conormal, affine_normal, affine_gaussian_curvature and affine_mean_curvature are\n"
        "computed from the derivatives: our own formulas (compact, the default), or those of\n"
        "Andrade and Lewiner, to compare with");
  }

  void add_output(CLI::App& command, const std::string& type, const std::string& description) {
    group_ = "Output";
    add(command, "-o,--output", 1, type, description);
  }

  void add_page_options(CLI::App& command) {
    add(command, "--png", 1, "PICTURE.png", "also a picture, which is what the page shows first; needs no display");
    add(command, "--color", 1, "NAME", "the attribute that page and picture show first, or status or plain");
    add(command, "--up", 1, "x|y|z", "the axis that points up on them, by default z");
    add(command, "--size", 2, "WIDTH HEIGHT", "of the picture in pixels, by default 1000 800");
    add(command, "--range", 2, "LOW HIGH",
        "the numbers of the end colors of the picture, by default quantiles as on the page;\n"
        "blue and red about white if LOW is -HIGH");
    add(command, "--arrows", 1, "VECTOR", "arrows on the picture, such as affine_normal");
  }

  void add_threads(CLI::App& command) {
    add(command, "--threads", 1, "N", "threads to use, all by default; the result is always the same");
  }

  void add_mesh() {
    CLI::App& command = add_command("mesh", mesh_description, mesh_footer);
    add_source(command);
    group_ = "Surface";
    add(command, "--isovalue", 1, "V", "the level set f = V, by default 0");
    add_surface(command);
    group_ = "Sampling";
    add(command, "--method", 1, "marching-cubes|delaunay",
        "a mesh on the edges of a grid (marching-cubes, the default), or one of triangles with\n"
        "good angles that is proved to be complete where the function has bounds (delaunay)");
    add_resolution(command);
    add_threads(command);
    group_ = "Sampling with --method marching-cubes";
    add(command, "--vertices", 1, "projected|linear",
        "on the surface (projected, the default), or where linear interpolation along the\n"
        "grid edges finds it (linear)");
    group_ = "Sampling with --method delaunay";
    add(command, "--angle", 1, "DEG", "the least angle of triangles, at most 30, the default");
    add(command, "--radius", 1, "R",
        "the greatest radius of a ball about a point of the surface through the corners of a\n"
        "triangle, by default 1/50 of the diagonal of the box");
    add(command, "--distance", 1, "D",
        "the greatest distance of a triangle's circumcenter from the center of that ball, by\n"
        "default R/10");
    add(command, "--sizing", 1, "uniform|euclidean|affine",
        "triangles of one size (uniform, the default), smaller ones where a radius of curvature\n"
        "is less than 4 R (euclidean), or such of equal affine area (affine)");
    add(command, "--clip", 1, "box|ball", "cut the surface off at the box (the default) or at the largest ball in it");
    add_output(command, "OUT",
               "the mesh: .ply .off .obj .stl"
#ifdef EQUIAFFINE_WITH_VTK
               " .vtp"
#endif
               ", or its vertices as .csv; - writes OFF to standard\n"
               "output. Attributes are in .ply .csv"
#ifdef EQUIAFFINE_WITH_VTK
               " .vtp"
#endif
               ", normals in .obj");
    add_attributes(command);
    add(command, "--html", 1, "PAGE.html", "also a web page to look at the surface, without network");
    add_page_options(command);
    add(command, "--parabolic-curves", 1, "CURVES",
        "also the curves on the surface where gaussian_curvature is 0 and changes its sign:\n"
        ".obj"
#ifdef EQUIAFFINE_WITH_VTK
        " .vtp"
#endif
        "; - writes OBJ to standard output");
    add(command, "--stats", 1, "FILE.json", "also statistics: sizes, topology, status, accuracy, times");
  }

  void add_evaluate() {
    CLI::App& command = add_command("evaluate", evaluate_description, evaluate_footer);
    add_source(command);
    add(command, "--points", 1, "IN",
        "the points: .csv with a header that names x, y, z; .ply; .off; - reads one of these\n"
        "from standard input");
    group_ = "Surface";
    add_surface(command);
    add_resolution(command);
    add_threads(command);
    add_output(command, "OUT", "the points with their attributes, .csv or .ply; - writes CSV to standard output");
    add_attributes(command);
  }

  void add_sample() {
    CLI::App& command = add_command("sample", sample_description, sample_footer);
    add_function_and_mesh(command, "--function, --distance-to");
    group_ = "Sampling";
    add_box(command);
    add_resolution(command);
    add_threads(command);
    add_output(command, "VOLUME", "the volume: .nrrd .mhd .mha .nii .nii.gz .vti");
    add(command, "--type", 1, "float|double", "the type of the samples, by default double");
  }

  void add_view() {
    CLI::App& command = add_command("view", view_description, view_footer);
    group_ = "Input";
    add(command, "MESH.ply", 1, "", "a mesh as this program writes it, or any other .ply; - reads standard input");
    add_output(command, "PAGE.html", "the page, needed unless there is --png; - writes to standard output");
    add_page_options(command);
  }

  std::string see_help() const {
    const std::vector<CLI::App*> commands = app_.get_subcommands();
    return "see 'equiaffine" + (commands.empty() ? "" : " " + commands.front()->get_name()) + " --help'";
  }

  static Words names(const CLI::App& command) {
    Words names;
    for (const CLI::Option* option : command.get_options())
      if (option->nonpositional()) names.push_back("--" + option->get_lnames().front());
    return names;
  }

  void check_words() {
    if (const Words rest = app_.remaining(); !rest.empty()) {
      Words commands;
      for (const CLI::App* command : app_.get_subcommands({})) commands.push_back(command->get_name());
      if (rest.front().starts_with('-'))
        throw Input_error("option '" + rest.front() + "' before the command; write 'equiaffine COMMAND [options]', " +
                          see_help());
      throw Input_error("unknown command '" + rest.front() + "'" + suggestion(rest.front(), commands) + "; " +
                        see_help());
    }
    if (app_.get_subcommands().empty())
      throw Input_error("no command is given; use mesh, evaluate, sample or view, " + see_help());
    const CLI::App& command = *app_.get_subcommands().front();
    result_.command = command.get_name();
    for (const auto& [key, words] : result_.options) check_words_of(command, key, words);
    if (const Words rest = command.remaining(); !rest.empty()) {
      if (rest.front().size() > 1 && rest.front().starts_with('-'))
        throw Input_error("unknown option '" + rest.front() + "'" +
                          suggestion(rest.front().substr(0, rest.front().find('=')), names(command)) + "; " +
                          see_help());
      throw Input_error("'" + rest.front() + "' is not expected there; " + see_help());
    }
  }

  void check_words_of(const CLI::App& command, const std::string& key, const Words& words) const {
    if (words.size() > std::size_t(command.get_option(key)->get_items_expected_max()))
      fail_option(key, "it is given more than once", "give it once");
    for (const std::string& word : words) {
      if (word.starts_with('-') && command.get_option_no_throw(word))
        fail_option(key, "a value is missing before " + word, see_help());
      if (word.empty()) fail_option(key, "a value is empty", see_help());
    }
  }

  CLI::App app_;
  Command_line result_;
  std::string group_;
};

} // namespace

Command_line split_command_line(const std::vector<std::string>& arguments) { return Grammar().split(arguments); }

} // namespace equiaffine
