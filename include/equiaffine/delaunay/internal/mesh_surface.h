// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_MESH_SURFACE_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_MESH_SURFACE_H

#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <vector>

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The arguments of `delaunay_surface`, apart from the function.
struct Meshing_request_3 {
  Clip_domain_3 domain;
  Delaunay_criteria criteria; ///< all lengths are positive
  Facet_sizing sizing;
  std::vector<Polyline_3<Any_function_3::Kernel>> feature_curves;
  bool has_parabolic_features; ///< the parabolic curves become features in a second mesh
};

/// The work of `delaunay_surface`, which does not depend on the type of the function. The library defines it.
Delaunay_surface_3<Any_function_3::Kernel> mesh_surface(const Any_function_3& function,
                                                        const Meshing_request_3& request);

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
