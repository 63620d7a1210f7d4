// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_REMESH_ON_FIT_H
#define EQUIAFFINE_FIT_REMESH_ON_FIT_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/internal/motion_to_fit.h>
#include <equiaffine/fit/internal/remesh_of_mesh.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>

#include <CGAL/tags.h>

namespace equiaffine {

/// Remeshes a triangle mesh by CGAL's isotropic remeshing, and moves its vertices onto the zero set of a fit to it, see
/// move_to_fit(). The mesh stays whole: it has the same components, border loops and Euler characteristic, and its
/// triangles cross each other only within an edge of places where some of those given did. The remesh is within a tenth
/// of an edge of the given mesh, and the given mesh of the remesh, at vertices and centers of triangles: where detail is
/// finer than the edges, the given ones are kept, or parts of them. No vertex moves farther from there to the fit than
/// half of the edges at it, or half of the spacing of the data if that is larger. If edges of the length that was asked
/// for do not allow that, shorter ones are tried, down to a quarter of the given ones, and then the given triangles. A
/// length beyond the diagonal of the mesh counts as that diagonal. Vertices in no triangle are removed. A mesh with a
/// triangle that is a line or a point keeps all its triangles.
///
/// Edges that are constrained, or sharper than the feature angle, stay where they are: a fit that does not end there
/// makes them round. Vertices beside them go to the fit only if that is within a fifth of an edge. Sharp edges count
/// where they follow each other as creases do, see fitted_structures().
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `target_edge_length` | `std::optional<double>` | the mean of those given | a length |
/// | `number_of_iterations` | `unsigned` | 3 | rounds of splits, collapses, flips and relaxation |
/// | `feature_angle` | `std::optional<double>` | 60 | angle of edges that are kept, in degrees; `std::nullopt`: none |
/// | `edge_is_constrained_map` | writable property map | none | from edges to bool: those that are kept |
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points of the fit's kernel |
/// | `vertex_outcome_map` | writable property map | none | from vertices of the result to Fit_outcome |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// `edge_is_constrained_map` says of the edges of the result, too, whether they are kept. Takes n log n time, some 0.1
/// ms per vertex, for each of the lengths that are tried, and as much again up to seven times where edges are kept. CGAL::Parallel_tag gives the same numbers.
/// \throw std::invalid_argument if a face is not a triangle, a coordinate is not finite, a parameter makes no sense, or
/// there would be more than 10^8 triangles, or more than 10^4 parts of an edge. The mesh is as it was then.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, class Kernel,
          internal::Parameter_chain... Parameters>
Fit_remesh_report remesh_on_fit(Mesh& mesh, const Fitted_function_traits_3<Kernel>& fit, const Parameters&... given) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                             internal::Vertex_outcome_tag, internal::Target_edge_length_tag,
                             internal::Number_of_iterations_tag, internal::Edge_is_constrained_tag,
                             internal::Feature_angle_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  const auto np = internal::joined_parameters(given...);
  const internal::Remesh_request request = internal::remesh_request(np);
  const internal::Triangle_array_3 data = internal::triangle_array_of(mesh, np);
  internal::Whole_remesh_3<Kernel> remesh(internal::copy_to_remesh<Kernel>(mesh, np), request, ConcurrencyTag());
  const auto motion =
      internal::motion_to_fit<ConcurrencyTag>(remesh.array(), fit, remesh.crossings(), remesh.features());
  auto& moved = remesh.mesh();
  using Vertex = typename internal::Whole_remesh_3<Kernel>::Mesh::Vertex_index;
  const auto outcomes = moved.template add_property_map<Vertex, Fit_outcome>("v:equiaffine_outcome").first;
  const auto report = internal::apply_motion<Kernel>(moved, motion, parameters::vertex_outcome_map(outcomes));
  internal::replace_by_remesh<Kernel>(mesh, remesh, outcomes, np);
  const auto [from_data, of_data] =
      internal::Deviation_3(data).greatest<ConcurrencyTag>({motion.points(), remesh.array().triangles()});
  return {report, remesh.edge_length(), from_data, of_data};
}

} // namespace equiaffine

#endif
