// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/internal/fits.h>

#include <CGAL/tags.h>

namespace equiaffine::internal {

#define EQUIAFFINE_INSTANTIATE(Tag)                                                                                    \
  template std::vector<Fitted_structure_3<double>> structures_of_data<Tag>(const Fit_data_3&, const Fit_request&,      \
                                                                           Orientation_of_level_set);                  \
  template Fitted_structure_3<double> structure_of_vertex<Tag>(const Fit_data_3&, const Fit_request&,                  \
                                                               Orientation_of_level_set, std::size_t);                 \
  template std::shared_ptr<const Fitted_function_3> fitted_function<Tag>(const Fit_data_3&, const Fit_request&);       \
  template std::vector<double> distances_of_sheets<Tag>(const Fitted_data_3&, double);

EQUIAFFINE_INSTANTIATE(CGAL::Sequential_tag)
EQUIAFFINE_INSTANTIATE(CGAL::Parallel_tag)

} // namespace equiaffine::internal
