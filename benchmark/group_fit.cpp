// SPDX-License-Identifier: GPL-3.0-or-later
// Affine curvatures of meshes and points by fits: accuracy, noise, coverage of the error estimates, cost, and CGAL's jet
// fitting beside it on the same data. Arguments: the folder of scripts/example-data (build/data), for the bunny.
#include "measure.h"
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/Fitted_function_traits_3.h>
#include <equiaffine/Local_structure_3.h>
#include <equiaffine/attributes.h>
#include <equiaffine/delaunay_surface.h>
#include <equiaffine/fitted_structures.h>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Exact = Analytic_function_traits_3<Kernel, Expression_3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Structures = std::vector<Fitted_structure_3<double>>;

struct Surface {
  std::string name, formula;
  CGAL::Bbox_3 box;
};

const Surface meta = {"meta",
                      "0.6 - exp(-4*((x-.45)^2+y^2+z^2)) - exp(-4*((x+.45)^2+(y-.2)^2+z^2))"
                      " - exp(-4*(x^2+(y+.35)^2+(z-.45)^2)) - exp(-4*((x-.1)^2+(y-.45)^2+(z+.35)^2))",
                      {-1.6, -1.6, -1.6, 1.6, 1.6, 1.6}};
const Surface blobby = {
    "blobby", "(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*(x^2+y^2+z^2) + 6", {-1.2, -1.2, -1.2, 1.2, 1.2, 1.2}};
const Surface torus = {"torus", "(sqrt(x^2+y^2)-2)^2 + z^2 - 0.49", {-3, -3, -1, 3, 3, 1}};
const Surface sine = {"sine", "z - sin(3*x)*sin(2.5*y)/2", {-1.5, -1.5, -1, 1.5, 1.5, 1}};

/// Vertices on the surface, irregularly triangulated.
struct Samples {
  Exact surface;
  std::vector<Point_3> points;
  Triangles triangles;
  double edge = 0; ///< the mean length
};

/// The radius of the mesher's triangles is changed until there are as many vertices as wanted, to within 5 %.
Samples sample(const Surface& s, double count) {
  const Exact exact(Expression_3(s.formula), s.box);
  double radius = 0.03;
  for (;;) {
    const auto mesh = delaunay_surface(exact, {30, radius, 1});
    const double vertices = double(mesh.points.size());
    if (std::abs(vertices / count - 1) > 0.05) {
      radius *= std::sqrt(vertices / count);
      continue;
    }
    Samples samples{exact, mesh.points, mesh.triangles};
    for (const auto& t : samples.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        samples.edge += std::sqrt(CGAL::squared_distance(samples.points[t[k]], samples.points[t[(k + 1) % 3]])) /
                        (3 * double(samples.triangles.size()));
    return samples;
  }
}

/// Moves points by normal deviates along each axis.
std::vector<Point_3> disturbed(const Samples& samples, double part_of_edge) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, part_of_edge * samples.edge);
  std::vector<Point_3> points;
  for (const auto& p : samples.points) {
    const double x = normal(random), y = normal(random), z = normal(random);
    points.emplace_back(p.x() + x, p.y() + y, p.z() + z);
  }
  return points;
}

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values.at(std::size_t(part * double(values.size() - 1)));
}

template <class S>
double size_of(const S& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
}

struct Errors {
  std::vector<double> relative, at_border, inside;
  double covered = 0, trusted = 0, wrong = 0;
};

/// Errors of K relative to |K| + H^2, where |K_e| > 0.2; near the border means nearer than a tenth of the width of `box`.
Errors errors_of(const Samples& samples, const Structures& fits, const CGAL::Bbox_3& box, bool has_border) {
  Errors errors;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Point_3& p = samples.points[i];
    const auto truth = local_structure_at(samples.surface, p);
    if (!(std::abs(truth.euclidean.gaussian_curvature) > 0.2)) continue;
    const double error =
        std::abs(fits[i].structure.affine.gaussian_curvature - truth.affine.gaussian_curvature) / size_of(truth);
    const double known = std::isfinite(error) ? error : 1e300;
    errors.relative.push_back(known);
    const double distance = std::min({p.x() - box.xmin(), box.xmax() - p.x(), p.y() - box.ymin(), box.ymax() - p.y()});
    if (has_border) (distance < 0.05 * (box.xmax() - box.xmin()) ? errors.at_border : errors.inside).push_back(known);
    errors.covered += known * size_of(truth) <= fits[i].error.gaussian_curvature;
    if (fits[i].error.gaussian_curvature > 0.1 * size_of(fits[i].structure)) continue;
    ++errors.trusted;
    errors.wrong += known > 0.1;
  }
  return errors;
}

