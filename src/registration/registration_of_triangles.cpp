// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Shape_matches.h"
#include "registration/pieces/register_pieces.h"
#include "registration/registration_of_wholes.h"
#include "registration/samples/mesh_samples.h"
#include "registration/wholes/Centered_surface_3.h"
#include "registration/wholes/register_wholes.h"
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/registration/internal/searches.h>

#include <utility>

namespace equiaffine::internal {

Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_request& request) {
  check_argument(!source.triangles.empty(), "a mesh to be registered has no faces: give faces of the source");
  check_argument(!target.triangles.empty(), "a mesh to register with has no faces: give faces of the target");
  Centered_surface_3 from = centered_surface(source, request.kind), to = centered_surface(target, request.kind);
  // Facets of solids with corners are their faces, and explain no distance.
  const bool are_solids = has_group_of_corners(in_threads, source, coordinate_rounding(source.points)) &&
                          has_group_of_corners(in_threads, target, coordinate_rounding(target.points));
  if (are_solids) from.samples.facet_error = to.samples.facet_error = 0;
  Shape_matches wholes = register_wholes(in_threads, from, to, request);
  wholes.slippage = slippage_of_triangles(in_threads, source, request.kind);
  if (!wholes.maps.empty()) return to_CGAL(std::move(wholes), request);
  Shape_matches pieces = register_pieces(in_threads, source, target, request, are_solids);
  pieces.hypotheses += wholes.hypotheses;
  pieces.slippage = std::move(wholes.slippage);
  return to_CGAL(std::move(pieces), request);
}

} // namespace equiaffine::internal
