// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ANNOTATE_FITS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ANNOTATE_FITS_H

#include <equiaffine/attributes/internal/Property_maps.h>
#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/fit/internal/Fit_request.h>

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine::internal {

template <class Parameters, class... OtherTags, class... Tags, class... More>
constexpr void check_maps_of_fit(Tag_list<Tags...>, Tag_list<More...>) {
  check_fit_parameters<Parameters, Orientation_tag, OtherTags..., Tags..., More...>();
}

template <class Parameters, class... OtherTags>
constexpr void check_annotate_by_fit_parameters() {
  check_maps_of_fit<Parameters, OtherTags...>(Structure_tags(), Error_tags());
}

template <class Parameters>
inline constexpr bool has_maps_of_fit = has_maps<Parameters>(Structure_tags()) || has_maps<Parameters>(Error_tags());

template <class Parameters, class Key>
void put_structure_of_fit(const Parameters& parameters, Key& key, const Fitted_structure_3<double>& structure) {
  put_structure(parameters, key, structure, Structure_tags());
  put_structure(parameters, key, structure, Error_tags());
}

/// Fills the maps that are given with the structures of the elements, in their order.
template <class Parameters, class Elements>
void put_structures_of_fit(const Parameters& parameters, Elements&& elements,
                           const std::vector<Fitted_structure_3<double>>& structures) {
  static_assert(has_maps_of_fit<Parameters>,
                "annotate_by_fit() has nothing to write to: give it property maps, such as "
                "parameters::vertex_affine_mean_curvature_map(map), or a CGAL::Surface_mesh that is not const");
  std::size_t i = 0;
  for (auto&& element : elements) put_structure_of_fit(parameters, element, structures[i++]);
}

/// Fills the maps `v:NAME` of a surface mesh with all that is known of its vertices.
template <class Mesh>
void fill_maps_of_fit(Mesh& mesh, const std::vector<Fitted_structure_3<double>>& structures) {
  check_mesh_for_maps<Mesh>();
  using Maps = Property_maps<Mesh>;
  Maps maps(mesh);
  std::vector<typename Mesh::template Property_map<typename Mesh::Vertex_index, double>> errors;
  for (const auto& row : error_table<double>)
    errors.push_back(Maps::template add<double>(mesh, std::string(row.attribute) + "_error"));
  auto gaussian_noise = Maps::template add<double>(mesh, "affine_gaussian_curvature_noise");
  auto mean_noise = Maps::template add<double>(mesh, "affine_mean_curvature_noise");
  std::size_t i = 0;
  for (const auto v : mesh.vertices()) {
    const auto& s = structures[i++];
    maps.set(v, s.structure);
    for (std::size_t n = 0; n < errors.size(); ++n) errors[n][v] = error_table<double>[n].get(s.error);
    gaussian_noise[v] = s.noise.affine_gaussian_curvature;
    mean_noise[v] = s.noise.affine_mean_curvature;
  }
}

} // namespace equiaffine::internal

#endif
