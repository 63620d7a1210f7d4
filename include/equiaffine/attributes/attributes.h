// SPDX-License-Identifier: GPL-3.0-or-later
// The local structure at points of level sets, as structures or as columns of numbers by name.
#ifndef EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H
#define EQUIAFFINE_ATTRIBUTES_ATTRIBUTES_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/internal/compute_columns.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/tags.h>

#include <span>
#include <type_traits>

namespace equiaffine {

/// Returns the local structure of the level set of f through p. `sampled_status` is the status that a sampler gave p: a
/// point that is UNCONVERGED stays so, with the numbers that exist, unless it is OUTSIDE.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `estimator` | Estimator | COMPACT | how the affine structure is computed |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Local_structure_3<typename Traits::FT> local_structure_at(const Traits& traits, const typename Traits::Point_3& p,
                                                          Point_status sampled_status = Point_status::REGULAR,
                                                          const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_parameters<Joined, internal::Estimator_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  auto structure = internal::structure_by<Joined, typename Traits::FT>(
      internal::joined_parameters(given...), traits.taylor(p), {p.x(), p.y(), p.z()}, equiaffine::rounding(traits, p));
  structure.status = status_after_sampling(structure.status, sampled_status);
  return structure;
}

/// Computes the selected attributes of points, one column of doubles per scalar. This takes one Taylor expansion of
/// order 4 per point, and one of order 5, or up to 40 more of order 4, if the norm of a gradient is selected. CGAL::Sequential_tag and
/// CGAL::Parallel_tag give the same numbers, bit for bit. Points are computed in packs, and the numbers are those of
/// local_structure_at: bit for bit if the compiler rounds each product and each sum (-ffp-contract=off), else to within
/// rounding.
///
/// `sampled_status` is empty or has one entry per point, as in local_structure_at.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `estimator` | Estimator | COMPACT | how the affine structure is computed |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Vertex_attributes compute_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                     const Attribute_selection& selection,
                                     std::span<const Point_status> sampled_status = {}, const Parameters&... given) {
  static_assert(std::is_same_v<typename Traits::FT, double>);
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Estimator_tag,
                             internal::Geom_traits_tag, internal::Verbose_tag>();
  return internal::compute_columns<ConcurrencyTag>(traits, points, selection, sampled_status,
                                                   internal::joined_parameters(given...));
}

} // namespace equiaffine

#endif
