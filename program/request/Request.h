// SPDX-License-Identifier: GPL-3.0-or-later
// The request of a command line: a command and the values of all options.
#ifndef EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H
#define EQUIAFFINE_PROGRAM_REQUEST_OPTIONS_H

#include "request/source_options.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/display/Display_options.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/registration/Registration_options.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// The requested page and picture, and what they show.
struct Display_request : Display_options {
  std::optional<std::string> html, png;
  std::optional<std::string> range_of; ///< a page or mesh with the color scale to use
  bool guesses_up = true;              ///< whether `up` is guessed from the shape

  bool shows_something() const { return html || png; }
};

/// The commands of the program, as bits.
enum Command : unsigned { MESH = 1, EVALUATE = 2, SAMPLE = 4, VIEW = 8, ANNOTATE = 16, REGISTER = 32, SYMMETRIES = 64 };

/// The ways to make a mesh.
enum class Mesh_method { MARCHING_CUBES, DELAUNAY, REMESH };

/// A command, and the options of all commands; each command uses some of them.
struct Request {
  Command command = MESH;
  std::optional<std::string> information;     ///< help or the version, if requested instead
  std::optional<std::size_t> threads, memory; ///< memory: the maximum number of resident bytes
  Source_options source, target;              ///< `register` has a target
  std::string input;                          ///< the file that `view` or `annotate` reads
  std::string points;                         ///< the file with the points of `evaluate`
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  Mesh_method method = Mesh_method::MARCHING_CUBES;
  Marching_cubes_options marching_cubes; ///< except the resolution, which is that of the source
  Delaunay_options delaunay;
  Remesh_options remesh;
  std::optional<std::size_t> largest; ///< the number of connected components to keep, those of largest area
  bool remeshes_faces = false;        ///< whether the faces of a fit are remeshed by default if they form a surface
  Attribute_selection attributes = select_attributes("basic");
  std::vector<std::string> estimates; ///< the columns of estimates to write, such as errors and noise
  Estimator estimator = Estimator::COMPACT;
  Registration_options registration; ///< except the fits, which are those of the sources
  Symmetry_options symmetries;       ///< except the fit
  bool lists_maps = false;           ///< whether `register` writes all maps, not only the best one
  bool samples_are_float = false;
  std::string output;
  std::optional<std::string> moved, parabolic_curves, stats;
  Display_request display;
};

} // namespace equiaffine

#endif
