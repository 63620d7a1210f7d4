// SPDX-License-Identifier: GPL-3.0-or-later
// The facts about surfaces and fits that the program reports, as JSON and as a summary.
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

/// The result of a method's search for all components of a surface.
struct Completeness {
  bool is_certified = false;
  std::vector<CGAL::Bbox_3> undecided_boxes;
};

/// The facts about the data of a fit that were remeshed and moved onto it.
struct Remesh_statistics : Fit_remesh_report {
  std::array<double, 2> distances_from_data{}; ///< the greatest ones of vertices on the fit, and of the others
};

/// The facts about a mesh, however it was made.
struct Mesh_facts {
  std::string source;
  std::size_t vertices = 0, faces = 0;
  Mesh_topology topology;
  std::size_t components_left_out = 0;
  std::array<std::size_t, number_of_point_statuses> status{};
};

/// The facts that the program reports about a mesh of a level set.
struct Statistics : Mesh_facts {
  double isovalue = 0;
  double max_distance_to_surface =
      0; ///< in the unit of the coordinates, of vertices that are not UNCONVERGED; NaN if f is defined at none
  double sample_seconds = 0, project_seconds = 0, annotate_seconds = 0, write_seconds = 0;
  std::size_t function_evaluations = 0;
  std::optional<Completeness> completeness; ///< is set by methods that look for all components
  std::optional<Spline_statistics> spline;  ///< is set if derivatives are those of a spline
  std::optional<Fit_statistics> fit;        ///< is set if derivatives are those of a fit
  std::optional<Close_sheets> close_sheets; ///< is set if Marching Cubes sampled a fit
  std::optional<Remesh_statistics> remesh;  ///< is set if the data of a fit were remeshed
};

/// The facts that the program reports about a fit to the vertices of a mesh, or to points.
struct Annotation_statistics : Mesh_facts {
  Fit_statistics fit;
  bool has_colors = false; ///< instead of normals, as the numbers in columns without names tell
  double annotate_seconds = 0, write_seconds = 0;
};

std::array<std::size_t, number_of_point_statuses> count(std::span<const Point_status> status);

/// "K 64 / 89, H 54 / 81, ...": at how many percent of the points each of `affine_quantities` is known to 20 % and to
/// 50 %, and of what these are parts.
std::string table_of_known(const Fit_statistics& fit);

/// One object, see the section on statistics of doc/program.md. A distance that is not a finite number is null.
std::string to_JSON(const Statistics& statistics);

/// One object, see the section on statistics of doc/program.md. A number that does not exist is null.
std::string to_JSON(const Annotation_statistics& statistics);

/// Returns ", 3 smaller ones left out" if components were, or nothing.
std::string left_out_text(const Mesh_facts& facts);

/// Says the most important statistics in a few lines.
std::string summary(const Statistics& statistics);
std::string summary(const Annotation_statistics& statistics);

} // namespace equiaffine

#endif
