// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate_fits MESH... prints the rows of Fitted_numbers.h that are correct for the current fits, and to standard
// error the coverage of the current rows. Known surfaces are used with noise of 0 to 5 % of an edge, on coarse and fine
// grids. For each mesh, the errors at the chosen scale are estimated from two halves of its vertices.
#include "fit/Curvature_fit_3.h"
#include "fit/Fitted_data_3.h"
#include "fit/Fitted_numbers.h"
#include "fit/fit_input.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;

constexpr std::array<const char*, 4> names_of_sources = {"DETAIL", "BOTH", "NOISE", "SCALE"};
/// An error and its estimates, relative to the sizes of the numbers.
struct Sample {
  std::size_t mesh;
  internal::Number_errors error, estimate; // without the factor
};
using All_samples = std::array<std::vector<Sample>, names_of_sources.size()>;

struct Surface {
  const char* formula;
  double half_side;
};

const std::vector<Surface> surfaces = {
    {"exp(-x^2-y^2)+exp(-(x-1)^2-z^2)+exp(-y^2-z^2)-.9", 3.2},
    {"exp(-(x-.5)^2-y^2-z^2)+exp(-(x+.6)^2-(y-.4)^2-z^2)+exp(-x^2-(y+.7)^2-(z-.3)^2)-.45", 2.5},
    {"x^2+y^2/2+z^2/3-1", 2},
    {"x^4+2*y^4+z^4-x^2*y^2-1", 1.6},
    {"(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)", 1.6},
    {"x^2+y^2+z^2+.3*sin(3*x)*sin(2*y)*cos(2*z)-1", 1.6},
    {"sqrt((sqrt(x^2+y^2)-1)^2+z^2+.1*x*z)-.45", 1.8},
    {"2*y*(y^2-3*x^2)*(1-z^2)+(x^2+y^2)^2-(9*z^2-1)*(1-z^2)", 2.2},
    {"(x^2+2.25*y^2+z^2-1)^3-x^2*z^3-.1125*y^2*z^3-.02", 1.6}};

/// Compares fits with the sampled surface, for `nodes` nodes per axis and a standard deviation of `noise` times the
/// grid spacing.
void compare_with_surface(std::size_t surface, std::size_t nodes, double noise, std::mt19937& random,
                          All_samples& result) {
  constexpr std::size_t most_points = 300;
  const auto [formula, b] = surfaces[surface];
  const double edge = 2 * b / double(nodes - 1);
  const auto traits = make_analytic_traits<Kernel>(Expression_3(formula), CGAL::Bbox_3(-b, -b, -b, b, b, b));
  const auto mesh = marching_cubes(traits, {.resolution = nodes});
  std::normal_distribution<double> deviate(0, noise > 0 ? noise * edge : 1);
  const auto move = [&](double x) { return noise > 0 ? x + deviate(random) : x; };
  internal::Fit_data_3 given{internal::Fit_data_3::Kind::MESH};
  for (const auto& p : mesh.points) given.points.emplace_back(move(p.x()), move(p.y()), move(p.z()));
  for (const auto& [i, j, k] : mesh.triangles)
    given.polygons.push_back({std::uint32_t(i), std::uint32_t(j), std::uint32_t(k)});
  const Fit_options own = {.scale = 0};
  const internal::Fitted_data_3 fit(true, internal::fit_input(true, std::move(given), own).data, own);
  const internal::Data_points_3& data = fit.data();
  for (const auto i : random_subset<internal::Data_points_3::Index>(mesh.points.size(), most_points, 5)) {
    const auto& choice = fit.choices().at(data.points[i]);
    const auto here =
        choice ? internal::curvature_fit(data, i, *choice, fit.choices(), internal::Fit_use::NUMBERS) : std::nullopt;
    if (!here) continue;
    const auto source = internal::source_of_error(choice->noise / data.spacing[i]);
    result[std::size_t(source)].push_back(
        {2 * surface + (nodes > 26),
         internal::relative_difference(here->numbers, internal::Fitted_numbers(traits.taylor(mesh.points[i]))),
         here->accuracy.error / internal::calibration(source)});
  }
}

