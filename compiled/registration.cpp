// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/registration/internal/declared_searches.h>
#include <equiaffine/registration/internal/pieces/contradictions_of_triangles.h>
#include <equiaffine/registration/internal/pieces/slippage_of_triangles.h>
#include <equiaffine/registration/internal/registration.h>
#include <equiaffine/registration/internal/registration_of_triangles.h>
#include <equiaffine/registration/internal/symmetries.h>
#include <equiaffine/registration/internal/wholes/differ_as_wholes.h>

#include <CGAL/tags.h>
#include <Eigen/Core>

#include <vector>

namespace equiaffine::internal {

#define EQUIAFFINE_INSTANTIATE(Tag)                                                                                    \
  template Registration_of_functions_3 registration_of_functions<Tag>(                                                 \
      const Surface_with_points_3&, const Surface_with_points_3&, const Registration_request&);                        \
  template Surface_registration_3<Kernel_of_searches> registration_of_triangles<Tag>(                                  \
      const Triangles_3&, const Triangles_3&, const Registration_request&);                                            \
  template bool differ_as_wholes<Tag>(const Any_function_3&, const Any_function_3&, Map_kind, bool);                   \
  template Affine_slippage_3 slippage_of_triangles<Tag>(const Triangles_3&, Map_kind);                                 \
  template Affine_symmetries_3<Kernel_of_searches> symmetries_of_function<Tag>(                                        \
      const Any_function_3&, const std::vector<Eigen::Vector3d>&, const Symmetry_request&);                            \
  template Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles<Tag>(const Triangles_3&, const Map_request&);

EQUIAFFINE_INSTANTIATE(CGAL::Sequential_tag)
#ifdef CGAL_LINKED_WITH_TBB
EQUIAFFINE_INSTANTIATE(CGAL::Parallel_tag)
#endif
#undef EQUIAFFINE_INSTANTIATE

template Mesh_contradictions contradictions_of_triangles<CGAL::Sequential_tag>(Triangles_3, Triangles_3, double);

} // namespace equiaffine::internal
