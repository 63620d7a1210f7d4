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
  constexpr std::size_t most = 1024; // any computer of today can run a pool of so many threads
  request.threads = parse_count(option.name, option.word(), 1);
  if (*request.threads > most)
    fail_option(option.name, "'" + option.word() + "' is more than " + std::to_string(most),
                "give the number of processor cores, or leave it out to use all of them");
}

const std::string threads_help = "threads to use, all by default; the result is always the same";

const std::vector<Option_row> rows_of_surfaces = {
    {"--level,--isovalue", MESH | registering, SURFACE, 1, "V", "the level set f = V, by default 0",
     [](const Option_words& option, Request& request) { request.source.level = parse_number(option); }},
    {"--transform",
     MESH | EVALUATE | registering,
     SURFACE,
     {9, 12},
     "A11 A12 .. A33 [T1 T2 T3]",
     "take the image of the surface under p -> A p + T, A given row by row; T is 0 if not given",
     [](const Option_words& option, Request& request) {
       request.source.transformation = parse_transformation(option);
     }},
    {"--derivatives", MESH | EVALUATE | registering, SURFACE, 1, "jets|spline",
     "from the formula or the fit (jets, their default), or from a spline through samples\n"
     "on the grid (spline, the only way for volumes and distances, none for fits)",
     [](const Option_words& option, Request& request) {
       request.source.derivatives = parse_choice(option, {Derivatives::JETS, Derivatives::SPLINE});
     }},
    {"--spline-degree", MESH | EVALUATE | registering, SURFACE, 1, "5|7|9", "the degree of that spline, by default 7",
     [](const Option_words& option, Request& request) {
       request.source.spline.spline_degree = parse_choice(option, {5, 7, 9});
     }},
    {"--spline-scheme", MESH | EVALUATE | registering, SURFACE, 1,
     "quasi-interpolation|interpolation|convolution|paper",
     "how samples become a spline: by a local filter (quasi-interpolation, the default) or a\n"
     "recursive one (interpolation), both of order degree + 1; with the samples as\n"
     "coefficients (convolution, order 2); or this in degree 5 at the nodes, linearly between\n"
     "them, as Andrade and Lewiner do (paper, with --vertices linear)",
     [](const Option_words& option, Request& request) {
       Volume_options& spline = request.source.spline;
       spline.spline_scheme = parse_choice(option, {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::INTERPOLATION,
                                                    Spline_scheme::CONVOLUTION, Spline_scheme::PAPER});
       if (spline.spline_scheme == Spline_scheme::PAPER) spline.spline_degree = 5;
     }},
    {"--smoothing", MESH | EVALUATE | registering, SURFACE, 1, "S|auto",
     "smooth the samples first: the standard deviation of the weights in voxels, more than 1\n"
     "to have an effect, 0 by default, or what suits the noise in the samples (auto)",
     [](const Option_words& option, Request& request) {
       std::optional<double>& smoothing = request.source.spline.smoothing;
       if (option.word() == "auto") return smoothing.reset();
       smoothing = parse_number(option);
       constexpr double most = 100; // voxels
       if (!(*smoothing >= 0 && *smoothing <= most))
         fail_option(option.name, "'" + option.word() + "' is not between 0 and 100 voxels",
                     "use 0 for none, some 1.5 to 8 for noise, or auto");
     }},
    {"--orientation", MESH | EVALUATE, SURFACE, 1, "gradient|against",
     "normals towards larger f (gradient, the default) or smaller f (against)", read_orientation},
    {"--orientation", ANNOTATE, SURFACE, 1, "gradient|against",
     "normals as those of the data (gradient, the default), or the opposite ones (against)", read_orientation},
    {"--method", MESH, SAMPLING, 1, "marching-cubes|delaunay|remesh",
     "a mesh on the edges of a grid (marching-cubes, the default), one of triangles with good\n"
     "angles that is proved to be complete where the function has bounds (delaunay), or the\n"
     "faces of a mesh, remeshed, with their vertices moved to the fit, closed if they are\n"
     "(remesh, for a fit only)",
     [](const Option_words& option, Request& request) {
       request.method = parse_choice(option, {Mesh_method::MARCHING_CUBES, Mesh_method::DELAUNAY, Mesh_method::REMESH});
     }},
    {"--resolution",
     MESH | EVALUATE | SAMPLE | registering,
     SAMPLING,
     {1, 3},
     "N [NY NZ]",
     "nodes of the grid per axis, 2 or more: 64, for a distance or fit 129; a volume has its own",
     [](const Option_words& option, Request& request) { request.source.resolution = parse_resolution(option); }},
    {"--largest", MESH, SAMPLING, 1, "N", "keep the N connected components of the greatest areas, all by default",
     [](const Option_words& option, Request& request) {
       request.largest = parse_count(option.name, option.word(), 1);
     }},
    {"--yes", MESH | EVALUATE | SAMPLE | registering, SAMPLING, 0, "",
     "agree to use more than half of the memory of this computer",
     [](const Option_words& option, Request& request) {
       request.source.memory_use = parse_flag(option) ? Memory_use::ALL : Memory_use::HALF;
     }},
    {"--threads", MESH | EVALUATE | SAMPLE | ANNOTATE, SAMPLING, 1, "N", threads_help, read_threads},
    {"--memory", MESH | EVALUATE | SAMPLE | ANNOTATE, SAMPLING, 1, "LIMIT",
     "memory to have in use at once, such as 700M or 2G (2^20 and 2^30 bytes); what does not\n"
     "fit is kept in a file beside the output; the result is always the same",
     [](const Option_words& option, Request& request) { request.memory = parse_bytes(option); }},
    {"--threads", registering, MAPS, 1, "N", threads_help, read_threads},
    {"--vertices", MESH, MARCHING_CUBES, 1, "projected|linear",
     "on the surface (projected, the default), or where linear interpolation along the\n"
     "grid edges finds it (linear)",
     [](const Option_words& option, Request& request) {
       request.marching_cubes.vertices = parse_choice(option, {Vertex_position::PROJECTED, Vertex_position::LINEAR});
     }},
    {"--angle", MESH, DELAUNAY, 1, "DEG", "the least angle of triangles, at most 30, the default",
     [](const Option_words& option, Request& request) { request.delaunay.angle = parse_number(option); }},
    {"--radius", MESH, DELAUNAY, 1, "R",
     "the greatest radius of a ball about a point of the surface through the corners of a\n"
     "triangle, by default 1/50 of the diagonal of the box",
     [](const Option_words& option, Request& request) { request.delaunay.radius = parse_number(option); }},
    {"--distance", MESH, DELAUNAY, 1, "D",
     "the greatest distance of a triangle's circumcenter from the center of that ball, by\n"
     "default R/10",
     [](const Option_words& option, Request& request) { request.delaunay.distance = parse_number(option); }},
    {"--sizing", MESH, DELAUNAY, 1, "uniform|euclidean|affine",
     "triangles of one size (uniform, the default), smaller ones where a radius of curvature\n"
     "is less than 4 R (euclidean), or such of equal affine area (affine)",
     [](const Option_words& option, Request& request) {
       request.delaunay.sizing =
           parse_choice(option, {Facet_sizing::UNIFORM, Facet_sizing::EUCLIDEAN, Facet_sizing::AFFINE});
     }},
    {"--clip", MESH, DELAUNAY, 1, "box|ball",
     "cut the surface off at the box (the default) or at the largest ball in it",
     [](const Option_words& option, Request& request) {
       request.delaunay.clip = parse_choice(option, {Clip_shape::BOX, Clip_shape::BALL});
     }},
    {"--edge-length", MESH, REMESH, 1, "L", "of the triangles, by default the mean of the data",
     [](const Option_words& option, Request& request) { request.remesh.edge_length = parse_number(option); }},
};

} // namespace

