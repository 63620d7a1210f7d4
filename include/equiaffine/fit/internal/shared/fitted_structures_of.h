// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_SHARED_FITTED_STRUCTURES_OF_H
#define EQUIAFFINE_FIT_INTERNAL_SHARED_FITTED_STRUCTURES_OF_H

#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fitted_data_3.h>
#include <equiaffine/fit/internal/data/fit_input.h>
#include <equiaffine/fit/internal/data/fit_input_of_soup.h>
#include <equiaffine/fit/internal/shared/Fit_request.h>
#include <equiaffine/fit/internal/structures_of_fit.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

// The functions of fitted_structures.h with all their named parameters in one chain, which may have others.
namespace equiaffine::internal {

template <class Graph, class Parameters, class ConcurrencyTag>
Fitted_data_3 fitted_data_of_graph(const Graph& mesh, const Parameters& parameters, ConcurrencyTag tag) {
  return Fitted_data_3(fit_input_of_graph(mesh, parameters), fit_request(parameters), tag);
}

template <class ConcurrencyTag, class Graph, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_graph(const Graph& mesh, const Parameters& parameters) {
  auto structures =
      structures_of_fit<ConcurrencyTag>(fitted_data_of_graph(mesh, parameters, ConcurrencyTag()), parameters);
  const auto all = vertices_of(mesh);
  structures.resize(std::size_t(std::distance(std::begin(all), std::end(all)))); // without points of creases
  return structures;
}

template <class Vertex, class Graph, class Parameters>
Fitted_structure_3<double> fitted_structure_of_vertex(const Vertex& v, const Graph& mesh,
                                                      const Parameters& parameters) {
  const auto all = vertices_of(mesh);
  const auto place = std::find(std::begin(all), std::end(all), v);
  CGAL_precondition_msg(place != std::end(all), "the vertex is none of the mesh");
  const auto i = std::distance(std::begin(all), place);
  return structure_at_point(fitted_data_of_graph(mesh, parameters, CGAL::Sequential_tag()), Data_points_3::Index(i),
                            orientation_of(parameters));
}

template <class ConcurrencyTag, class Points, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_points(Points&& points, const Parameters& parameters) {
  auto input = fit_input_of_points<ConcurrencyTag>(points, parameters);
  const Fitted_data_3 fit(std::move(input.data), fit_request(parameters), ConcurrencyTag());
  return elements_at(structures_of_fit<ConcurrencyTag>(fit, parameters), input.positions);
}

template <class ConcurrencyTag, class Points, class Polygons, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_soup(const Points& points, const Polygons& polygons,
                                                                  const Parameters& parameters) {
  auto input = fit_input_of_soup(points, polygons, feature_angle(parameters));
  const Fitted_data_3 fit(std::move(input.data), fit_request(parameters), ConcurrencyTag());
  return elements_at(structures_of_fit<ConcurrencyTag>(fit, parameters), input.positions);
}

} // namespace equiaffine::internal

#endif
