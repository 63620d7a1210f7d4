// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/source.h"

#include "source/read_mesh.h"
#include "source/source_function.h"
#include "source/warnings.h"
#include "system/files.h"
#include "system/front_end.h"
#include "system/kernel.h"
#include "system/memory_limit.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/surface/internal/grid_of_data.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/signed_distance_volume.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

using Size = Lattice_3<Kernel>::Size;

/// Throws if the name of a constant does not occur in the formula, which must be valid.
void check_constants_are_used(const Source_options& options) {
  for (const auto& [name, value] : options.constants) {
    auto others = options.constants;
    others.erase(name);
    try {
      Expression_3(options.text, others);
    } catch (const Input_error&) {
      continue; // the name is used
    }
    throw Input_error(option_text("constants " + name) + ": the formula " + options.text + " does not contain '" +
                      name + "'; correct the name or leave it out");
  }
}

/// Describes a source; `file` is the name of its file, if it has one.
std::string describe_as(const Source_options& options, const std::string& file) {
  switch (options.kind) {
  case Source_kind::FUNCTION: return "the formula " + options.text;
  case Source_kind::VOLUME: return "the volume '" + file + "'";
  default:
    return (options.kind == Source_kind::FIT ? "the fit to " : "the distance to ") +
           (options.text == "-" ? "standard input" : "'" + file + "'");
  }
}

Expression_3 parse_formula(const Source_options& options) {
  try {
    return Expression_3(options.text, options.constants);
  } catch (const Unknown_name_error& error) {
    const std::string constant =
        by_front_end("--constants " + error.name() + "=VALUE", "constants={\"" + error.name() + "\": VALUE}");
    throw Input_error(std::string(error.what()) + " (" + constant + ")", error.excerpt());
  }
}

Formula_traits make_formula(const Source_options& options) {
  // Without a box the formula is only evaluated at given points, and the box is not used.
  Expression_3 expression = parse_formula(options);
  check_constants_are_used(options);
  return {std::move(expression), options.box.value_or(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1))};
}

/// The fit, restricted to the box of the options or of the data, and to a band around the data.
Fit_traits placed_fit(const Fit_traits& fit, const Source_options& options, const std::vector<Kernel::Point_3>& data,
                      double radius) {
  const CGAL::Bbox_3 box = options.box ? *options.box : internal::widened_box(data);
  const auto nodes = options.resolution.value_or(default_resolution(options.kind));
  return fit.in_box(box).in_band(internal::height_of_band(nodes, box, radius));
}

/// Fits the vertices of a mesh or points. Too few points are an error, except for registration, which then finds no
/// map.
Fit_traits make_fit(const Source_options& options, const Point_table_3<Kernel>& table, double radius,
                    Progress& progress) {
  progress.begin("fitting polynomials");
  const Fit_traits fit = blend_vertices(table, options.fit);
  if (fit.bbox() == CGAL::Bbox_3() && !options.is_registered)
    throw Input_error("cannot make " + describe_as(options, options.text) +
                      ": no point has enough neighbors to fit a polynomial; give more points" +
                      (options.fit.scale ? ", a larger " + option_text("scale") : "") +
                      (options.fit.scale || options.fit.degree ? " or a smaller " + option_text("degree") : ""));
  warn_of_opposed_normals(table, progress);
  return placed_fit(fit, options, table.mesh.points, radius);
}

Point_table_3<Kernel> read_data(const Source_options& options, Progress& progress) {
  progress.begin("reading the vertices");
  Point_table_3<Kernel> table = read_vertices(options);
  if (have_colors(table)) progress.announce(describe_as(options, options.text) + ": " + xyz_colors_note);
  return table;
}

Volume_3<Kernel> sample_distance(const Source_options& options, const Size& size, Progress& progress) {
  progress.begin("reading the mesh");
  const CGAL::Surface_mesh<Kernel::Point_3> mesh = read_triangle_mesh(options.text);
  const Lattice_3<Kernel> lattice(size, options.box ? *options.box : internal::widened_box(mesh.points()));
  progress.begin("computing distances", lattice.number_of_nodes());
  try {
    double longest_step = 0;
    for (const auto& step : lattice.steps()) longest_step = std::max(longest_step, std::sqrt(step.squared_length()));
    const double voxels = options.narrow_band.value_or(std::numeric_limits<double>::infinity());
    return signed_distance_volume<CGAL::Parallel_if_available_tag>(
        mesh, lattice, [&](std::size_t nodes) { progress.advance(nodes); }, voxels * longest_step);
  } catch (const Input_error& error) {
    throw Input_error("cannot compute " + describe_as(options, options.text) + ": " + error.what());
  }
}

/// Throws if values are missing and the scheme is interpolation: its recursive filter would spread NaN to all nodes.
void check_values(const Volume_view_3<Kernel>& volume, const Source_options& options) {
  if (options.spline.spline_scheme != Spline_scheme::INTERPOLATION) return;
  const auto [nx, ny, nz] = volume.lattice().size();
  std::vector<double> row(nx);
  std::ptrdiff_t missing = 0;
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      volume.copy_line({0, j, k}, 0, row);
      missing += std::count_if(row.begin(), row.end(), [](double x) { return !std::isfinite(x); });
    }
  if (missing > 0)
    throw Input_error(option_text("spline_scheme") + ": interpolation needs a value at every node, and " +
                      describe_as(options, options.text) + " has no value at " + std::to_string(missing) +
                      (missing == 1 ? " node" : " nodes") + "; use quasi-interpolation");
}

