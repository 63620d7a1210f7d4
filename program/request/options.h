// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H
#define EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H

#include "request/source_options.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/registration/Registration_options.h>

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

struct Mesh_options {
  Source_options source;
  double isovalue = 0;
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  std::variant<Marching_cubes_options, Delaunay_options, Remesh_options> method; ///< the resolution is the source's
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

struct Register_options {
  Surface_options source, target;    ///< each with a fit of its own
  Registration_options registration; ///< but its fit
  bool lists_maps = false;           ///< whether all maps that are found are written, and not the best one alone
  std::string output;
  std::optional<std::string> moved;
  Display_options display;
};

struct Symmetries_options {
  Surface_options surface;
  Symmetry_options symmetries; ///< but its fit
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
