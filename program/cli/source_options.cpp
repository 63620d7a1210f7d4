// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"
#include "cli/option_values.h"
#include "volume/volume_io.h"

#include <optional>

namespace equiaffine {

namespace {

using enum Option_group;

void read_source(Source_kind kind, const Option_words& option, Request& request) {
  request.source.kind = kind;
  request.source.text = option.word();
}

Raw_layout& raw_layout(Request& request) {
  if (!request.source.raw) request.source.raw.emplace();
  return *request.source.raw;
}

constexpr Commands sampled = MESH | EVALUATE | SAMPLE | registering, fitting = sampled | ANNOTATE;

/// Reads a file; its extension determines the kind of the source.
void read_file(const Option_words& option, Request& request) {
  read_source(is_volume(option.word()) ? Source_kind::VOLUME : Source_kind::FIT, option, request);
}

const std::vector<Option_row> rows_of_sources = {
    {"FILE", registering, SOURCE, 1, "",
     "a mesh or points, as with --fit, or a volume, as with --volume, depending on the extension;\n"
     "- reads PLY, OFF or CSV from standard input",
     read_file},
    {"--function", sampled, SOURCE, 1, "EXPR",
     "a formula in x, y, z: + - * / ^ ( ) pi e sqrt cbrt exp log sin cos tan\n"
     "asin acos atan atan2 sinh cosh tanh abs min max hypot erf floor sign fmod pow;\n"
     "lhs = rhs means lhs - rhs; @FILE reads it from a file",
     [](const Option_words& option, Request& request) {
       read_source(Source_kind::FUNCTION, option, request);
       if (const auto file = formula_file(option.word())) request.source.text = read_formula(*file);
     }},
    {"--constants,--set",
     sampled,
     SOURCE,
     {1, unlimited},
     "NAME=VALUE ...",
     "constants of the formula: numbers, or arithmetic such as 2*pi/3",
     [](const Option_words& option, Request& request) {
       for (const std::string& word : option.words)
         if (!request.source.constants.insert(parse_constant(option.name, word)).second)
           fail_option(option.name + " " + word, "the name already has a value", "give each name once");
     }},
    {"--distance-to", sampled, SOURCE, 1, "MESH",
     "the signed distance (negative inside) to a closed mesh, .off .ply .obj .stl; - reads OFF\n"
     "from standard input",
     [](const Option_words& option, Request& request) { read_source(Source_kind::DISTANCE, option, request); }},
    {"--narrow-band", sampled, SOURCE, 1, "N",
     "compute distances only up to N voxels, which is faster; 16 suffice without --smoothing",
     [](const Option_words& option, Request& request) {
       const double band = parse_number(option);
       if (!(band >= 1))
         fail_option(option.name, "'" + option.word() + "' is less than 1 voxel", "give about 16 voxels");
       request.source.narrow_band = band;
     }},
    {"--fit", sampled, SOURCE, 1, "MESH|POINTS",
     "polynomials fitted to the vertices of a mesh, .ply .off .obj .stl, or to points, .csv\n"
     ".xyz; they approximate the signed distance, and are defined only near the data",
     [](const Option_words& option, Request& request) { read_source(Source_kind::FIT, option, request); }},
    {"--volume", MESH | EVALUATE | registering, SOURCE, 1, "FILE",
     "a volume of samples: .nrrd .nhdr .mhd .mha .nii .nii.gz .inr .inr.gz .vti .raw, a\n"
     "multi-frame DICOM file, or a folder with a DICOM series",
     [](const Option_words& option, Request& request) { read_source(Source_kind::VOLUME, option, request); }},
    {"--component", MESH | EVALUATE | registering, SOURCE, 1, "N",
     "component to use if nodes have several values, such as vectors or colors, counted from 1",
     [](const Option_words& option, Request& request) {
       request.source.selection.component = parse_count(option.name, option.word(), 1);
     }},
    {"--time", MESH | EVALUATE | registering, SOURCE, 1, "N", "volume of a 4D file to use, counted from 1",
     [](const Option_words& option, Request& request) {
       request.source.selection.time = parse_count(option.name, option.word(), 1);
     }},
    {"--allow-outside", MESH | EVALUATE | registering, SOURCE, 0, "",
     "allow the header of a volume to name data files outside of its folder",
     [](const Option_words& option, Request& request) { request.source.selection.allow_outside = parse_flag(option); }},
    {"--dims", MESH | EVALUATE | registering, SOURCE, 3, "NX NY NZ",
     "number of nodes of a .raw file, which has no header; x runs fastest",
     [](const Option_words& option, Request& request) {
       for (std::size_t a = 0; a < 3; ++a) raw_layout(request).dims[a] = parse_count(option.name, option.words[a], 2);
     }},
    {"--type", MESH | EVALUATE | registering, SOURCE, 1, "TYPE",
     "type of the samples of a .raw file: uint8 int8 uint16 int16 uint32 int32 uint64 int64\n"
     "float double",
     [](const Option_words& option, Request& request) {
       raw_layout(request).type = parse_choice(option, Words(raw_types.begin(), raw_types.end()));
     }},
    {"--spacing", MESH | EVALUATE | registering, SOURCE, 3, "DX DY DZ",
     "distances between the nodes of a .raw file, by default 1 1 1",
     [](const Option_words& option, Request& request) { raw_layout(request).spacing = parse_triple(option); }},
    {"--origin", MESH | EVALUATE | registering, SOURCE, 3, "X Y Z",
     "position of the first node of a .raw file, by default 0 0 0",
     [](const Option_words& option, Request& request) { raw_layout(request).origin = parse_triple(option); }},
    {"--box", sampled, BOX, 6, "XMIN XMAX YMIN YMAX ZMIN ZMAX",
     "region of the function, before --transform; required to sample a formula. By default, for a\n"
     "distance or a fit, the box of the data, enlarged on all sides by 10 % of its longest side",
     [](const Option_words& option, Request& request) { request.source.box = parse_box(option); }},
    {"--points", EVALUATE, SOURCE, 1, "IN",
     "the points: .csv with a header that names x, y, z; .ply; .off; .obj; .stl; .xyz; - reads\n"
     "CSV, PLY or OFF from standard input",
     [](const Option_words& option, Request& request) { request.points = option.word(); }},
    {"MESH.ply", VIEW, INPUT, 1, "", "a mesh of this program or any other .ply; - reads standard input",
     [](const Option_words& option, Request& request) { request.input = option.word(); }},
    {"MESH", ANNOTATE, INPUT, 1, "",
     "a mesh, .ply .off .obj .stl, or points, .csv .xyz or a mesh file without faces; columns nx,\n"
     "ny, nz of points are their normals; - reads PLY, OFF or CSV from standard input",
     [](const Option_words& option, Request& request) { request.input = option.word(); }},
    {"--scale", fitting, FIT, 1, "R|auto|none",
     "length below which detail is smoothed: polynomials are fitted within about R. By default\n"
     "(auto), curvatures of the surface itself if the data resolve them, otherwise at the smallest\n"
     "scale at which half of the vertices have errors below 20 %, up to 1/8 of the size; with none,\n"
     "always those of the surface itself",
     [](const Option_words& option, Request& request) {
       if (option.word() == "auto") return;
       request.source.fit.scale = option.word() == "none" ? 0 : parse_number(option);
       if (option.word() != "none" && !(*request.source.fit.scale > 0))
         fail_option(option.name, "'" + option.word() + "' is not a length", "give a positive length, auto or none");
     }},
    {"--noise", fitting, FIT, 1, "S|auto",
     "standard deviation of the points from the surface, a length; by default estimated (auto)",
     [](const Option_words& option, Request& request) {
       if (option.word() == "auto") return;
       request.source.fit.noise = parse_number(option);
       check_options(request.source.fit);
     }},
    {"--degree", fitting, FIT, 1, "4|5|6|8|10|auto",
     "degree of the fitted polynomials, by default chosen from the data (auto)",
     [](const Option_words& option, Request& request) {
       request.source.fit.degree = parse_choice<std::optional<int>>(option, {4, 5, 6, 8, 10, std::nullopt});
     }},
    {"--feature-angle", fitting, FIT, 1, "DEG",
     "connected edges where a mesh bends by more than this angle, by default 60 degrees, are\n"
     "creases: fits do not cross them, and a remesh preserves them; 180 for no creases",
     [](const Option_words& option, Request& request) {
       request.source.fit.feature_angle = parse_number(option);
       check_options(request.source.fit);
     }},
};

} // namespace

std::span<const Option_row> source_options() { return rows_of_sources; }

} // namespace equiaffine
