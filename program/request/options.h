// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H
#define EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H

#include "request/source_options.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/registration/Map_kind.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace equiaffine {

/// The page and the picture that are asked for, and their first view.
struct Display_options {
  std::optional<std::string> html, png;
  std::string color;                             ///< an attribute, `status`, `plain`, or empty
  std::optional<std::array<double, 3>> up;       ///< guessed from the shape if there is none
  std::optional<std::array<double, 2>> range;    ///< the numbers that have the end colors
  std::optional<std::string> range_of;           ///< a page or mesh whose colors numbers get
  std::optional<Color_scale> scale;              ///< of colors, if it is not to be the one that suits the numbers
  std::array<std::size_t, 2> size = {1000, 800}; ///< of the picture, in pixels
  std::string arrows;                            ///< a vector among the attributes, or empty; for the picture

  bool shows_something() const { return html || png; }
};

struct Marching_cubes_options {
  Vertex_position vertices = Vertex_position::PROJECTED;
};

struct Delaunay_options {
  double angle = 30;               ///< the least angle of triangles, in degrees
  double radius = 0, distance = 0; ///< as in Delaunay_criteria; 0 stands for the default
  Facet_sizing sizing = Facet_sizing::UNIFORM;
  bool clips_to_ball = false; ///< whether the surface is cut off at the largest ball in the box, not at the box
};

/// The faces of the data of a fit, remeshed, whose vertices are moved onto the fit.
struct Remesh_options {
  std::optional<double> edge_length; ///< of the remesh; the mean one of the data if there is none
};

struct Mesh_options {
  Source_options source;
  double isovalue = 0;
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  std::variant<Marching_cubes_options, Delaunay_options, Remesh_options> method;
  std::optional<std::size_t> largest; ///< so many connected components of the greatest areas are kept, or all
  bool remeshes_faces = false; ///< whether the faces of a fit that form a surface are remeshed without the `method`
  Attribute_selection attributes;
  std::vector<std::string> estimates; ///< the columns of errors and of noise that the mesh gets
  Estimator estimator = Estimator::COMPACT;
  std::string output;
  std::optional<std::string> curves, stats;
  Display_options display;
};

struct Evaluate_options {
  Source_options source;
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  Attribute_selection attributes;
  std::vector<std::string> estimates; ///< the columns of errors and of noise that are written
  Estimator estimator = Estimator::COMPACT;
  std::string points, output;
};

struct Sample_options {
  Source_options source;
  bool as_float = false;
  std::string output;
};

struct View_options {
  std::string mesh;
  Display_options display; ///< asks for a page, a picture or both
};

struct Annotate_options {
  std::string mesh; ///< the path of a mesh or of points
  Fit_options fit;
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  Attribute_selection attributes;
  std::vector<std::string> estimates; ///< the columns of errors and of noise that are written
  std::string output;
  std::optional<std::string> stats;
  Display_options display;
};

/// A level set among whose points maps are sought.
struct Surface_options {
  Source_options source;
  double isovalue = 0;
};

/// The maps among which one is sought.
struct Map_options {
  Map_kind kind = Map_kind::AFFINE;
  bool allows_reflections = true;
};

struct Register_options {
  Surface_options source, target;
  Map_options maps;
  std::optional<std::size_t> number_of_maps; ///< if all maps were asked for, up to this number
  double least_overlap = 0.05;               ///< a part of a surface
  std::optional<double> tolerance;           ///< a part of the size of the target; if there is none, the data decide
  std::string output;
  std::optional<std::string> moved;
  Display_options display;
};

struct Symmetries_options {
  Surface_options surface;
  Map_options maps;
  std::optional<double> tolerance; ///< a part of the size of the surface; if there is none, the source decides
  bool is_complete = false;        ///< whether all rotations are to be searched
  std::string output;
  Display_options display;
};

/// A text that was asked for: help or version.
struct Information {
  std::string text;
};

struct Options {
  std::variant<Information, Mesh_options, Evaluate_options, Sample_options, View_options, Annotate_options,
               Register_options, Symmetries_options>
      command;
  std::optional<std::size_t> threads;
  std::optional<std::size_t> memory; ///< the bytes that may be resident
};

} // namespace equiaffine

#endif