/// Compares the fits of two halves of the vertices of a mesh, as points with normals, at the twentieth of the vertices
/// that both contain.
void compare_halves(std::size_t mesh, const std::string& file, std::mt19937& random, All_samples& result) {
  constexpr std::size_t most_common = 400;
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(file, points, polygons)) throw std::runtime_error(file + " is no mesh");
  std::vector<Eigen::Vector3d> vertices, normals(points.size(), Eigen::Vector3d::Zero());
  for (const auto& p : points) vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : polygons)
    for (const auto i : polygon) normals[i] += double_area_of_polygon(vertices, polygon);

  std::vector<std::size_t> order = random_subset(points.size(), points.size(), 6);
  std::erase_if(order, [&](std::size_t i) { return !(normals[i].norm() > 0); });
  const std::size_t common = std::min(most_common, order.size() / 20);
  std::shuffle(order.begin() + std::ptrdiff_t(common), order.end(), random);
  std::array<internal::Fit_data_3, 2> given = {internal::Fit_data_3{internal::Fit_data_3::Kind::POINTS},
                                               internal::Fit_data_3{internal::Fit_data_3::Kind::POINTS}};
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t half = 0; half < 2; ++half)
      if (k < common || k % 2 == half) {
        given[half].points.push_back(vertices[order[k]]);
        given[half].normals.push_back(normals[order[k]].normalized());
      }
  Fit_options options;
  const internal::Fit_input_3 first = internal::fit_input(true, std::move(given[0]), options);
  const internal::Fitted_data_3 first_fit(true, first.data, options);
  options.scale = first_fit.scale();
  if (!options.scale) return;
  const internal::Fit_input_3 second = internal::fit_input(true, std::move(given[1]), options);
  const internal::Fitted_data_3 second_fit(true, second.data, options);
  const auto fit_at = [](const internal::Fitted_data_3& fit, internal::Data_points_3::Index i) {
    return internal::curvature_fit(fit.data(), i, *fit.choices().at(fit.data().points[i]), fit.choices(),
                                   internal::Fit_use::NUMBERS);
  };
  for (std::size_t k = 0; k < common; ++k) {
    const auto a = fit_at(first_fit, first.positions[k]), b = fit_at(second_fit, second.positions[k]);
    if (!a || !b) continue;
    const internal::Number_errors of_second = b->accuracy.error * b->numbers.sizes() / a->numbers.sizes();
    result[std::size_t(internal::Source_of_error::SCALE)].push_back(
        {mesh, internal::relative_difference(a->numbers, b->numbers),
         (a->accuracy.error.square() + of_second.square()).sqrt() /
             internal::calibration(internal::Source_of_error::SCALE)});
  }
}

struct Coverage {
  double part = 1;         ///< fraction of the errors whose estimates are known
  double low_part = 1;     ///< the second smallest fraction of all meshes
  double median_ratio = 0; ///< of estimates to errors
};

Coverage coverage(const std::vector<Sample>& samples, Eigen::Index number, double factor) {
  constexpr double known = 0.5, enough = 50; // samples of a mesh
  std::vector<double> ratios;
  std::map<std::size_t, std::array<double, 2>> counts; // of each mesh, covered ones and all
  for (const auto& [mesh, error, estimate] : samples) {
    if (!(factor * estimate[number] <= known) || !std::isfinite(error[number])) continue;
    auto& [covered, all] = counts[mesh];
    covered += error[number] <= factor * estimate[number];
    ++all;
    ratios.push_back(factor * estimate[number] / error[number]);
  }
  Coverage result;
  if (ratios.empty()) return result;
  double covered = 0;
  std::vector<double> parts;
  for (const auto& [mesh, count] : counts) {
    covered += count[0];
    if (count[1] >= enough) parts.push_back(count[0] / count[1]);
  }
  std::sort(parts.begin(), parts.end());
  if (parts.size() > 1) result.low_part = parts[1];
  result.part = covered / double(ratios.size());
  const auto median = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), median, ratios.end());
  result.median_ratio = *median;
  return result;
}

} // namespace

int main(int argc, char** argv) {
  constexpr double wanted = 0.95, wanted_on_meshes = 0.915, least = 0.9, greatest = 4, step = 0.1;
  All_samples all;
  std::mt19937 random(7);
  for (const std::size_t nodes : {26, 60})
    for (const double noise : {0., 0.001, 0.01, 0.05})
      for (std::size_t k = 0; k < surfaces.size(); ++k) compare_with_surface(k, nodes, noise, random, all);
  for (int k = 1; k < argc; ++k) compare_halves(std::size_t(k), argv[k], random, all);

  std::fputs("part covered by the present factors, the same on the mesh where it is least but one, and median of "
             "estimate over "
             "error, of K, H, J, |K_e|^(1/4), K_e, H_e, k1, k2, affine normal, normal\n",
             stderr);
  for (std::size_t source = 0; source < all.size(); ++source) {
    const internal::Number_errors present = internal::calibration(internal::Source_of_error(source));
    std::fprintf(stderr, "%s, %zu points:", names_of_sources[source], all[source].size());
    std::fputs("      {", stdout);
    for (Eigen::Index number = 0; number < internal::number_of_fitted_numbers; ++number) {
      const Coverage now = coverage(all[source], number, present[number]);
      std::fprintf(stderr, "  %.3f %.3f %.1f", now.part, now.low_part, now.median_ratio);
      double factor = least;
      for (; factor < greatest - step / 2; factor += step)
        if (const Coverage with = coverage(all[source], number, factor);
            with.part >= wanted && with.low_part >= wanted_on_meshes)
          break;
      std::printf("%s%.1f", number > 0 ? ", " : "", factor);
    }
    std::fputc('\n', stderr);
    std::printf("}, // %s\n", names_of_sources[source]);
  }
}
