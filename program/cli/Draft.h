// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_DRAFT_H
#define EQUIAFFINE_PROGRAM_CLI_DRAFT_H

#include "request/options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// The ways to make a mesh.
enum class Mesh_method { MARCHING_CUBES, DELAUNAY, REMESH };

/// The values of the options of all commands; each command takes its part. The defaults that the structs of requests do
/// not have are here.
struct Draft {
  std::optional<std::size_t> threads, memory;
  Source_options source;
  double isovalue = 0;
  Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT;
  Mesh_method method = Mesh_method::MARCHING_CUBES;
  Marching_cubes_options marching_cubes;
  Remesh_options remesh;
  Delaunay_options delaunay;
  std::optional<std::size_t> largest;
  Attribute_selection attributes = select_attributes("basic");
  std::vector<std::string> estimates; ///< the columns of errors and of noise that are asked for
  Estimator estimator = Estimator::COMPACT;
  Display_options display;
  bool samples_are_float = false;
  Map_options maps;
  std::optional<std::size_t> number_of_maps;
  double least_overlap = 0.05;
  std::optional<double> tolerance;
  bool is_complete = false;
  std::string mesh, points; ///< the files that `view` and `annotate`, and that `evaluate` reads
  std::optional<std::string> output, moved, curves, stats;
};

/// Formulas and volumes have z up unless something else is asked for; the shapes of data tell what is up.
inline void choose_up(Source_kind kind, Display_options& display) {
  const bool is_data = kind == Source_kind::FIT || kind == Source_kind::DISTANCE;
  if (!is_data && !display.up) display.up = {0, 0, 1};
}

} // namespace equiaffine

#endif