struct Case {
  const Surface& surface;
  double count, noise;
  const char *target, *target_95;
};

void accuracy() {
  const std::vector<Case> cases = {{meta, 2000, 0, "<=0.02", "<=0.2"},     {meta, 10000, 0, "<=1e-4", "<=1e-3"},
                                   {meta, 40000, 0, "<=2e-6", "<=2e-5"},   {blobby, 10000, 0, "<=0.02", "none"},
                                   {blobby, 40000, 0, "<=5e-4", "none"},   {torus, 10000, 0, "<=0.01", "none"},
                                   {sine, 10000, 0, "none", "none"},       {meta, 10000, 0.001, "<=0.02", "none"},
                                   {meta, 10000, 0.01, "<=0.04", "<=0.2"}, {meta, 10000, 0.05, "<=0.08", "none"},
                                   {sine, 10000, 0.01, "<=0.05", "none"},  {torus, 10000, 0.01, "none", "none"}};
  std::vector<double> exact_meta;
  for (const auto& c : cases) {
    const Samples samples = sample(c.surface, c.count);
    const auto points = disturbed(samples, c.noise);
    const std::string name = "fit_" + c.surface.name + "_" + std::to_string(int(c.count / 1000)) + "k_noise_" +
                             std::to_string(c.noise).substr(0, 5);
    const double begin = processor_clock();
    const Structures fits = fitted_structures(points, samples.triangles);
    figure(name + "_seconds", processor_clock() - begin, "s", c.count == 40000 ? "<=30" : "none");
    const bool has_border = c.surface.name == "sine";
    const Errors errors = errors_of(samples, fits, c.surface.box, has_border);
    const double median_error = quantile(errors.relative, 0.5);
    figure(name + "_K", median_error, "relative", c.target);
    figure(name + "_K_95", quantile(errors.relative, 0.95), "relative", c.target_95);
    figure(name + "_covered", errors.covered / double(errors.relative.size()), "part", ">=0.93");
    if (errors.trusted > 0) figure(name + "_trusted_but_wrong", errors.wrong / errors.trusted, "part", "<=0.03");
    if (has_border)
      figure(name + "_border_over_inside", quantile(errors.at_border, 0.5) / quantile(errors.inside, 0.5), "ratio",
             "<=4");
    const Errors of_points = errors_of(samples, fitted_structures(points), c.surface.box, false);
    figure(name + "_points_over_mesh", quantile(of_points.relative, 0.5) / median_error, "ratio", "<=1.2");
    if (&c.surface == &meta && c.noise == 0) exact_meta.push_back(median_error);
  }
  figure("fit_meta_order_in_h", std::log2(exact_meta[1] / exact_meta[2]), "order", ">=5");
}

/// K by CGAL's jet fitting of degree 6 to the 42 nearest points, and by our fits at the same points.
void beside_jet_fitting() {
  using Jet_fitting = CGAL::Monge_via_jet_fitting<Kernel>;
  const Samples samples = sample(meta, 10000);
  for (const double noise : {0., 0.01}) {
    const auto points = disturbed(samples, noise);
    std::vector<Eigen::Vector3d> coordinates;
    for (const auto& p : points) coordinates.push_back(internal::coordinates_of(p));
    const internal::Point_tree_3 tree(coordinates);
    std::vector<double> errors;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto truth = local_structure_at(samples.surface, samples.points[i]);
      if (!(std::abs(truth.euclidean.gaussian_curvature) > 0.2)) continue;
      std::vector<Point_3> nearest = {points[i]};
      for (const auto j : tree.nearest(coordinates[i], 42))
        if (j != i) nearest.push_back(points[j]);
      Jet_fitting fitting;
      const auto form = fitting(nearest.begin(), nearest.end(), 6, 4);
      Jet_3<double> jet(0.); // of w - g(u, v), the Monge form
      const auto set = [&](int a, int b, double derivative) {
        constexpr std::array<double, 5> factorial = {1, 1, 2, 6, 24};
        jet.coefficients()[std::size_t(Jet_3<double>::index(a, b, 0))] =
            -derivative / (factorial[std::size_t(a)] * factorial[std::size_t(b)]);
      };
      jet.coefficients()[3] = 1;
      set(2, 0, form.principal_curvatures(0));
      set(0, 2, form.principal_curvatures(1));
      for (int b = 0; b <= 3; ++b) set(3 - b, b, form.third_order_coefficients(std::size_t(b)));
      for (int b = 0; b <= 4; ++b) set(4 - b, b, form.fourth_order_coefficients(std::size_t(b)));
      const double error =
          std::abs(local_structure(jet).affine.gaussian_curvature - truth.affine.gaussian_curvature) / size_of(truth);
      errors.push_back(std::isfinite(error) ? error : 1e300);
    }
    const Errors ours = errors_of(samples, fitted_structures(points, samples.triangles), meta.box, false);
    figure("fit_jet_fitting_over_ours_noise_" + std::to_string(noise).substr(0, 4),
           quantile(errors, 0.5) / quantile(ours.relative, 0.5), "ratio_of_errors", ">1");
  }
}

