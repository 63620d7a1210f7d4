// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/extract_surface.h"

#include "source/evaluate_source.h"
#include "source/source.h"
#include "source/source_function.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/remove_small_fragments.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/surface_parts.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

Isosurface_3<Kernel> extract_surface(const Source_function& function, double isovalue, const Source_options& options,
                                     Vertex_position vertices) {
  const auto nodes = options.resolution.value_or(default_resolution(options.kind));
  return isosurface_of_source(function, isovalue, {.resolution = nodes, .vertices = vertices});
}

namespace {

/// The minimum and maximum of f at the nodes of a grid; infinity and -infinity if all values are NaN.
template <class Traits>
std::pair<double, double> range_on_grid(const Traits& function) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  const auto add = [&](const std::vector<double>& values) {
    for (const double value : values) {
      if (value < least) least = value; // std::min would keep a NaN
      if (value > greatest) greatest = value;
    }
  };
  if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
    const auto [nx, ny, nz] = function.lattice().size();
    std::vector<double> row(nx);
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j) {
        samples(function, {0, j, k}, {nx, 1, 1}, row);
        add(row);
      }
  } else {
    add(sample_on_lattice<CGAL::Parallel_if_available_tag>(function, sampling_lattice(function, {33, 33, 33})).values);
  }
  return {least, greatest};
}

/// |f|, or infinity where f is undefined.
double size_at(const Any_function_3& f, const Kernel::Point_3& p) {
  const double size = std::abs(f.value(p));
  return std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
}

/// A local minimum of |f| near p, within the box of f, by a compass search along the axes. Ends after `most_rounds`,
/// since steps hardly become shorter in a curved valley.
Kernel::Point_3 least_near(const Any_function_3& f, Kernel::Point_3 p) {
  constexpr double first_step = 1. / 32, shortest_step = 1e-12; // in sides of the box
  constexpr int most_rounds = 2000;
  const CGAL::Bbox_3 box = f.bbox();
  double least = size_at(f, p), step = first_step;
  for (int round = 0; round < most_rounds && step > shortest_step && least > 0; ++round) {
    const double before = least;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1., 1.}) {
        std::array<double, 3> q = {p.x(), p.y(), p.z()};
        q[std::size_t(axis)] += sign * step * (box.max(axis) - box.min(axis));
        const Kernel::Point_3 moved(q[0], q[1], q[2]);
        if (!CGAL::do_overlap(box, moved.bbox())) continue;
        if (const double size = size_at(f, moved); size < least) least = size, p = moved;
      }
    if (least == before) step /= 2;
  }
  return p;
}

/// Returns a clause about zeros where f does not change its sign. It is empty if f has both signs at the nodes of a
/// grid, or if searches from the nodes of least |f| find no zero up to rounding.
std::string zeros_without_change_of_sign(const Any_function_3& f) {
  constexpr std::size_t starts = 20;
  constexpr double rounding = 1e-14;
  const auto grid = sample_on_lattice<CGAL::Parallel_if_available_tag>(f, sampling_lattice(f, {33, 33, 33}));
  const auto& values = grid.values;
  std::vector<std::size_t> nodes;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (std::isfinite(values[n])) nodes.push_back(n);
  if (nodes.empty()) return {};
  const auto by_value = [&](std::size_t m, std::size_t n) { return values[m] < values[n]; };
  const auto [least, greatest] = std::minmax_element(nodes.begin(), nodes.end(), by_value);
  if (values[*least] < 0 && values[*greatest] > 0) return {};
  const double size = std::max(-values[*least], values[*greatest]);
  if (size == 0) return "f has this value at all nodes of a grid";
  const auto last = nodes.begin() + std::ptrdiff_t(std::min(starts, nodes.size()));
  std::partial_sort(nodes.begin(), last, nodes.end(),
                    [&](std::size_t m, std::size_t n) { return std::abs(values[m]) < std::abs(values[n]); });
  const auto [nx, ny, nz] = grid.lattice.size();
  for (auto node = nodes.begin(); node != last; ++node) {
    const std::size_t row = *node / nx;
    const auto p = least_near(f, grid.lattice.point(double(*node % nx), double(row % ny), double(row / ny)));
    if (size_at(f, p) > rounding * size) continue;
    std::ostringstream text;
    text.precision(3);
    text << "f touches this value without crossing it, for example near " << p;
    return text.str();
  }
  return {};
}

