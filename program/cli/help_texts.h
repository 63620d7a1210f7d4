// SPDX-License-Identifier: GPL-3.0-or-later
// The texts above and below the list of options in the help. The first line of a command's description also appears in
// the help of the program.
#ifndef EQUIAFFINE_PROGRAM_CLI_HELP_TEXTS_H
#define EQUIAFFINE_PROGRAM_CLI_HELP_TEXTS_H

namespace equiaffine {

inline constexpr const char* program_description =
    R"(equiaffine - affine curvatures of implicit surfaces

Meshes the level sets f = V of a function f, which is a formula, a volume of samples, the distance to a mesh,
or a fit to the vertices of a mesh or to points, and computes the Euclidean and equi-affine differential
invariants at every vertex. Computes the same invariants at the vertices of a given mesh or at points.
Registers two surfaces by an affine map, and finds the affine symmetries of a surface.

Usage: equiaffine COMMAND [options]      equiaffine COMMAND --help      equiaffine --version
)";

inline constexpr const char* program_footer =
    R"(Example: equiaffine mesh --function "x^2 + y^2/4 + z^2 = 1" --box -3 3 -3 3 -3 3 -o out.ply --html out.html

Exit status: 0 for success; 2 for an error in the command line or an input, with one line on standard error that
says what to do; 1 for a defect of the program. Output files are written completely or not at all.)";

inline constexpr const char* mesh_description =
    R"(mesh a level set and compute the invariants at its vertices

Usage: equiaffine mesh SOURCE [options] -o OUT [--html PAGE.html] [--stats FILE.json]
)";

inline constexpr const char* mesh_footer =
    R"help(Examples:
  equiaffine mesh --function "(x^2+y^2+z^2+R^2-r^2)^2 = 4*R^2*(x^2+y^2)" --constants R=2 r=.5 \
      --box -3 3 -3 3 -1 1 --resolution 128 -o torus.ply --html torus.html
  equiaffine mesh --volume skull.nrrd --level 2.9 --orientation against -o skull.ply
  equiaffine mesh --fit bunny.off --scale 0.18 --attributes all -o bunny.ply \
      --html bunny.html --color mean_curvature --up y

All lengths are in the unit of the source. Scaling by s multiplies k1, k2 and mean_curvature by s^-1,
gaussian_curvature by s^-2, affine_gaussian_curvature by s^-3, affine_mean_curvature and pick_invariant by s^-1.5.
Undefined values are nan; the status of the vertex gives the reason.)help";

inline constexpr const char* evaluate_description =
    R"(compute the invariants at given points, each for the level set through it

Usage: equiaffine evaluate SOURCE --points IN.{csv,ply,off,xyz} -o OUT.{csv,ply} [options]
)";

inline constexpr const char* evaluate_footer =
    R"(The output has the rows and columns of the input, in the same order, and the new columns; a column of the same
name is replaced. A .ply keeps only numeric columns.

Examples:
  equiaffine evaluate --function "x*y*z" --points points.csv -o result.csv
  echo "x,y,z
  1,2,3" | equiaffine evaluate --function "x*y*z" --attributes normal,affine_mean_curvature --points - -o -)";

inline constexpr const char* sample_description =
    R"(write a function, a distance or a fit as a volume

Usage: equiaffine sample (--function EXPR | --distance-to MESH | --fit MESH) [options] -o VOLUME
)";

inline constexpr const char* sample_footer =
    R"(Example: equiaffine sample --distance-to bunny.off --resolution 129 --type float -o bunny.nrrd)";

inline constexpr const char* view_description =
    R"(make a web page or a picture from a mesh with attributes

Usage: equiaffine view MESH.ply [-o PAGE.html] [--png PICTURE.png] [options]
)";

inline constexpr const char* view_footer =
    R"(Examples:
  equiaffine view bunny.ply -o bunny.html --color mean_curvature
  equiaffine view blobby.ply --png blobby.png --color affine_mean_curvature --range -2 2 --arrows affine_normal)";

inline constexpr const char* annotate_description =
    R"(compute the invariants of the surface through the vertices of a mesh, or through points

Usage: equiaffine annotate MESH|POINTS -o OUT [options] [--html PAGE.html] [--stats FILE.json]
)";

inline constexpr const char* annotate_footer =
    R"(The vertices are treated as samples of a smooth surface, and polynomials are fitted around each of them. The
output has the vertices, faces and columns of the input, in the same order, and the new columns; a column of the
same name is replaced. The columns NAME_error estimate the errors; at a given scale they include noise and
sampling only.

Examples:
  equiaffine annotate scan.ply -o curvatures.ply --html curvatures.html
  equiaffine annotate points.xyz -o points.csv --scale 2.5)";

inline constexpr const char* register_description =
    R"(find the affine map that moves a surface, or part of it, onto another

Usage: equiaffine register SOURCE [its options] to SOURCE [its options] -o MAP.json [options]
)";

inline constexpr const char* register_footer =
    R"(The source before the word "to" is moved onto the one after it. Each pair of points with the same affine
invariants suggests a map. It is refined, and accepted only if it is unlikely to be a coincidence. If there is
no such map, MAP.json contains "found": false, and the exit status is 0. Options of a source, such as
--transform and --box, apply to the source on their side of the word "to".

Examples:
  equiaffine register part.ply to whole.ply -o map.json --moved moved.ply --html map.html
  equiaffine register --function "x^2+2*y^4+z^4+x*y*z=1" --box -2 2 -2 2 -2 2 to scan.nrrd --level 7 -o map.json)";

inline constexpr const char* symmetries_description =
    R"(find all maps that move a surface onto itself

Usage: equiaffine symmetries SOURCE -o MAPS.json [options]
)";

inline constexpr const char* symmetries_footer =
    R"(A surface with continuous symmetries, such as an ellipsoid or a surface of revolution, has infinitely many: in
this case MAPS.json contains generators, "order" is null, and "maps" contains only the identity. An ellipsoid
with three different axes has continuous affine symmetries, but only 8 rigid ones (--kind rigid).

Example: equiaffine symmetries --function "x^4+y^4+z^4=1" --box -2 2 -2 2 -2 2 -o maps.json)";

} // namespace equiaffine

#endif
