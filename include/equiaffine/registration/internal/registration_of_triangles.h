// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_TRIANGLES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTRATION_OF_TRIANGLES_H

#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/registration/internal/Shape_matches.h>
#include <equiaffine/registration/internal/declared_searches.h>
#include <equiaffine/registration/internal/pieces/register_pieces.h>
#include <equiaffine/registration/internal/pieces/slippage_of_triangles.h>
#include <equiaffine/registration/internal/registration_of_wholes.h>
#include <equiaffine/registration/internal/samples/mesh_samples.h>
#include <equiaffine/registration/internal/wholes/Centered_surface_3.h>
#include <equiaffine/registration/internal/wholes/register_wholes.h>

#include <utility>

namespace equiaffine::internal {

template <class ConcurrencyTag>
Surface_registration_3<Kernel_of_searches>
registration_of_triangles(const Triangles_3& source, const Triangles_3& target, const Registration_request& request) {
  check_argument(!source.triangles.empty(), "a mesh to be registered has no faces: give faces of the source");
  check_argument(!target.triangles.empty(), "a mesh to register with has no faces: give faces of the target");
  Centered_surface_3 from = centered_surface(source, request.kind), to = centered_surface(target, request.kind);
  // Facets of solids with corners are their faces, and explain no distance.
  const bool are_solids = has_group_of_corners<ConcurrencyTag>(source, coordinate_rounding(source.points)) &&
                          has_group_of_corners<ConcurrencyTag>(target, coordinate_rounding(target.points));
  if (are_solids) from.samples.facet_error = to.samples.facet_error = 0;
  Shape_matches wholes = register_wholes<ConcurrencyTag>(from, to, request);
  wholes.slippage = slippage_of_triangles<ConcurrencyTag>(source, request.kind);
  if (!wholes.maps.empty()) return to_CGAL(std::move(wholes), request);
  Shape_matches pieces = register_pieces<ConcurrencyTag>(source, target, request, are_solids);
  pieces.hypotheses += wholes.hypotheses;
  pieces.slippage = std::move(wholes.slippage);
  return to_CGAL(std::move(pieces), request);
}

} // namespace equiaffine::internal

#endif
