// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the surface of a source with its attributes, for every command that writes or shows a surface.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_MAKE_SURFACE_H
#define EQUIAFFINE_PROGRAM_COMMANDS_MAKE_SURFACE_H

#include "attributes/estimates.h"
#include "output/statistics.h"
#include "request/Request.h"
#include "source/source.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// A surface with its attributes.
struct Annotated_surface {
  Isosurface_3<Kernel> mesh;
  Vertex_attributes attributes;
  Estimates estimates;
  std::optional<Close_sheets> close_sheets;
  std::array<std::size_t, number_of_point_statuses> status{};
  std::optional<Completeness> completeness;
  double max_distance = 0, annotation_seconds = 0;
  std::optional<Parabolic_curves_3<Kernel>> curves; ///< if requested
  std::vector<double> outcomes;                     ///< of vertices of a remesh
  std::size_t components_left_out = 0;              ///< smaller ones, if only the largest were requested
  std::optional<Remesh_statistics> remesh;
  std::string reason_against_remesh; ///< why the faces could not be remeshed by default
};

/// A surface with the source that it was made from.
struct Made_surface {
  Source source;
  Annotated_surface surface;
  double source_seconds;
};

/// Whether attributes are computed with the surface, or later by for_each_attribute_block().
enum class Attribute_time { WITH_SURFACE, LATER };

/// Makes the surface. If the scale of a fit is chosen from the data, the source may be a fit at a smaller scale; see
/// the method `remesh` in doc/program.md.
Made_surface make_surface(const Request& options, Progress& progress,
                          Attribute_time time = Attribute_time::WITH_SURFACE);

/// Computes distances from the surface and the selected attributes for consecutive blocks of vertices, and counts the
/// status. Calls visit(first, attributes) with the number of the first vertex of each block.
void for_each_attribute_block(const Source& source, const Request& options, Annotated_surface& surface,
                              std::size_t vertices_of_block,
                              const std::function<void(std::size_t, Vertex_attributes&&)>& visit);

/// Throws `Input_error` if the grid of a surface needs more memory than allowed.
void check_memory(const Request& options);

/// Writes warnings about the surface.
void warn_of(const Annotated_surface& surface, const Source& source, const Request& options, Progress& progress);

/// Makes a surface of an existing source.
Annotated_surface surface_of(const Source& source, const Request& options, Progress& progress);

/// The data of a fit, remeshed and moved onto it.
struct Remeshed_fit {
  Isosurface_3<Kernel> mesh;    ///< vertices off the fit are UNCONVERGED
  std::vector<double> outcomes; ///< the number of the Fit_outcome of each vertex
  Remesh_statistics statistics;
};

/// Remeshes the data of a fit as remesh_by_fit() does. If that chooses a smaller scale, `source` becomes the fit at
/// that scale. Throws `Input_error` if the data have no faces, or if these do not form a mesh.
Remeshed_fit remesh_fit(Source& source, const Source_options& options, const Remesh_options& how, Progress& progress);

} // namespace equiaffine

#endif
