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

/// Reads a file whose kind its extension tells.
void read_file(const Option_words& option, Request& request) {
  read_source(is_volume(option.word()) ? Source_kind::VOLUME : Source_kind::FIT, option, request);
}

const std::vector<Option_row> rows_of_sources = {
    {"FILE", registering, SOURCE, 1, "",
     "vertices of a mesh or points, as with --fit, or a volume, as with --volume: the extension\n"
     "tells; - reads PLY, OFF or CSV from standard input",
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
           fail_option(option.name + " " + word, "the name has a value already", "give each name once");
     }},
    {"--distance-to", sampled, SOURCE, 1, "MESH",
     "the signed distance, negative inside, to a closed mesh: .off .ply .obj .stl; - reads\n"
     "OFF from standard input",
     [](const Option_words& option, Request& request) { read_source(Source_kind::DISTANCE, option, request); }},
    {"--narrow-band", sampled, SOURCE, 1, "N",
     "measure distances up to N voxels only, which is faster; 16 are enough without --smoothing",
     [](const Option_words& option, Request& request) {
       const double band = parse_number(option);
       if (!(band >= 1))
         fail_option(option.name, "'" + option.word() + "' is less than 1 voxel", "give some 16 voxels");
       request.source.narrow_band = band;
     }},
    {"--fit", sampled, SOURCE, 1, "MESH|POINTS",
     "polynomials fitted to the vertices of a mesh, .ply .off .obj .stl, or to points, .csv\n"
     ".xyz: a smooth function about as large as the distance, known near them only",
     [](const Option_words& option, Request& request) { read_source(Source_kind::FIT, option, request); }},
    {"--volume", MESH | EVALUATE | registering, SOURCE, 1, "FILE",
     "a volume of samples: .nrrd .nhdr .mhd .mha .nii .nii.gz .inr .inr.gz .vti .raw, a DICOM\n"
     "file with several frames, or a folder with a DICOM series",
     [](const Option_words& option, Request& request) { read_source(Source_kind::VOLUME, option, request); }},
    {"--component", MESH | EVALUATE | registering, SOURCE, 1, "N",
     "which number of a volume with several per node, such as a vector or a color, counted from 1",
     [](const Option_words& option, Request& request) {
       request.source.selection.component = parse_count(option.name, option.word(), 1);
     }},
    {"--time", MESH | EVALUATE | registering, SOURCE, 1, "N", "which volume of a 4D file, counted from 1",
     [](const Option_words& option, Request& request) {
       request.source.selection.time = parse_count(option.name, option.word(), 1);
     }},
    {"--allow-outside", MESH | EVALUATE | registering, SOURCE, 0, "",
     "read data that the header of a volume names outside of its own folder",
     [](const Option_words& option, Request& request) { request.source.selection.allow_outside = parse_flag(option); }},
    {"--dims", MESH | EVALUATE | registering, SOURCE, 3, "NX NY NZ",
     "nodes of a .raw, which has no header; x runs fastest",
     [](const Option_words& option, Request& request) {
       for (std::size_t a = 0; a < 3; ++a) raw_layout(request).dims[a] = parse_count(option.name, option.words[a], 2);
     }},
    {"--type", MESH | EVALUATE | registering, SOURCE, 1, "TYPE",
     "type of the samples of a .raw: uint8 int8 uint16 int16 uint32 int32 uint64 int64\n"
     "float double",
     [](const Option_words& option, Request& request) {
       raw_layout(request).type = parse_choice(option, Words(raw_types.begin(), raw_types.end()));
     }},
    {"--spacing", MESH | EVALUATE | registering, SOURCE, 3, "DX DY DZ",
     "steps between the nodes of a .raw, by default 1 1 1",
     [](const Option_words& option, Request& request) { raw_layout(request).spacing = parse_triple(option); }},
    {"--origin", MESH | EVALUATE | registering, SOURCE, 3, "X Y Z",
     "place of the first node of a .raw, by default 0 0 0",
     [](const Option_words& option, Request& request) { raw_layout(request).origin = parse_triple(option); }},
    {"--box", sampled, BOX, 6, "XMIN XMAX YMIN YMAX ZMIN ZMAX",
     "where a formula is looked at, before --transform; for a distance or a fit the box of\n"
     "the mesh, widened on all sides by 10 % of its longest side, if not given",
     [](const Option_words& option, Request& request) { request.source.box = parse_box(option); }},
    {"--points", EVALUATE, SOURCE, 1, "IN",
     "the points: .csv with a header that names x, y, z; .ply; .off; .obj; .stl; .xyz; - reads\n"
     "one of the first three from standard input",
     [](const Option_words& option, Request& request) { request.points = option.word(); }},
    {"MESH.ply", VIEW, INPUT, 1, "", "a mesh as this program writes it, or any other .ply; - reads standard input",
     [](const Option_words& option, Request& request) { request.input = option.word(); }},
    {"MESH", ANNOTATE, INPUT, 1, "",
     "a mesh, .ply .off .obj .stl, or points, .csv .xyz or a file without faces; columns nx,\n"
     "ny, nz of points are their normals; - reads PLY, OFF or CSV from standard input",
     [](const Option_words& option, Request& request) { request.input = option.word(); }},
    {"--scale", fitting, FIT, 1, "R|auto|none",
     "the length that tells shape from detail: curvatures are those of polynomials fitted within\n"
     "about R. By default (auto) they are the surface's own where the data resolve them, else\n"
     "those at the smallest scale at which half of the vertices are known to 20 %, up to an eighth\n"
     "of the size; none insists on the surface's own",
     [](const Option_words& option, Request& request) {
       if (option.word() == "auto") return;
       request.source.fit.scale = option.word() == "none" ? 0 : parse_number(option);
       if (option.word() != "none" && !(*request.source.fit.scale > 0))
         fail_option(option.name, "'" + option.word() + "' is not a length", "give a length above 0, auto or none");
     }},
    {"--noise", fitting, FIT, 1, "S|auto",
     "the standard deviation of the points from the surface, a length; estimated (auto) by\n"
     "default",
     [](const Option_words& option, Request& request) {
       if (option.word() == "auto") return;
       request.source.fit.noise = parse_number(option);
       check_options(request.source.fit);
     }},
    {"--degree", fitting, FIT, 1, "4|5|6|8|10|auto",
     "the degree of the polynomials that are fitted, by default chosen by the data (auto)",
     [](const Option_words& option, Request& request) {
       request.source.fit.degree = parse_choice<std::optional<int>>(option, {4, 5, 6, 8, 10, std::nullopt});
     }},
    {"--feature-angle", fitting, FIT, 1, "DEG",
     "edges of a mesh that bend by more than this angle, by default 60, are creases if they follow\n"
     "each other: polynomials do not reach over them, and a remesh keeps them; 180 for none",
     [](const Option_words& option, Request& request) {
       request.source.fit.feature_angle = parse_number(option);
       check_options(request.source.fit);
     }},
};

} // namespace

std::span<const Option_row> source_options() { return rows_of_sources; }

} // namespace equiaffine
