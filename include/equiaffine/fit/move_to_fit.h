// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_MOVE_TO_FIT_H
#define EQUIAFFINE_FIT_MOVE_TO_FIT_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/internal/motion_to_fit.h>
#include <equiaffine/function/internal/explain_misuse.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/crossing_triangles.h>

#include <CGAL/tags.h>

namespace equiaffine {

/// Moves the vertices of a triangle mesh onto the zero set of a fit to it, or to a surface near it, as far as that
/// leaves the mesh whole: no triangle turns by more than 60 degrees, and none crosses another one that it did not cross
/// before. Triangles stay what they are, so that closed meshes stay closed and borders stay borders.
///
/// A vertex moves along the gradient of the fit, by 1.25 times the mean length of its edges at most, or the
/// distance of the data if that is more. It does not where the fit has no derivatives or no zero near enough, faces
/// another way, or is that of another sheet. Such vertices follow their neighbors, less with every edge from the fit.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points of the fit's kernel |
/// | `vertex_outcome_map` | writable property map | none | from vertices to Fit_outcome |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// Takes some 30 microseconds per vertex, and n log n time for the search of crossings,
/// again for each of the rounds in which vertices stay, which are at most some 20 + log n. CGAL::Parallel_tag gives the
/// same numbers.
/// \throw std::invalid_argument if a face is not a triangle, or a coordinate is not finite.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, class Kernel,
          internal::Parameter_chain... Parameters>
Fit_move_report move_to_fit(Mesh& mesh, const Fitted_function_traits_3<Kernel>& fit, const Parameters&... given) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                             internal::Vertex_outcome_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  const auto parameters = internal::joined_parameters(given...);
  const auto array = internal::triangle_array_of(mesh, parameters);
  const auto motion = internal::motion_to_fit<ConcurrencyTag>(
      array, fit, internal::crossing_triangles(array.points(), array.triangles()));
  return internal::apply_motion<Kernel>(mesh, motion, parameters);
}

/// \cond
// A call that is mistaken, see explain_misuse.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, class Kernel, class... Others>
void move_to_fit(Mesh&, const Fitted_function_traits_3<Kernel>&,
                 const Others&...) requires(!(internal::Parameter_chain<Others> && ...)) {
  internal::explain_parameters<Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
