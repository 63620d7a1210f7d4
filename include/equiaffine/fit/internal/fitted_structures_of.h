// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FITTED_STRUCTURES_OF_H
#define EQUIAFFINE_FIT_INTERNAL_FITTED_STRUCTURES_OF_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fit_data_3.h>
#include <equiaffine/fit/internal/Fit_request.h>
#include <equiaffine/fit/internal/fit_data_of.h>
#include <equiaffine/fit/internal/fits.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

// The functions of fitted_structures.h with all their named parameters in one chain, which may have others.
namespace equiaffine::internal {

template <class Parameters>
Orientation_of_level_set orientation_of(const Parameters& parameters) {
  return get_parameter<Orientation_tag>(parameters, Orientation_of_level_set::ALONG_GRADIENT);
}

template <class ConcurrencyTag, class Parameters>
std::vector<Fitted_structure_3<double>> structures_by_request(Fit_data_3 data, const Parameters& parameters) {
  return structures_of_data(runs_in_threads<ConcurrencyTag>(), std::move(data), fit_request(parameters),
                            orientation_of(parameters));
}

template <class ConcurrencyTag, class Graph, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_graph(const Graph& mesh, const Parameters& parameters) {
  return structures_by_request<ConcurrencyTag>(fit_data_of_graph(mesh, parameters), parameters);
}

template <class Vertex, class Graph, class Parameters>
Fitted_structure_3<double> fitted_structure_of_vertex(const Vertex& v, const Graph& mesh,
                                                      const Parameters& parameters) {
  const auto all = vertices_of(mesh);
  const auto place = std::find(std::begin(all), std::end(all), v);
  CGAL_precondition_msg(place != std::end(all), "the vertex is none of the mesh");
  const auto i = std::size_t(std::distance(std::begin(all), place));
  return structure_of_vertex(fit_data_of_graph(mesh, parameters), fit_request(parameters), orientation_of(parameters),
                             i);
}

template <class ConcurrencyTag, class Points, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_points(Points&& points, const Parameters& parameters) {
  return structures_by_request<ConcurrencyTag>(fit_data_of_points(points, parameters), parameters);
}

template <class ConcurrencyTag, class Points, class Polygons, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_soup(const Points& points, const Polygons& polygons,
                                                                  const Parameters& parameters) {
  return structures_by_request<ConcurrencyTag>(fit_data_of_soup(points, polygons, parameters), parameters);
}

} // namespace equiaffine::internal

#endif
