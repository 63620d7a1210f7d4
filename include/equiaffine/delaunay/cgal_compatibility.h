// SPDX-License-Identifier: GPL-3.0-or-later
// Everything in which the use of CGAL's mesher differs between CGAL 5 and CGAL 6.
#ifndef EQUIAFFINE_DELAUNAY_CGAL_COMPATIBILITY_H
#define EQUIAFFINE_DELAUNAY_CGAL_COMPATIBILITY_H

#include <CGAL/refine_mesh_3.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <optional>
#else
#include <boost/optional.hpp>
#endif

namespace equiaffine::internal {

#if CGAL_VERSION_NR >= 1060000000
template <class T>
using Cgal_optional = std::optional<T>;
#else
template <class T>
using Cgal_optional = boost::optional<T>;
#endif

enum class Manifoldness { ANY, MANIFOLD, MANIFOLD_WITH_BOUNDARY };

/// Refines the facets, and nothing else, from the points that are in the triangulation.
template <class C3t3, class Domain, class Criteria>
void refine_facets(C3t3& c3t3, const Domain& domain, const Criteria& criteria, Manifoldness manifoldness) {
  namespace parameters = CGAL::parameters;
  const auto refine = [&](auto topology) {
#if CGAL_VERSION_NR >= 1060000000
    CGAL::refine_mesh_3(c3t3, domain, criteria, topology.no_perturb().no_exude().surface_only());
#else
    CGAL::refine_mesh_3(c3t3, domain, criteria, parameters::no_reset_c3t3(), parameters::no_perturb(),
                        parameters::no_exude(), topology);
#endif
  };
  if (manifoldness == Manifoldness::ANY) refine(parameters::non_manifold());
  else if (manifoldness == Manifoldness::MANIFOLD) refine(parameters::manifold());
  else refine(parameters::manifold_with_boundary());
}

} // namespace equiaffine::internal

#endif
