// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/surface_of_data.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/internal/grid_of_data.h>

#include <CGAL/compute_average_spacing.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

using Fit_of_surface = Fitted_function_traits_3<Kernel_of_searches>;

using Tag = CGAL::Parallel_if_available_tag;

Fit_of_surface fit_to(const Surface_data_3& data, const Fit_options& options) try {
  using Element = std::pair<Kernel_of_searches::Point_3, Kernel_of_searches::Vector_3>;
  const auto& [points, triangles] = data.mesh;
  if (!triangles.empty()) return Fit_of_surface(points, triangles, options, {}, Tag());
  if (data.normals.empty()) return Fit_of_surface(points, options, {}, Tag());
  std::vector<Element> elements;
  for (std::size_t i = 0; i < points.size(); ++i) elements.emplace_back(points[i], data.normals[i]);
  return Fit_of_surface(elements, options,
                        parameters::point_map(CGAL::First_of_pair_property_map<Element>())
                            .normal_map(CGAL::Second_of_pair_property_map<Element>()),
                        Tag());
} catch (const Input_error& error) {
  if (error.field().empty()) throw;
  throw Input_error::about("fit." + error.field(), error.sentence());
}

/// The fit as samplers need it.
Fit_of_surface placed_fit(const Surface_data_3& data, const Fit_options& options) {
  const Fit_of_surface fit = fit_to(data, options);
  const CGAL::Bbox_3 box = widened_box(data.mesh.points);
  return fit.in_box(box).in_band(height_of_band(nodes_of_data, box));
}

} // namespace

double mean_spacing(bool in_threads, const std::vector<Kernel_of_searches::Point_3>& points) {
  constexpr unsigned neighbors = 6;
  return on_threads_if(in_threads, [&] { return CGAL::compute_average_spacing<Tag>(points, neighbors); });
}

Surface_to_register surface_of_data(bool in_threads, const Surface_data_3& data, const Fit_options& options,
                                    Use_of_surface use) {
  const Fit_of_surface fit = on_threads_if(in_threads, [&] { return placed_fit(data, options); });
  Surface_to_register surface{.function = Any_function_3::make(fit),
                              .mesh = data.mesh,
                              .is_mesh = !data.mesh.triangles.empty(),
                              .origin = Surface_origin::FIT,
                              .given_scale = options.scale,
                              .scale = fit.scale()};
  if (use == Use_of_surface::SYMMETRIES) {
    if (!surface.is_mesh)
      surface.extracted = on_threads_if(in_threads, [&]() -> Mesh_of_searches {
        return marching_cubes<Tag>(fit, Marching_cubes_options{.resolution = nodes_of_data});
      });
  } else if (!options.scale) {
    surface.spacing = mean_spacing(in_threads, data.mesh.points);
    surface.at_scale = [=, &data](double scale) {
      Fit_options at_scale = options;
      at_scale.scale = scale;
      return surface_of_data(in_threads, data, at_scale, use);
    };
  }
  return surface;
}

} // namespace equiaffine::internal