std::span<const Option_row> surface_options() { return rows_of_surfaces; }

namespace {

const std::vector<Option_row> rows_of_maps = {
    {"--kind", registering, MAPS, 1, "affine|equiaffine|similarity|rigid",
     "the maps that are sought: all (affine, the default), those that keep volumes,\n"
     "those that keep angles, or those that keep lengths",
     [](const Option_words& option, Request& request) {
       request.registration.kind = request.symmetries.kind =
           parse_choice(option, {Map_kind::AFFINE, Map_kind::EQUIAFFINE, Map_kind::SIMILARITY, Map_kind::RIGID});
     }},
    {"--no-reflections,--no-reflection", registering, MAPS, 0, "", "no map that turns left into right",
     [](const Option_words& option, Request& request) {
       request.registration.reflections = request.symmetries.reflections = !parse_flag(option);
     }},
    {"--number-of-maps,--all", REGISTER, MAPS, 1, "N",
     "all maps with evidence, up to N, as those of a symmetric target or of copies",
     [](const Option_words& option, Request& request) {
       request.registration.number_of_maps = parse_count(option.name, option.word(), 1);
       request.lists_maps = true;
     }},
    {"--min-overlap", REGISTER, MAPS, 1, "PART",
     "the part of one of the surfaces, at least, that is to lie on the other, by default 0.05",
     [](const Option_words& option, Request& request) {
       request.registration.min_overlap = parse_number(option);
       check_options(request.registration);
     }},
    {"--tolerance", registering, MAPS, 1, "PART",
     "the largest rms distance to which a map may move points from the other surface, a part of\n"
     "the size; by default what noise and facets explain. A symmetry of a formula moves them by\n"
     "1e-8, and a mesh has the first group of symmetries within 0.01",
     [](const Option_words& option, Request& request) {
       request.registration.tolerance = request.symmetries.tolerance = parse_number(option);
       check_options(request.registration);
     }},
    {"--complete", SYMMETRIES, MAPS, 0, "",
     "search all rotations and reflections, as for a mesh, where a formula's frames of\n"
     "curvature decide by themselves",
     [](const Option_words& option, Request& request) { request.symmetries.complete = parse_flag(option); }},
};

} // namespace

std::span<const Option_row> map_options() { return rows_of_maps; }

} // namespace equiaffine
