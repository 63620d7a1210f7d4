// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

namespace equiaffine {

namespace {

using enum Option_group;

void read_orientation(const Option_words& option, Request& request) {
  request.orientation =
      parse_choice(option, {Orientation_of_level_set::ALONG_GRADIENT, Orientation_of_level_set::AGAINST_GRADIENT});
}

void read_threads(const Option_words& option, Request& request) {
  constexpr std::size_t most = 1024; // a pool of this size can be created on any current computer
  request.threads = parse_count(option.name, option.word(), 1);
  if (*request.threads > most)
    fail_option(option.name, "'" + option.word() + "' is more than " + std::to_string(most),
                "give the number of processor cores, or leave it out to use all of them");
}

const std::string threads_help = "number of threads, by default all; the result does not depend on it";

const std::vector<Option_row> rows_of_surfaces = {
    {"--level,--isovalue", MESH | registering, SURFACE, 1, "V", "the level set f = V, by default 0",
     [](const Option_words& option, Request& request) { request.source.level = parse_number(option); }},
    {"--transform",
     MESH | EVALUATE | registering,
     SURFACE,
     {9, 12},
     "A11 A12 .. A33 [T1 T2 T3]",
     "replace the surface by its image under p -> A p + T; A is given row by row, T is 0 by default",
     [](const Option_words& option, Request& request) {
       request.source.transformation = parse_transformation(option);
     }},
    {"--derivatives", MESH | EVALUATE | registering, SURFACE, 1, "jets|spline",
     "origin of the derivatives: the formula or the fit itself (jets, their default), or a spline\n"
     "through samples on the grid (spline, always for volumes and distances, never for fits)",
     [](const Option_words& option, Request& request) {
       request.source.derivatives = parse_choice(option, {Derivatives::JETS, Derivatives::SPLINE});
     }},
    {"--spline-degree", MESH | EVALUATE | registering, SURFACE, 1, "5|7|9", "degree of the spline, by default 7",
     [](const Option_words& option, Request& request) {
       request.source.spline.spline_degree = parse_choice(option, {5, 7, 9});
     }},
    {"--spline-scheme", MESH | EVALUATE | registering, SURFACE, 1,
     "quasi-interpolation|interpolation|convolution|paper",
     "how to compute the spline: quasi-interpolation (default, a local filter) and interpolation\n"
     "(a recursive filter) have order degree + 1; convolution uses the samples as coefficients\n"
     "(order 2); paper is convolution of degree 5 at the nodes and linear between them, as in\n"
     "Andrade and Lewiner (with --vertices linear)",
     [](const Option_words& option, Request& request) {
       Volume_options& spline = request.source.spline;
       spline.spline_scheme = parse_choice(option, {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::INTERPOLATION,
                                                    Spline_scheme::CONVOLUTION, Spline_scheme::PAPER});
       if (spline.spline_scheme == Spline_scheme::PAPER) spline.spline_degree = 5;
     }},
    {"--smoothing", MESH | EVALUATE | registering, SURFACE, 1, "S|auto",
     "smooth the samples first: standard deviation of the weights in voxels, effective above 1;\n"
     "0 by default; auto chooses it from the noise in the samples",
     [](const Option_words& option, Request& request) {
       std::optional<double>& smoothing = request.source.spline.smoothing;
       if (option.word() == "auto") return smoothing.reset();
       smoothing = parse_number(option);
       constexpr double most = 100; // voxels
       if (!(*smoothing >= 0 && *smoothing <= most))
         fail_option(option.name, "'" + option.word() + "' is not between 0 and 100 voxels",
                     "use 0 for none, 1.5 to 8 for noise, or auto");
     }},
    {"--orientation", MESH | EVALUATE, SURFACE, 1, "gradient|against",
     "normals point toward larger f (gradient, the default) or smaller f (against)", read_orientation},
    {"--orientation", ANNOTATE, SURFACE, 1, "gradient|against",
     "normals agree with those of the data (gradient, the default) or are opposite (against)", read_orientation},
    {"--method", MESH, SAMPLING, 1, "marching-cubes|delaunay|remesh",
     "how to make the mesh: marching-cubes (default) on the edges of a grid; delaunay with good\n"
     "angles, certified to miss no component if the function has bounds; remesh (only for a fit\n"
     "to a mesh) to remesh the faces and move their vertices to the fit",
     [](const Option_words& option, Request& request) {
       request.method = parse_choice(option, {Mesh_method::MARCHING_CUBES, Mesh_method::DELAUNAY, Mesh_method::REMESH});
     }},
    {"--resolution",
     MESH | EVALUATE | SAMPLE | registering,
     SAMPLING,
     {1, 3},
     "N [NY NZ]",
     "nodes of the grid per axis, at least 2; by default 64, or 129 for a distance or a fit;\n"
     "a volume has its own grid",
     [](const Option_words& option, Request& request) { request.source.resolution = parse_resolution(option); }},
    {"--largest", MESH, SAMPLING, 1, "N", "keep the N connected components of largest area, by default all",
     [](const Option_words& option, Request& request) {
       request.largest = parse_count(option.name, option.word(), 1);
     }},
    {"--yes", MESH | EVALUATE | SAMPLE | registering, SAMPLING, 0, "",
     "allow the use of more than half of this computer's memory",
     [](const Option_words& option, Request& request) {
       request.source.memory_use = parse_flag(option) ? Memory_use::ALL : Memory_use::HALF;
     }},
    {"--threads", MESH | EVALUATE | SAMPLE | ANNOTATE, SAMPLING, 1, "N", threads_help, read_threads},
    {"--memory", MESH | EVALUATE | SAMPLE | ANNOTATE, SAMPLING, 1, "LIMIT",
     "limit of the memory in use, such as 700M or 2G (M is 2^20, G is 2^30 bytes); the rest is\n"
     "kept in a file beside the output; the result does not depend on it",
     [](const Option_words& option, Request& request) { request.memory = parse_bytes(option); }},
    {"--threads", registering, MAPS, 1, "N", threads_help, read_threads},
    {"--vertices", MESH, MARCHING_CUBES, 1, "projected|linear",
     "position of the vertices: on the surface (projected, the default), or at the zeros of linear\n"
     "interpolation along the edges of the grid (linear)",
     [](const Option_words& option, Request& request) {
       request.marching_cubes.vertices = parse_choice(option, {Vertex_position::PROJECTED, Vertex_position::LINEAR});
     }},
    {"--angle", MESH, DELAUNAY, 1, "DEG", "minimum angle of the triangles in degrees, at most and by default 30",
     [](const Option_words& option, Request& request) { request.delaunay.angle = parse_number(option); }},
    {"--radius", MESH, DELAUNAY, 1, "R",
     "maximum radius of a triangle's surface Delaunay ball, which passes through its corners and\n"
     "has its center on the surface; by default 1/50 of the diagonal of the box",
     [](const Option_words& option, Request& request) { request.delaunay.radius = parse_number(option); }},
    {"--distance", MESH, DELAUNAY, 1, "D",
     "maximum distance between the circumcenter of a triangle and the center of that ball, by\n"
     "default R/10",
     [](const Option_words& option, Request& request) { request.delaunay.distance = parse_number(option); }},
    {"--sizing", MESH, DELAUNAY, 1, "uniform|euclidean|affine",
     "size of the triangles: uniform (default); smaller where a radius of curvature is less than\n"
     "4 R (euclidean); or of equal affine area (affine)",
     [](const Option_words& option, Request& request) {
       request.delaunay.sizing =
           parse_choice(option, {Facet_sizing::UNIFORM, Facet_sizing::EUCLIDEAN, Facet_sizing::AFFINE});
     }},
    {"--clip", MESH, DELAUNAY, 1, "box|ball", "clip the surface by the box (default) or by the largest ball in it",
     [](const Option_words& option, Request& request) {
       request.delaunay.clip = parse_choice(option, {Clip_shape::BOX, Clip_shape::BALL});
     }},
    {"--edge-length", MESH, REMESH, 1, "L", "edge length of the triangles, by default the mean of the data",
     [](const Option_words& option, Request& request) { request.remesh.edge_length = parse_number(option); }},
};

} // namespace

std::span<const Option_row> surface_options() { return rows_of_surfaces; }

namespace {

const std::vector<Option_row> rows_of_maps = {
    {"--kind", registering, MAPS, 1, "affine|equiaffine|similarity|rigid",
     "the kind of maps: affine (default), equiaffine (keeps volumes), similarity (keeps angles)\n"
     "or rigid (keeps lengths)",
     [](const Option_words& option, Request& request) {
       request.registration.kind = request.symmetries.kind =
           parse_choice(option, {Map_kind::AFFINE, Map_kind::EQUIAFFINE, Map_kind::SIMILARITY, Map_kind::RIGID});
     }},
    {"--no-reflections,--no-reflection", registering, MAPS, 0, "", "exclude maps with negative determinant",
     [](const Option_words& option, Request& request) {
       request.registration.reflections = request.symmetries.reflections = !parse_flag(option);
     }},
    {"--number-of-maps,--all", REGISTER, MAPS, 1, "N",
     "write up to N maps with evidence, for example if the target is symmetric or has copies",
     [](const Option_words& option, Request& request) {
       request.registration.number_of_maps = parse_count(option.name, option.word(), 1);
       request.lists_maps = true;
     }},
    {"--min-overlap", REGISTER, MAPS, 1, "PART",
     "minimum fraction of one of the surfaces that lies on the other, by default 0.05",
     [](const Option_words& option, Request& request) {
       request.registration.min_overlap = parse_number(option);
       check_options(request.registration);
     }},
    {"--tolerance", registering, MAPS, 1, "PART",
     "maximum rms distance of moved points from the other surface, as a fraction of the size. By\n"
     "default, what noise and facets explain; for symmetries 1e-8 for a formula, and for a mesh\n"
     "the first group of symmetries within 0.01",
     [](const Option_words& option, Request& request) {
       request.registration.tolerance = request.symmetries.tolerance = parse_number(option);
       check_options(request.registration);
     }},
    {"--complete", SYMMETRIES, MAPS, 0, "",
     "search all rotations and reflections, as for a mesh, even if the curvature frames of a\n"
     "formula decide by themselves",
     [](const Option_words& option, Request& request) { request.symmetries.complete = parse_flag(option); }},
};

} // namespace

std::span<const Option_row> map_options() { return rows_of_maps; }

} // namespace equiaffine