/// Throws if the steps of the grid are so short or long that derivatives of a spline on it leave double precision.
void check_steps(const Lattice_3<Kernel>& lattice, const Source_options& options) {
  using Spline = Spline_function_3<Kernel>;
  for (const auto& step : lattice.steps()) {
    const double length = std::hypot(step.x(), step.y(), step.z());
    if (Spline::shortest_step <= length && length <= Spline::longest_step) continue;
    std::ostringstream text;
    text << "the grid spacing of " << describe_as(options, options.text) << " is " << length
         << ", so that fourth derivatives may leave the range of double precision; choose another unit, with spacings "
            "from "
         << Spline::shortest_step << " to " << Spline::longest_step;
    throw Input_error(text.str());
  }
}

struct Fitted_spline {
  Spline_traits function;
  Spline_statistics statistics;
  std::optional<Curvature_error_3<Kernel>> errors = {};
  std::optional<Spline_traits> unsmoothed = {};
};

Fitted_spline fit_spline(const Source_options& source, Progress& progress) {
  const Volume_view_3<Kernel> volume = [&]() -> Volume_view_3<Kernel> {
    if (source.kind != Source_kind::VOLUME) return sample_source(source, progress);
    if (source.volume) return source.volume();
    progress.begin("reading the volume");
    return source.raw ? read_raw_volume(source.text, *source.raw)
                      : read_volume(source.text, Samples_in::FILE, source.selection);
  }();
  check_values(volume, source);
  check_steps(volume.lattice(), source);
  progress.begin("estimating noise");
  const Smoothing_decision decision = decide_smoothing(volume, source.spline);
  progress.begin("fitting a spline");
  Volume_options options = source.spline;
  options.smoothing = decision.smoothing;
  Fitted_spline fit = {Spline_traits(volume, options),
                       {options.spline_degree, options.spline_scheme, decision.smoothing, decision.is_chosen,
                        decision.noise, std::ranges::min(volume.lattice().size()), decision.distinct_values}};
  if (source.estimates_errors) fit.errors.emplace(fit.function, volume, decision.smoothing, decision.noise.deviation);
  if (source.is_registered && decision.smoothing > 0) {
    options.smoothing = 0;
    fit.unsmoothed.emplace(volume, options);
  }
  return fit;
}

template <class Traits>
Source_function transformed_function(Traits traits, const Source_options& options) {
  return Transformed_function_traits_3(
      std::move(traits), options.transformation.value_or(CGAL::Aff_transformation_3<Kernel>(CGAL::IDENTITY)));
}

Source source_of(const Fit_traits& fit, Indexed_triangle_mesh_3<Kernel> data, const Source_options& options) {
  return {.function = transformed_function(fit, options), .fit = fit, .data = std::move(data)};
}

Source fitted(Point_table_3<Kernel> table, const Source_options& options, double radius, Progress& progress) {
  const Fit_traits fit = make_fit(options, table, radius, progress);
  return source_of(fit, std::move(table.mesh), options);
}

} // namespace

std::array<std::size_t, 3> default_resolution(Source_kind kind) {
  if (kind == Source_kind::DISTANCE || kind == Source_kind::FIT) return internal::nodes_of_data;
  return {64, 64, 64};
}

Volume_3<Kernel> sample_source(const Source_options& options, Progress& progress) {
  const Size size = options.resolution.value_or(default_resolution(options.kind));
  check_memory_of_volume(size, options.memory_use);
  if (options.kind == Source_kind::DISTANCE) return sample_distance(options, size, progress);
  const auto sample = [&](const auto& function, const std::string& name) {
    const Lattice_3<Kernel> lattice(size, function.bbox());
    progress.begin("sampling the " + name, lattice.number_of_nodes());
    return sample_on_lattice<CGAL::Parallel_if_available_tag>(function, lattice,
                                                              [&](std::size_t nodes) { progress.advance(nodes); });
  };
  return options.kind == Source_kind::FIT ? sample(make_fit(options, read_data(options, progress), 0, progress), "fit")
                                          : sample(make_formula(options), "formula");
}

Source source_of_fit(const Fit_traits& fit, Indexed_triangle_mesh_3<Kernel> data, const Source_options& options,
                     double radius) {
  const Fit_traits placed = placed_fit(fit, options, data.points, radius);
  return source_of(placed, std::move(data), options);
}

Source refitted(const Source& source, const Source_options& options, Progress& progress) {
  Point_table_3<Kernel> table;
  table.mesh = source.data;
  return fitted(std::move(table), options, 0, progress);
}

Source make_source(const Source_options& options, Progress& progress, double radius) {
  if (options.kind == Source_kind::FIT) return fitted(read_data(options, progress), options, radius, progress);
  const auto transformed = [&](auto traits) { return transformed_function(std::move(traits), options); };
  if (options.derivatives == Derivatives::JETS) return {.function = transformed(make_formula(options))};
  Fitted_spline fit = fit_spline(options, progress);
  const std::size_t samples = fit.function.lattice().number_of_nodes();
  Source source{.function = transformed(std::move(fit.function)),
                .function_evaluations = options.kind == Source_kind::VOLUME ? 0 : samples,
                .spline = fit.statistics,
                .errors = std::move(fit.errors)};
  if (fit.unsmoothed) source.unsmoothed = transformed(std::move(*fit.unsmoothed));
  return source;
}

std::string describe(const Source_options& options) { return describe_as(options, name_of_file(options.text)); }

} // namespace equiaffine
