// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_TAGS_H
#define EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_TAGS_H

#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

// The columns of a file whose numbers a property map with a tag has.
namespace equiaffine::internal {

template <class... First, class... Second>
Tag_list<First..., Second...> concatenated(Tag_list<First...>, Tag_list<Second...>);

/// The maps that a file can hold, but those of the status and of the principal curvatures.
using Column_tags =
    decltype(concatenated(Tag_list<Vertex_unit_normal_tag, Vertex_mean_curvature_tag, Vertex_Gaussian_curvature_tag,
                                   Vertex_affine_mean_curvature_tag, Vertex_affine_Gaussian_curvature_tag,
                                   Vertex_affine_normal_tag, Vertex_conormal_tag, Vertex_pick_invariant_tag,
                                   Vertex_affine_metric_tag, Vertex_affine_area_density_tag>(),
                          Error_tags()));
using Tags_of_files = Tag_list<Vertex_status_tag, Vertex_principal_curvatures_tag>;

/// Refuses named parameters that are neither these maps nor among the other tags.
template <class Parameters, class... Others>
constexpr void check_map_file_parameters() {
  check_parameters_of_maps<Parameters, Vertex_status_tag, Vertex_principal_curvatures_tag, Geom_traits_tag, Verbose_tag,
                           Others...>(Column_tags());
}

constexpr std::string_view attribute_of(Vertex_unit_normal_tag) { return "normal"; }
constexpr std::string_view attribute_of(Vertex_mean_curvature_tag) { return "mean_curvature"; }
constexpr std::string_view attribute_of(Vertex_Gaussian_curvature_tag) { return "gaussian_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_mean_curvature_tag) { return "affine_mean_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_Gaussian_curvature_tag) { return "affine_gaussian_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_normal_tag) { return "affine_normal"; }
constexpr std::string_view attribute_of(Vertex_conormal_tag) { return "conormal"; }
constexpr std::string_view attribute_of(Vertex_pick_invariant_tag) { return "pick_invariant"; }
constexpr std::string_view attribute_of(Vertex_affine_metric_tag) { return "metric"; }
constexpr std::string_view attribute_of(Vertex_affine_area_density_tag) { return "affine_area_density"; }
constexpr std::string_view attribute_of(Vertex_affine_mean_curvature_error_tag) {
  return "affine_mean_curvature_error";
}
constexpr std::string_view attribute_of(Vertex_affine_Gaussian_curvature_error_tag) {
  return "affine_gaussian_curvature_error";
}
constexpr std::string_view attribute_of(Vertex_affine_normal_error_tag) { return "affine_normal_error"; }
constexpr std::string_view attribute_of(Vertex_conormal_error_tag) { return "conormal_error"; }
constexpr std::string_view attribute_of(Vertex_pick_invariant_error_tag) { return "pick_invariant_error"; }
constexpr std::string_view attribute_of(Vertex_affine_area_density_error_tag) { return "affine_area_density_error"; }
constexpr std::string_view attribute_of(Vertex_mean_curvature_error_tag) { return "mean_curvature_error"; }
constexpr std::string_view attribute_of(Vertex_Gaussian_curvature_error_tag) { return "gaussian_curvature_error"; }
constexpr std::string_view attribute_of(Vertex_unit_normal_error_tag) { return "normal_error"; }

/// Maps of CGAL have the opposite of the mean curvature of files.
template <class Tag>
constexpr double sign_in_files(Tag) {
  return std::is_same_v<Tag, Vertex_mean_curvature_tag> ? -1 : 1;
}

/// How many columns an attribute has: one if the table has no such attribute, as for an estimated error.
constexpr std::size_t number_of_columns(std::string_view attribute) {
  for (const auto& row : attribute_table<double>)
    if (row.name == attribute) return row.size();
  return 1;
}

/// The names of the columns that the map with a tag has.
template <class Tag>
auto columns_of(Tag tag) {
  std::array<std::string, number_of_columns(attribute_of(Tag()))> names{std::string(attribute_of(tag))};
  for (const auto& row : attribute_table<double>)
    if (row.name == attribute_of(tag))
      for (std::size_t i = 0; i < names.size(); ++i) names[i] = row.column(i);
  return names;
}

/// The names of the columns of a vector with a name.
inline std::array<std::string, 3> columns_of_vector(const std::string& name) {
  if (name == "normal") return {"nx", "ny", "nz"};
  return {name + "_x", name + "_y", name + "_z"};
}

} // namespace equiaffine::internal

#endif
