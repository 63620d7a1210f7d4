// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/internal/blended_function.h>
#include <equiaffine/fit/internal/declared_fits.h>
#include <equiaffine/fit/internal/distances_of_sheets.h>
#include <equiaffine/fit/internal/structures_of_fit.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace equiaffine::internal {

#define EQUIAFFINE_INSTANTIATE(Tag)                                                                                    \
  template std::vector<Fitted_structure_3<double>> structures_of_data<Tag>(Fit_data_3, const Fit_request&,             \
                                                                           Orientation_of_level_set);                  \
  template std::shared_ptr<const Fitted_function_3> fitted_function<Tag>(Fit_data_3, const Fit_request&);              \
  template std::vector<double> distances_of_sheets<Tag>(const Fitted_data_3&, double);

EQUIAFFINE_INSTANTIATE(CGAL::Sequential_tag)
#ifdef CGAL_LINKED_WITH_TBB
EQUIAFFINE_INSTANTIATE(CGAL::Parallel_tag)
#endif
#undef EQUIAFFINE_INSTANTIATE

template Fitted_structure_3<double> structure_of_vertex<CGAL::Sequential_tag>(Fit_data_3, const Fit_request&,
                                                                              Orientation_of_level_set, std::size_t);

} // namespace equiaffine::internal
