// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/parse_options.h"

#include "attributes/estimates.h"
#include "cli/Option_reader.h"
#include "cli/suggestions.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <utility>

namespace equiaffine {

namespace {

void read_delaunay_options(Option_reader& reader) {
  reader.refuse({"vertices"}, "it applies only to " + option_text("method", "marching-cubes"), "leave it out");
  if (reader.request().source.derivatives == Derivatives::JETS)
    reader.refuse({"resolution"}, option_text("method", "delaunay") + " uses no grid for a formula or a fit",
                  "leave it out, and set the size of triangles with " + option_text("radius"));
  reader.read({"angle", "radius", "distance"});
  check_options(reader.request().delaunay);
  reader.read({"sizing", "clip"});
}

void read_remesh_options(Option_reader& reader) {
  const Request& request = reader.request();
  if (request.source.kind != Source_kind::FIT || !reader.writes_files())
    fail_option("method", "remesh needs a fit to a mesh" + by_front_end("", " in a file"),
                by_front_end("add --fit FILE, or ", "") + "use marching-cubes or delaunay");
  const std::string remesh = option_text("method", "remesh"), reason = remesh + " uses no grid",
                    advice = "leave it out, or use " + option_text("method", "marching-cubes");
  reader.refuse({"resolution", "vertices"}, reason, advice);
  reader.refuse({"level", "box", "parabolic_curves"}, remesh + " moves the vertices of the whole mesh to the fit",
                advice);
  reader.read({"edge_length"});
  check_options(request.remesh);
}

/// Whether to remesh the faces of a fit, if it has any: if neither a method nor an option of other methods is given.
bool prefers_remesh(const Option_reader& reader) {
  constexpr std::array others = {"method", "level", "resolution", "vertices", "box", "parabolic_curves"};
  return reader.request().source.kind == Source_kind::FIT &&
         std::none_of(others.begin(), others.end(), [&](const char* option) { return reader.has(option); });
}

/// Reads `method` and the options that belong to it.
void read_method(Option_reader& reader) {
  reader.read({"method"});
  Request& request = reader.request();
  if (prefers_remesh(reader) && reader.has("edge_length")) request.method = Mesh_method::REMESH;
  const Mesh_method method = request.method;
  if (method != Mesh_method::DELAUNAY)
    reader.refuse({"angle", "radius", "distance", "sizing", "clip"},
                  "it applies only to " + option_text("method", "delaunay"), "add that or leave it out");
  if (method != Mesh_method::REMESH)
    reader.refuse({"edge_length"}, "it applies only to " + option_text("method", "remesh"), "add that or leave it out");
  if (method == Mesh_method::DELAUNAY) read_delaunay_options(reader);
  else if (method == Mesh_method::REMESH) read_remesh_options(reader);
  else reader.read({"vertices"});
}

bool has_vector(const Attribute_selection& attributes, const std::string& name) {
  return std::count_if(attributes.columns.begin(), attributes.columns.end(),
                       [&](const Attribute& column) { return attribute_table<double>[column.row].name == name; }) == 3;
}

bool has_column(const Request& request, const std::string& name) {
  const auto& columns = request.attributes.columns;
  return std::any_of(columns.begin(), columns.end(), [&](const Attribute& column) { return column.name == name; });
}

/// Whether the errors of a column are estimated.
bool has_column_with_error(const Request& request) {
  return std::any_of(rows_with_error.begin(), rows_with_error.end(),
                     [&](const auto* row) { return has_column(request, std::string(row->name)); });
}

bool has_color(const Request& request, const std::string& name) {
  const auto& estimates = request.estimates;
  return name == "plain" || (name == "status" && request.attributes.has_status) || has_column(request, name) ||
         std::find(estimates.begin(), estimates.end(), name) != estimates.end();
}

/// Checks that the attributes to show are computed, and that a page or picture is requested if they are given.
void check_page(const Option_reader& reader) {
  refuse_page_options(reader);
  const Request& request = reader.request();
  const std::string &arrows = request.display.arrows, &color = request.display.color;
  if (!arrows.empty() && !has_vector(request.attributes, arrows))
    fail_option("arrows", "the vector '" + arrows + "' is not computed",
                "name another one, such as affine_normal, or add it to " + option_text("attributes"));
  if (!color.empty() && !has_color(request, color))
    fail_option("color", "the attribute '" + color + "' is not computed",
                "name another one, such as affine_mean_curvature, or add it to " + option_text("attributes"));
}

/// Throws if the paper's scheme is used where a function is needed: its expansions do not belong to one function.
void check_scheme(const Request& request) {
  if (request.source.spline.spline_scheme != Spline_scheme::PAPER) return;
  if (request.method != Mesh_method::MARCHING_CUBES || request.marching_cubes.vertices != Vertex_position::LINEAR ||
      request.parabolic_curves)
    fail_option("spline_scheme", "paper works only with linear vertices of Marching Cubes, without parabolic curves",
                "add " + option_text("vertices", "linear") + ", or use convolution");
}

void read_mesh_options(Option_reader& reader) {
  read_source(reader);
  Request& request = reader.request();
  if (request.source.kind == Source_kind::FIT) request.estimates = error_attributes();
  reader.read({"level", "orientation"});
  request.source.spline.level = request.source.level;
  read_method(reader);
  reader.read({"attributes", "estimator"});
  request.source.estimates_errors = !request.estimates.empty();
  if (!reader.writes_files()) return reader.read_rest();
  need_output(reader);
  reader.read({"up"});
  refuse_picture_options(reader);
  reader.read_rest();
  check_page(reader);
  check_scheme(request);
  check_outputs(input_files(reader),
                {request.output, request.display.html, request.display.png, request.parabolic_curves, request.stats});
  request.delaunay.parabolic_curves = request.parabolic_curves.has_value();
  request.remeshes_faces = prefers_remesh(reader) && request.method == Mesh_method::MARCHING_CUBES;
  if (request.display.shows_something() && has_column_with_error(request)) request.source.estimates_errors = true;
  choose_up(request.source.kind, request.display);
}

void read_evaluate_options(Option_reader& reader) {
  read_source(reader);
  Request& request = reader.request();
  if (request.source.kind == Source_kind::FIT) request.estimates = error_attributes();
  reader.read_rest();
  request.source.estimates_errors = !request.estimates.empty();
  if (!reader.writes_files()) return;
  reader.need("points", "name the file with the points");
  need_output(reader);
  for (const char* option : {"distance_to", "fit"})
    if (reader.has(option) && request.source.text == "-" && request.points == "-")
      throw Input_error(option_text(option) + " and " + option_text("points") +
                        " both read standard input; name a file for one of them");
  check_outputs(input_files(reader), {request.output});
}

void read_sample_options(Option_reader& reader) {
  read_source(reader);
  reader.read_rest();
  need_output(reader);
  check_outputs(input_files(reader), {reader.request().output});
}

void read_view_options(Option_reader& reader) {
  if (!reader.has("MESH.ply")) throw Input_error("the mesh is missing; write 'equiaffine view MESH.ply -o PAGE.html'");
  check_is_viewable(reader.word("MESH.ply"));
  reader.read({"up"});
  refuse_picture_options(reader);
  reader.read_rest();
  Request& request = reader.request();
  if (reader.has("output")) request.display.html = request.output;
  else if (!request.display.png)
    throw Input_error("the output is missing; name a page, -o PAGE.html, or a picture, --png FILE.png");
  check_outputs(input_files(reader), {request.display.html, request.display.png});
}

void read_annotate_options(Option_reader& reader) {
  if (!reader.has("MESH")) throw Input_error("the mesh is missing; write 'equiaffine annotate MESH -o OUT.ply'");
  check_is_annotatable(reader.word("MESH"));
  Request& request = reader.request();
  request.estimates = error_attributes();
  reader.read({"scale", "noise", "degree", "feature_angle", "attributes"});
  if (!reader.writes_files()) return reader.read_rest();
  need_output(reader);
  reader.read({"up"});
  refuse_picture_options(reader);
  reader.read_rest();
  check_page(reader);
  check_outputs(input_files(reader), {request.output, request.display.html, request.display.png, request.stats});
}

} // namespace

Request read_options(const Command_line& line) {
  Option_reader reader(line);
  if (line.information) return reader.request();
  reader.read({"threads", "memory"});
  switch (line.command) {
  case MESH: read_mesh_options(reader); break;
  case EVALUATE: read_evaluate_options(reader); break;
  case SAMPLE: read_sample_options(reader); break;
  case VIEW: read_view_options(reader); break;
  case ANNOTATE: read_annotate_options(reader); break;
  case SYMMETRIES: read_symmetries_options(reader); break;
  case REGISTER: break; // read by the overload for two lines
  }
  return reader.request();
}

Request parse_options(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments.front() == "register") return parse_register_options(arguments);
  return read_options(split_command_line(arguments));
}

} // namespace equiaffine
