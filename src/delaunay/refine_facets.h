// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_REFINE_FACETS_H
#define EQUIAFFINE_SRC_DELAUNAY_REFINE_FACETS_H

#include "delaunay/Surface_complex.h"

#include <CGAL/refine_mesh_3.h>
#include <CGAL/version.h>

#include <string>

/// Before CGAL's mesher throws an assertion, it writes the triangulation to files in the current folder, unless this
/// class does nothing.
template <>
struct CGAL::Dump_c3t3<equiaffine::internal::Surface_complex, true> {
  void dump_c3t3(const equiaffine::internal::Surface_complex&, const std::string&, bool = false) const {}
};

namespace equiaffine::internal {

/// The topology that the facets must have.
enum class Manifoldness { ANY, MANIFOLD, MANIFOLD_WITH_BOUNDARY };

/// Refines the facets, and nothing else, from the points that are in the triangulation. The calls of CGAL 5, 6.0 and 6.1
/// differ.
template <class C3t3, class Domain, class Criteria>
void refine_facets(C3t3& c3t3, const Domain& domain, const Criteria& criteria, Manifoldness manifoldness) {
  namespace parameters = CGAL::parameters;
  const auto refine = [&](auto topology) {
#if CGAL_VERSION_NR >= 1060000000
    const auto options = topology.no_perturb().no_exude();
    if constexpr (requires { options.surface_only(); }) {
      CGAL::refine_mesh_3(c3t3, domain, criteria, options.surface_only());
    } else {
      CGAL::refine_mesh_3(c3t3, domain, criteria, options);
    }
#else
    CGAL::refine_mesh_3(c3t3, domain, criteria, parameters::no_reset_c3t3(), parameters::no_perturb(),
                        parameters::no_exude(), topology);
#endif
  };
  switch (manifoldness) {
  case Manifoldness::ANY: return refine(parameters::non_manifold());
  case Manifoldness::MANIFOLD: return refine(parameters::manifold());
  case Manifoldness::MANIFOLD_WITH_BOUNDARY: return refine(parameters::manifold_with_boundary());
  }
}

} // namespace equiaffine::internal

#endif