void cost() {
  const Samples samples = sample(meta, 40000);
  for (const double noise : {0., 0.01}) {
    const auto points = disturbed(samples, noise);
    const std::string name = noise > 0 ? "noisy" : "exact";
    const auto times = compare(
        wall_clock, 3, [&] { fitted_structures<CGAL::Sequential_tag>(points, samples.triangles); },
        [&] { fitted_structures<CGAL::Parallel_tag>(points, samples.triangles); });
    figure("fit_40k_" + name + "_one_thread", times.a, "s", noise > 0 ? "<=120" : "<=30");
    figure("fit_40k_" + name + "_two_threads_speedup", times.ratio, "ratio", ">=1.8");
    const Fitted_function_traits_3<Kernel> blend(points);
    double sum = 0;
    const double begin = processor_clock();
    for (std::size_t i = 0; i < points.size(); i += 4) sum += blend.value(points[i]);
    const double values = processor_clock();
    for (std::size_t i = 0; i < points.size(); i += 4) sum += blend.taylor(points[i]).value();
    const double end = processor_clock(), count = double(points.size()) / 4;
    figure("fit_40k_" + name + "_microseconds_per_value", 1e6 * (values - begin) / count, "us", "<=5");
    figure("fit_40k_" + name + "_microseconds_per_jet", 1e6 * (end - values) / count, std::isnan(sum) ? "NaN" : "us",
           "<=40");
  }
}

void bunny(const std::string& folder) {
  CGAL::Surface_mesh<Point_3> mesh;
  if (!CGAL::IO::read_OFF(folder + "/meshes/bunny00.off", mesh)) return;
  double edge = 0;
  for (const auto e : mesh.edges())
    edge += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))) /
            double(mesh.number_of_edges());
  const auto at_scale = parameters::scale(22 * edge);
  const double begin = processor_clock();
  const Structures fits = fitted_structures(mesh, at_scale);
  figure("fit_bunny_seconds", processor_clock() - begin, "s", "<=120");
  double known = 0;
  for (const auto& f : fits) known += f.noise.gaussian_curvature <= 0.2 * size_of(f.structure);
  figure("fit_bunny_2sd_below_20_percent", known / double(fits.size()), "part", ">=0.5");

  // Of each of two disjoint halves a structure belongs to the places of all vertices: to a vertex of the other half that
  // of its nearest neighbor.
  std::mt19937 random(99);
  std::array<std::vector<Point_3>, 2> halves;
  for (const auto v : mesh.vertices()) halves[random() & 1].push_back(mesh.point(v));
  std::vector<Eigen::Vector3d> coordinates;
  for (const auto& p : halves[1]) coordinates.push_back(internal::coordinates_of(p));
  const internal::Point_tree_3 tree(coordinates);
  const Structures first = fitted_structures(halves[0], at_scale), second = fitted_structures(halves[1], at_scale);
  std::vector<double> differences;
  double agree = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto& other = second[tree.nearest(internal::coordinates_of(halves[0][i]), 1).front()];
    const double difference =
        std::abs(first[i].structure.affine.gaussian_curvature - other.structure.affine.gaussian_curvature);
    if (!std::isfinite(difference)) continue;
    differences.push_back(difference / (0.5 * (size_of(first[i].structure) + size_of(other.structure))));
    agree += difference <= std::hypot(first[i].noise.gaussian_curvature, other.noise.gaussian_curvature);
  }
  figure("fit_bunny_halves_differ", quantile(differences, 0.5), "relative", "<=0.15");
  figure("fit_bunny_halves_agree_within_2sd", agree / double(differences.size()), "part", ">=0.95");
}

} // namespace

int main(int argc, char** argv) {
  accuracy();
  beside_jet_fitting();
  cost();
  bunny(argc > 1 ? argv[1] : "build/data");
}
