// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of surfaces and fits, as JSON and as a summary.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_STATISTICS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_STATISTICS_H

#include "source/source.h"
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/fit/Close_sheets.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// The result of a search for all components of a surface.
struct Completeness {
  bool is_certified = false;
  std::vector<CGAL::Bbox_3> undecided_boxes;
};

/// Statistics of a remesh of the data of a fit.
struct Remesh_statistics : Fit_remesh_report {
  std::array<double, 2> distances_from_data{}; ///< maximum for vertices on the fit, and for the others
};

/// Facts about any mesh.
struct Mesh_facts {
  std::string source;
  std::size_t vertices = 0, faces = 0;
  Mesh_topology topology;
  std::size_t components_left_out = 0;
  std::array<std::size_t, number_of_point_statuses> status{};
};

/// Statistics of a mesh of a level set.
struct Statistics : Mesh_facts {
  double isovalue = 0;
  double max_distance_to_surface = 0; ///< of vertices that are not UNCONVERGED; NaN if f is defined at none of them
  double sample_seconds = 0, project_seconds = 0, annotate_seconds = 0, write_seconds = 0;
  std::size_t function_evaluations = 0;
  std::optional<Completeness> completeness; ///< for methods that search for all components
  std::optional<Spline_statistics> spline;  ///< if derivatives are those of a spline
  std::optional<Fit_statistics> fit;        ///< if derivatives are those of a fit
  std::optional<Close_sheets> close_sheets; ///< if Marching Cubes sampled a fit
  std::optional<Remesh_statistics> remesh;  ///< if the data of a fit were remeshed
};

/// Statistics of a fit to the vertices of a mesh, or to points.
struct Annotation_statistics : Mesh_facts {
  Fit_statistics fit;
  bool has_colors = false; ///< whether unnamed columns are colors, not normals
  double annotate_seconds = 0, write_seconds = 0;
};

std::array<std::size_t, number_of_point_statuses> count(std::span<const Point_status> status);

/// "K 64 / 89, H 54 / 81, ...": for each of `affine_quantities` the percentages of points with errors below 20 % and
/// 50 %, and the reference magnitudes of the errors.
std::string table_of_errors(const Fit_statistics& fit);

/// One object, see the section on statistics of doc/program.md. A distance that is not a finite number is null.
std::string to_JSON(const Statistics& statistics);

/// One object, see the section on statistics of doc/program.md. A number that does not exist is null.
std::string to_JSON(const Annotation_statistics& statistics);

/// ", 3 smaller ones left out", or empty if no components were left out.
std::string left_out_text(const Mesh_facts& facts);

/// The most important statistics in a few lines.
std::string summary(const Statistics& statistics);
std::string summary(const Annotation_statistics& statistics);

} // namespace equiaffine

#endif
