// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/parse_options.h"

#include "attributes/estimates.h"
#include "cli/Option_reader.h"
#include "cli/suggestions.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <utility>

namespace equiaffine {

namespace {

void read_delaunay_options(Option_reader& reader) {
  reader.refuse({"--vertices"}, "it is for --method marching-cubes", "leave it out");
  if (reader.draft().source.derivatives == Derivatives::JETS)
    reader.refuse({"--resolution"}, "--method delaunay needs no grid for a formula or a fit",
                  "leave it out and say with --radius how fine the mesh is to be");
  reader.read({"--angle", "--radius", "--distance"});
  const double angle = reader.draft().delaunay.angle;
  if (!(angle >= 0 && angle <= 30))
    fail_option("--angle", "'" + reader.word("--angle") + "' is not between 0 and 30 degrees",
                "give a smaller one: with more than 30 the refinement need not end");
  reader.read({"--sizing", "--clip"});
}

void read_remesh_options(Option_reader& reader) {
  const Draft& draft = reader.draft();
  if (draft.source.kind != Source_kind::FIT)
    fail_option("--method", "remesh is for a fit to a mesh", "add --fit FILE, or use marching-cubes or delaunay");
  const std::string reason = "--method remesh has no grid", advice = "leave it out, or use --method marching-cubes";
  reader.refuse({"--resolution", "--vertices"}, reason, advice);
  reader.refuse({"--isovalue", "--box", "--parabolic-curves"},
                "--method remesh moves the vertices of the whole mesh to the fit", advice);
  reader.read({"--edge-length"});
}

/// Whether the faces of a fit, if there are any, are to be remeshed: without a method, or an option that is for others.
bool prefers_remesh(const Option_reader& reader) {
  constexpr std::array others = {"--method", "--isovalue", "--resolution", "--vertices", "--box", "--parabolic-curves"};
  return reader.draft().source.kind == Source_kind::FIT &&
         std::none_of(others.begin(), others.end(), [&](const char* option) { return reader.has(option); });
}

/// Reads `--method` and the options that belong to it.
void read_method(Option_reader& reader) {
  reader.read({"--method"});
  Draft& draft = reader.draft();
  if (prefers_remesh(reader) && reader.has("--edge-length")) draft.method = Mesh_method::REMESH;
  const Mesh_method method = draft.method;
  if (method != Mesh_method::DELAUNAY)
    reader.refuse({"--angle", "--radius", "--distance", "--sizing", "--clip"}, "it is for --method delaunay",
                  "add --method delaunay or leave it out");
  if (method != Mesh_method::REMESH)
    reader.refuse({"--edge-length"}, "it is for --method remesh", "add --method remesh or leave it out");
  if (method == Mesh_method::DELAUNAY) read_delaunay_options(reader);
  else if (method == Mesh_method::REMESH) read_remesh_options(reader);
  else reader.read({"--vertices"});
}

bool has_vector(const Attribute_selection& attributes, const std::string& name) {
  return std::count_if(attributes.columns.begin(), attributes.columns.end(),
                       [&](const Attribute& column) { return attribute_table<double>[column.row].name == name; }) == 3;
}

bool has_column(const Draft& draft, const std::string& name) {
  const auto& columns = draft.attributes.columns;
  return std::any_of(columns.begin(), columns.end(), [&](const Attribute& column) { return column.name == name; });
}

/// Whether there is a column whose errors are estimated.
bool has_column_with_error(const Draft& draft) {
  return std::any_of(error_table<double>.begin(), error_table<double>.end(),
                     [&](const auto& row) { return has_column(draft, std::string(row.attribute)); });
}

bool has_color(const Draft& draft, const std::string& name) {
  const auto& estimates = draft.estimates;
  return name == "plain" || (name == "status" && draft.attributes.has_status) || has_column(draft, name) ||
         std::find(estimates.begin(), estimates.end(), name) != estimates.end();
}

/// Checks that there is a page or picture, and that it will have the attributes it is to show.
void check_page(const Option_reader& reader) {
  refuse_page_options(reader);
  const Draft& draft = reader.draft();
  const std::string &arrows = draft.display.arrows, &color = draft.display.color;
  if (!arrows.empty() && !has_vector(draft.attributes, arrows))
    fail_option("--arrows", "'" + arrows + "' is not among the vectors that are computed",
                "name one of them, such as affine_normal, or add it to --attributes");
  if (!color.empty() && !has_color(draft, color))
    fail_option("--color", "'" + color + "' is not among the attributes that are computed",
                "name one of them, such as affine_mean_curvature, or add it to --attributes");
}

/// Throws if the paper's scheme is used in a way that needs a function, since its expansions are not those of one.
void check_scheme(const Draft& draft) {
  if (draft.source.spline.spline_scheme != Spline_scheme::PAPER) return;
  if (draft.method != Mesh_method::MARCHING_CUBES || draft.marching_cubes.vertices != Vertex_position::LINEAR ||
      draft.curves)
    fail_option("--spline-scheme", "paper is for Marching Cubes with linear vertices and without parabolic curves",
                "add --vertices linear, or use convolution");
}

Mesh_options read_mesh_options(Option_reader& reader) {
  read_source(reader);
  if (reader.draft().source.kind == Source_kind::FIT) reader.draft().estimates = error_attributes();
  reader.read({"--isovalue", "--orientation"});
  read_method(reader);
  reader.read({"--attributes", "--estimator"});
  need_output(reader);
  reader.read({"--up"});
  refuse_picture_options(reader);
  reader.read_rest();
  check_page(reader);
  Draft& draft = reader.draft();
  check_scheme(draft);
  check_outputs(input_files(reader), {draft.output, draft.display.html, draft.display.png, draft.curves, draft.stats});

  Mesh_options options;
  options.source = std::move(draft.source);
  options.source.spline.level = draft.isovalue;
  options.isovalue = draft.isovalue;
  options.orientation = draft.orientation;
  if (draft.method == Mesh_method::DELAUNAY) options.method = draft.delaunay;
  else if (draft.method == Mesh_method::REMESH) options.method = draft.remesh;
  else options.method = draft.marching_cubes;
  options.largest = draft.largest;
  options.remeshes_faces = prefers_remesh(reader) && draft.method == Mesh_method::MARCHING_CUBES;
  options.source.estimates_errors =
      !draft.estimates.empty() || (draft.display.shows_something() && has_column_with_error(draft));
  options.estimates = std::move(draft.estimates);
  options.attributes = std::move(draft.attributes);
  options.estimator = draft.estimator;
  options.output = *draft.output;
  options.curves = draft.curves;
  options.stats = draft.stats;
  options.display = draft.display;
  choose_up(options.source.kind, options.display);
  return options;
}

Evaluate_options read_evaluate_options(Option_reader& reader) {
  read_source(reader);
  if (reader.draft().source.kind == Source_kind::FIT) reader.draft().estimates = error_attributes();
  reader.read_rest();
  reader.need("--points", "name the file with the points");
  need_output(reader);
  Draft& draft = reader.draft();
  for (const char* option : {"--distance-to", "--fit"})
    if (reader.has(option) && draft.source.text == "-" && draft.points == "-")
      throw Input_error(option + std::string(" and --points both read standard input; name a file for one of them"));
  check_outputs(input_files(reader), {draft.output});
  draft.source.estimates_errors = !draft.estimates.empty();
  return {draft.source,    draft.orientation, draft.attributes, draft.estimates,
          draft.estimator, draft.points,      *draft.output};
}

Sample_options read_sample_options(Option_reader& reader) {
  read_source(reader);
  reader.read_rest();
  need_output(reader);
  const Draft& draft = reader.draft();
  check_outputs(input_files(reader), {draft.output});
  return {draft.source, draft.samples_are_float, *draft.output};
}

View_options read_view_options(Option_reader& reader) {
  if (!reader.has("MESH.ply")) throw Input_error("no mesh is given; write 'equiaffine view MESH.ply -o PAGE.html'");
  check_is_viewable(reader.word("MESH.ply"));
  reader.read({"--up"});
  refuse_picture_options(reader);
  reader.read_rest();
  const Draft& draft = reader.draft();
  if (!draft.output && !draft.display.png)
    throw Input_error("no output is given; name the page, -o PAGE.html, or the picture, --png FILE.png");
  check_outputs(input_files(reader), {draft.output, draft.display.png});
  View_options options{draft.mesh, draft.display};
  options.display.html = draft.output;
  return options;
}

Annotate_options read_annotate_options(Option_reader& reader) {
  if (!reader.has("MESH")) throw Input_error("no mesh is given; write 'equiaffine annotate MESH -o OUT.ply'");
  check_is_annotatable(reader.word("MESH"));
  reader.draft().estimates = error_attributes();
  reader.read({"--scale", "--noise", "--degree", "--feature-angle", "--attributes"});
  need_output(reader);
  reader.read({"--up"});
  refuse_picture_options(reader);
  reader.read_rest();
  check_page(reader);
  const Draft& draft = reader.draft();
  check_outputs(input_files(reader), {draft.output, draft.display.html, draft.display.png, draft.stats});
  return {draft.mesh,      draft.source.fit, draft.orientation, draft.attributes,
          draft.estimates, *draft.output,    draft.stats,       draft.display};
}

} // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments.front() == "register") return parse_register_options(arguments);
  const Command_line line = split_command_line(arguments);
  if (line.information) return {Information{*line.information}, {}, {}};
  Option_reader reader(line);
  reader.read({"--threads", "--memory"});
  Options options;
  switch (line.command) {
  case MESH: options.command = read_mesh_options(reader); break;
  case EVALUATE: options.command = read_evaluate_options(reader); break;
  case SAMPLE: options.command = read_sample_options(reader); break;
  case VIEW: options.command = read_view_options(reader); break;
  case ANNOTATE: options.command = read_annotate_options(reader); break;
  case SYMMETRIES: options.command = read_symmetries_options(reader); break;
  case REGISTER: break; // has a line for each source
  }
  options.threads = reader.draft().threads;
  options.memory = reader.draft().memory;
  return options;
}

} // namespace equiaffine
