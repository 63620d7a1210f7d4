// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_REQUEST_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_REQUEST_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace equiaffine::internal {

/// The parameters of fits that a user gave; the data decide the others.
struct Fit_request {
  std::optional<double> noise;     ///< a length
  std::optional<double> scale = 0; ///< a length, or 0 for the surface's own curvature; nothing for one by the data
  std::optional<int> degree;
};

/// Refuses named parameters that are neither those of every fit nor among `OtherTags`.
template <class Parameters, class... OtherTags>
constexpr void check_fit_parameters() {
  check_parameters<Parameters, Noise_tag, Scale_tag, Ball_radius_tag, Degree_tag, Geom_traits_tag, Verbose_tag,
                   OtherTags...>();
}

/// The same for meshes.
template <class Parameters, class... OtherTags>
constexpr void check_mesh_fit_parameters() {
  check_fit_parameters<Parameters, Vertex_point_tag, Vertex_normal_tag, Feature_angle_tag, OtherTags...>();
}

/// The same for points without faces.
template <class Parameters, class... OtherTags>
constexpr void check_point_fit_parameters() {
  check_fit_parameters<Parameters, Point_tag, Normal_tag, Normal_orientation_tag, OtherTags...>();
}

/// Reads the named parameters of every fit, and checks their values.
template <class Parameters>
Fit_request fit_request(const Parameters& parameters) {
  Fit_request request;
  if constexpr (has_parameter<Noise_tag, Parameters>) {
    request.noise = given_parameter<Noise_tag>(parameters);
    check_argument(!request.noise || (*request.noise >= 0 && std::isfinite(*request.noise)),
                   "the noise is a length, 0 or more");
  }
  if constexpr (has_parameter<Ball_radius_tag, Parameters>) {
    const double radius = CGAL::to_double(given_parameter<Ball_radius_tag>(parameters));
    check_argument(std::isfinite(radius), "the radius of a ball is a length, or -1 for the surface's own curvature");
    request.scale = std::max(radius, 0.);
  }
  if constexpr (has_parameter<Scale_tag, Parameters>) {
    request.scale = given_parameter<Scale_tag>(parameters);
    check_argument(!request.scale || (*request.scale >= 0 && std::isfinite(*request.scale)),
                   "the scale is a length, or 0 for the surface's own curvature");
  }
  if constexpr (has_parameter<Degree_tag, Parameters>) {
    request.degree = given_parameter<Degree_tag>(parameters);
    const int d = request.degree.value_or(4);
    check_argument(d == 4 || d == 5 || d == 6 || d == 8 || d == 10, "the degree of a fit is 4, 5, 6, 8 or 10");
  }
  return request;
}

} // namespace equiaffine::internal

#endif