/// The same for a fit, which has a surface only near its data.
[[noreturn]] void fail_without_surface_of_fit(const Fit_traits& fit, const Source_options& source, double isovalue,
                                              const Failed_search& search) {
  const CGAL::Bbox_3 box = fit.bbox(), band = fit.band_box();
  const std::string fitted = describe(source);
  std::ostringstream text;
  if (!CGAL::do_overlap(box, band)) {
    text << "no part of " << fitted << " is in the " << search.place << ": it lies in " << band.xmin() << ' '
         << band.xmax() << ' ' << band.ymin() << ' ' << band.ymax() << ' ' << band.zmin() << ' ' << band.zmax()
         << "; choose a " << option_text("box") << " that overlaps this one, or leave it out";
  } else if (isovalue != 0) {
    text << "no surface f = " << isovalue << ": " << fitted
         << " approximates the distance from the data, and is defined only within about two spacings of them; choose a "
         << option_text("level") << " nearer to 0, or leave it out";
  } else {
    text << "no part of the surface of " << fitted << " was found in the " << search.place << "; choose a "
         << option_text("box") << " that contains more of the data, or "
         << (search.refinement.empty() ? "leave it out" : search.refinement);
  }
  throw Input_error(text.str());
}

template <class Traits>
bool changes_sign_at_poles_only(const Traits& function) {
  const auto surface = marching_cubes<CGAL::Parallel_if_available_tag>(function, {.resolution = 32});
  const auto& status = surface.vertex_status;
  return surface.repairs.vertices_at_poles + status.size() > 0 &&
         std::count(status.begin(), status.end(), Point_status::UNCONVERGED) == std::ptrdiff_t(status.size());
}

} // namespace

bool changes_sign_at_poles_only(const Source_function& function, double isovalue) {
  // Any_function_3 would hide the sample grid of a spline.
  if (const auto* const spline = std::get_if<Spline_function>(&function))
    return changes_sign_at_poles_only(Level_set_traits_3(*spline, isovalue));
  return changes_sign_at_poles_only(any_level_set(function, isovalue));
}

void fail_without_surface(const Source_function& function, const Source_options& source, double isovalue,
                          const Failed_search& search) {
  if (const auto* const fit = std::get_if<Fit_function>(&function))
    fail_without_surface_of_fit(fit->base(), source, isovalue, search);
  const auto [least, greatest] = std::visit([](const auto& f) { return range_on_grid(f); }, function);
  const bool is_defined = least <= greatest, has_both_signs = least < isovalue && greatest > isovalue;
  const Any_function_3 level_set = any_level_set(function, isovalue);
  const bool is_proved = search.is_certified || !level_set.bounds(level_set.bbox()).contains(0);
  const std::string zeros = is_proved || has_both_signs ? std::string() : zeros_without_change_of_sign(level_set);
  const bool may_be_erased = source.derivatives == Derivatives::SPLINE && source.spline.smoothing != 0.;
  const bool may_help = !search.refinement.empty() && !search.met_poles && !is_proved && zeros.empty();
  std::ostringstream text;
  text << (is_proved ? "no surface f = " : "no part of the surface f = ") << isovalue << (is_proved ? "" : " was found")
       << " in the " << search.place << ": ";
  if (!zeros.empty()) text << zeros;
  else if (is_defined)
    text << "at the nodes of a grid " << (may_be_erased ? "the smoothed f" : "f") << " lies between " << least
         << " and " << greatest;
  else text << "at the nodes of a grid f is undefined";
  if (source.narrow_band) text << " within " << option_text("narrow_band") << ' ' << *source.narrow_band;
  if (search.met_poles) text << ", and crosses this value only at poles or jumps";
  text << "; choose ";
  if (!zeros.empty()) text << "another " << option_text("level") << ", or a function that crosses it";
  else if (may_help && has_both_signs) text << search.refinement;
  else
    text << (may_be_erased ? "a smaller " + option_text("smoothing") + ", which keeps thin parts, " : "")
         << (source.narrow_band ? "a wider band, " : "") << "another " << option_text("level") << " or box"
         << (may_help ? ", or " + search.refinement : "");
  throw Input_error(text.str());
}

void remove_small_fragments(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options) {
  const auto nodes = options.resolution.value_or(default_resolution(options.kind));
  if (options.transformation) remove_small_fragments(surface, fit, nodes, options.transformation->inverse());
  else remove_small_fragments(surface, fit, nodes);
}

std::size_t keep_largest(Isosurface_3<Kernel>& surface, std::size_t count, std::vector<double>& values) {
  auto components = internal::components_of(surface);
  std::map<std::uint32_t, double> areas;
  for (const auto& [a, b, c] : surface.triangles)
    areas[components.find(a)] +=
        std::sqrt(CGAL::cross_product(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a])
                      .squared_length());
  if (areas.size() <= count) return 0;
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (const auto& [component, area] : areas) sorted.emplace_back(-area, component);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = count; i < sorted.size(); ++i) areas.erase(sorted[i].second);
  const auto is_left_out = [&](std::uint32_t v) { return !areas.contains(components.find(v)); };
  std::erase_if(surface.triangles, [&](const auto& t) { return is_left_out(t[0]); });
  std::uint32_t v = 0;
  std::erase_if(values, [&](double) { return is_left_out(v++); });
  internal::remove_isolated_vertices(surface);
  return sorted.size() - count;
}

} // namespace equiaffine
