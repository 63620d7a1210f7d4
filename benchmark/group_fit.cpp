// SPDX-License-Identifier: GPL-3.0-or-later
// Curvatures of meshes and points by fits: accuracy, noise, coverage of the error estimates, cost, scans, and a
// comparison with other libraries on the same data. Usage: benchmark_fit [part] [folder of data], where part is all,
// accuracy, peers, cost or scans.
#include "fit_samples.h"
#include "measure.h"
#include "peers/curvature_peers.h"
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <functional>
#include <limits>

namespace {

using namespace fit_samples;

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
    const Structures fits = fitted_structures(points, samples.triangles, {.scale = 0});
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
    const Errors of_points = errors_of(samples, fitted_structures(points, {.scale = 0}), c.surface.box, false);
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
    for (const auto& p : points) coordinates.push_back(coordinates_of(p));
    const Point_tree<3> tree(coordinates);
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
    const Errors ours = errors_of(samples, fitted_structures(points, samples.triangles, {.scale = 0}), meta.box, false);
    figure("fit_jet_fitting_over_ours_noise_" + std::to_string(noise).substr(0, 4),
           quantile(errors, 0.5) / quantile(ours.relative, 0.5), "ratio_of_errors", ">1");
  }
}

void cost() {
  const Samples samples = sample(meta, 40000);
  for (const double noise : {0., 0.01}) {
    const auto points = disturbed(samples, noise);
    const std::string name = noise > 0 ? "noisy" : "exact";
    const auto times = compare_threads(
        3, [&] { fitted_structures<CGAL::Sequential_tag>(points, samples.triangles, {.scale = 0}); },
        [&] { fitted_structures<CGAL::Parallel_tag>(points, samples.triangles, {.scale = 0}); });
    figure("fit_40k_" + name + "_one_thread", times.a, "s", noise > 0 ? "<=120" : "<=30");
    figure("fit_40k_" + name + "_two_threads_speedup", times.ratio, "ratio", ">=1.8");
    const Fitted_function_traits_3<Kernel> blend(points, {.scale = 0});
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

/// H_e and K_e, compared with other libraries. Their radii and degrees are chosen to minimize the true error, which a
/// user does not know.
void beside_euclidean_peers() {
  const Samples samples = sample(meta, 10000);
  for (const double noise : {0., 0.01}) {
    const auto points = disturbed(samples, noise);
    Plain_mesh mesh{{}, samples.triangles};
    for (const auto& p : points) mesh.points.push_back({p.x(), p.y(), p.z()});
    Euclidean_curvatures ours;
    for (const auto& fit : fitted_structures(points, samples.triangles, {.scale = 0})) {
      ours.mean.push_back(fit.structure.euclidean.mean_curvature);
      ours.gaussian.push_back(fit.structure.euclidean.gaussian_curvature);
    }
    const Euclidean_errors of_ours = euclidean_errors(samples, ours);
    const std::string with_noise = "_noise_" + std::to_string(noise).substr(0, 4);
    const auto beside = [&](const std::string& peer, const std::vector<std::function<Euclidean_curvatures()>>& ways) {
      Euclidean_errors best{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
      for (const auto& way : ways) {
        const Euclidean_errors errors = euclidean_errors(samples, way());
        best = {std::min(best.mean, errors.mean), std::min(best.gaussian, errors.gaussian)};
      }
      figure("fit_" + peer + with_noise + "_H_e_over_ours", best.mean / of_ours.mean, "ratio_of_errors", ">1");
      figure("fit_" + peer + with_noise + "_K_e_over_ours", best.gaussian / of_ours.gaussian, "ratio_of_errors", ">1");
    };
    figure("fit_ours" + with_noise + "_H_e", of_ours.mean, "relative", "none");
    figure("fit_ours" + with_noise + "_K_e", of_ours.gaussian, "relative", "none");
#ifdef EQUIAFFINE_HAS_CGAL_6
    std::vector<std::function<Euclidean_curvatures()>> balls;
    for (const double edges : {0., 2., 4., 8.})
      balls.push_back([&, edges] { return corrected_curvatures(mesh, edges * samples.edge); });
    beside("corrected_curvatures", balls);
#endif
#ifdef EQUIAFFINE_HAS_PCL
    std::vector<std::function<Euclidean_curvatures()>> polynomials;
    for (const double edges : {3., 5., 8., 12.})
      for (const int degree : {2, 4})
        polynomials.push_back([&, edges, degree] { return moving_least_squares(mesh, edges * samples.edge, degree); });
    beside("moving_least_squares", polynomials);
#endif
  }
}

struct Scan {
  std::string name;
  const char *seconds, *known, *differ, *agree; ///< targets
};

/// Two halves of the vertices in which neighbors alternate as far as possible. Random halves would have gaps and
/// clusters, whose effect on the detail of a scan is not noise.
std::array<std::vector<Point_3>, 2> alternating_halves(const CGAL::Surface_mesh<Point_3>& mesh) {
  std::array<std::vector<Point_3>, 2> halves;
  std::vector<int> half_of(mesh.num_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    std::array<int, 2> neighbors = {0, 0};
    for (const auto w : CGAL::vertices_around_target(v, mesh))
      if (half_of[w] >= 0) ++neighbors[std::size_t(half_of[w])];
    half_of[v] = neighbors[0] == neighbors[1] ? int(v.idx() & 1) : neighbors[1] < neighbors[0];
    halves[std::size_t(half_of[v])].push_back(mesh.point(v));
  }
  return halves;
}

/// The fraction of known curvatures at a scale of 22 edges, or of a quarter of the size if that is less, and the
/// agreement between fits of two halves of the vertices.
void scan(const Scan& scan, const std::string& folder) {
  CGAL::Surface_mesh<Point_3> mesh;
  if (!CGAL::IO::read_OFF(folder + "/meshes/" + scan.name + ".off", mesh)) return;
  double edge = 0;
  for (const auto e : mesh.edges())
    edge += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))) /
            double(mesh.number_of_edges());
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  const Fit_options at_scale = {.scale = std::min(22 * edge, diagonal / 4)};
  const std::string name = "fit_" + scan.name;
  figure(name + "_vertices", double(mesh.number_of_vertices()), "vertices", "none");
  const double begin = processor_clock();
  const Structures fits = fitted_structures(mesh, at_scale);
  figure(name + "_seconds", processor_clock() - begin, "s", scan.seconds);
  double known = 0;
  for (const auto& f : fits) known += f.noise.affine_gaussian_curvature <= 0.2 * size_of(f.structure);
  figure(name + "_2sd_below_20_percent", known / double(fits.size()), "part", scan.known);

  // Compare the fits of the halves at the same points, 300 vertices that both contain: between neighboring vertices, K
  // at this scale differs by more.
  std::array<std::vector<Point_3>, 2> halves = alternating_halves(mesh);
  constexpr std::size_t count = 300;
  const std::size_t own = halves[1].size();
  for (std::size_t k = 0; k < count; ++k) halves[1].push_back(halves[0][k * halves[0].size() / count]);
  const Structures first = fitted_structures(halves[0], at_scale), second = fitted_structures(halves[1], at_scale);
  std::vector<double> differences;
  double agree = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto &one = first[k * halves[0].size() / count], &other = second[own + k];
    const double difference =
        std::abs(one.structure.affine.gaussian_curvature - other.structure.affine.gaussian_curvature);
    if (!std::isfinite(difference)) continue;
    differences.push_back(difference / (0.5 * (size_of(one.structure) + size_of(other.structure))));
    agree += difference <= std::hypot(one.noise.affine_gaussian_curvature, other.noise.affine_gaussian_curvature);
  }
  if (differences.empty()) return;
  figure(name + "_halves_differ", quantile(differences, 0.5), "relative", scan.differ);
  figure(name + "_halves_agree_within_2sd", agree / double(differences.size()), "part", scan.agree);
}

} // namespace

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "all", folder = argc > 2 ? argv[2] : "build/data";
  const auto is_asked_for = [&](const char* name) { return part == "all" || part == name; };
  if (is_asked_for("accuracy")) accuracy();
  if (is_asked_for("peers")) {
    beside_jet_fitting();
    beside_euclidean_peers();
  }
  if (is_asked_for("cost")) cost();
  if (!is_asked_for("scans")) return 0;
  scan({"bunny00", "<=120", ">=0.5", "<=0.15", ">=0.95"}, folder);
  for (const char* name : {"elephant", "armadillo", "femur"}) scan({name, "none", "none", "none", "none"}, folder);
}
