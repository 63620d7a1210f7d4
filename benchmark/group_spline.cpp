// SPDX-License-Identifier: GPL-3.0-or-later
// Affine curvatures of sampled functions: accuracy and its order, noise and error estimates, cost compared with Teem
// and ITK, real data. Arguments: the folder of scripts/example-data (build/data), an SVG file for the plot (none), and
// one of cost, noise, figure_10, real_data, accuracy (all).
#include "measure.h"
#include "peers/spline_peers.h"
#include "runner.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/project_to_surface.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/signed_distance_volume.h>

#include <CGAL/Image_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using benchmark_runner::keep;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Exact = Analytic_function_traits_3<Kernel, Expression_3>;
using Sampled = Sampled_function_traits_3<Kernel>;
using Volume = Volume_3<Kernel>;
using Parallel = CGAL::Parallel_if_available_tag;

struct Variant {
  std::string name;
  int degree;
  Spline_scheme scheme;
};
const std::vector<Variant> variants = {{"paper", 5, Spline_scheme::PAPER},
                                       {"convolution 5", 5, Spline_scheme::CONVOLUTION},
                                       {"quasi-interpolation 5", 5, Spline_scheme::QUASI_INTERPOLATION},
                                       {"interpolation 7", 7, Spline_scheme::INTERPOLATION},
                                       {"quasi-interpolation 7", 7, Spline_scheme::QUASI_INTERPOLATION},
                                       {"interpolation 9", 9, Spline_scheme::INTERPOLATION},
                                       {"quasi-interpolation 9", 9, Spline_scheme::QUASI_INTERPOLATION}};
const Variant& paper = variants[0];
const Variant& usual = variants[4];

struct Surface {
  std::string name;
  Exact function;
};

/// analytic_functions::Metaballs, as a formula.
std::string metaballs() {
  const analytic_functions::Metaballs balls;
  std::string text = "0.4";
  for (const auto& [x, y, z] : balls.centers) {
    std::array<char, 120> ball{};
    std::snprintf(ball.data(), ball.size(), " - exp(-4*((x-(%g))^2 + (y-(%g))^2 + (z-(%g))^2))", x, y, z);
    text += ball.data();
  }
  return text;
}

Surface surface(const std::string& name, const std::string& text, double x, double y, double z) {
  return {name, Exact(Expression_3(text), CGAL::Bbox_3(-x, -y, -z, x, y, z))};
}

std::vector<Surface> surfaces() {
  return {surface("ellipsoid", "exp(x^2 + y^2/0.64 + z^2/0.36 - 1) - 1", 1.25, 1, 0.75),
          surface("torus", "(sqrt(x^2 + y^2) - 0.5)^2 + z^2 - 0.04", 0.75, 0.75, 0.25),
          {"sine", Exact(Expression_3("2*z^2 - sin(5*x + 3*y^2 - 1)"), CGAL::Bbox_3(-1.1, -1.1, -2, 1, 1.2, 2))},
          surface("metaballs", metaballs(), 1.5, 1.5, 1.5),
          surface("sphere_distance", "sqrt(x^2 + y^2 + z^2) - 1", 1.25, 1.25, 1.25)};
}

/// Every n-th element, about 20,000 in all.
std::vector<Point_3> part_of(const std::vector<Point_3>& points) {
  std::vector<Point_3> part;
  for (std::size_t i = 0; i < points.size(); i += points.size() / 20000 + 1) part.push_back(points[i]);
  return part;
}

/// Vertices of the surface computed by a variant.
std::vector<Point_3> vertices(const Sampled& sampled, const Variant& variant, double isovalue = 0) {
  const Level_set_traits_3 level_set(sampled, isovalue);
  const auto position = variant.scheme == Spline_scheme::PAPER ? Vertex_position::LINEAR : Vertex_position::PROJECTED;
  return part_of(marching_cubes<Parallel>(level_set, {.vertices = position}).points);
}

double scale_of(double gaussian, double mean) { return std::abs(gaussian) + mean * mean; }

/// Relative errors at points of a surface with |K_e| > 0.2: of K in units of |K| + H^2, of H in units of its square
/// root.
struct Errors {
  std::vector<double> gaussian, mean;
  double median_gaussian, p95_gaussian, median_mean;
};

template <class Function>
Errors errors_at(const std::vector<Point_3>& points, const Sampled& sampled, const Function& exact) {
  Errors errors;
  for (const Point_3& p : points) {
    const auto on_surface = project_to_surface(exact, p, 0.2);
    if (!on_surface.has_converged) continue;
    const auto reference = local_structure(exact.taylor(on_surface.point));
    if (!(std::abs(reference.euclidean.gaussian_curvature) > 0.2)) continue;
    const auto s = affine_invariants(Monge_chart_3<double>(sampled.taylor(p)));
    const double scale = scale_of(reference.affine.gaussian_curvature, reference.affine.mean_curvature);
    const double gaussian = std::abs(s.gaussian_curvature - reference.affine.gaussian_curvature) / scale;
    const double mean = std::abs(s.mean_curvature - reference.affine.mean_curvature) / std::sqrt(scale);
    errors.gaussian.push_back(std::isfinite(gaussian) ? gaussian : std::numeric_limits<double>::infinity());
    errors.mean.push_back(std::isfinite(mean) ? mean : std::numeric_limits<double>::infinity());
  }
  std::sort(errors.gaussian.begin(), errors.gaussian.end());
  std::sort(errors.mean.begin(), errors.mean.end());
  errors.median_gaussian = errors.gaussian[errors.gaussian.size() / 2];
  errors.p95_gaussian = errors.gaussian[errors.gaussian.size() * 95 / 100];
  errors.median_mean = errors.mean[errors.mean.size() / 2];
  return errors;
}

/// The least-squares slope of log(error) over log(h), for the leading points above the rounding floor.
std::optional<double> order(const std::vector<double>& h, const std::vector<double>& error, std::size_t first) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = first; i < h.size(); ++i) {
    if (!(error[i] > 10 * std::numeric_limits<double>::epsilon() / std::pow(h[i], 4))) continue;
    const double u = std::log(h[i]), v = std::log(error[i]);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  if (n < 2) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

/// One curve of the plot: medians over N.
struct Curve {
  std::string surface, variant;
  std::vector<double> error;
};
const std::vector<std::size_t> resolutions = {32, 40, 64, 128, 256}; // the first for the order of degree 9

/// A panel per surface, log-log.
void plot(const std::string& path, const std::vector<Curve>& curves) {
  const std::array colors = {"#888888", "#bb5566", "#ddaa33", "#66ccee", "#004488", "#99cc66", "#117733"};
  std::ofstream svg(path);
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='1280' height='330' font-family='sans-serif' font-size='12'>\n"
         "<rect width='1280' height='330' fill='white'/>\n";
  const auto x_of = [](double n) { return 50 + 150 * std::log2(n / 40) / std::log2(256. / 40); };
  const auto y_of = [](double e) { return 40 - 20 * std::log10(std::clamp(e, 1e-12, 1.)); };
  std::map<std::string, int> panel, color;
  for (const Curve& c : curves) {
    const bool is_new = panel.emplace(c.surface, int(panel.size())).second;
    color.emplace(c.variant, int(color.size()));
    svg << "<g transform='translate(" << 212 * panel[c.surface] << ",0)'>\n";
    if (is_new) {
      svg << "<text x='60' y='25'>" << c.surface << "</text><path d='M50 40V280H200' fill='none' stroke='black'/>\n";
      for (int e = 0; e <= 12; e += 2)
        svg << "<text x='10' y='" << 44 + 20 * e << "'>1e-" << e << "</text><path d='M47 " << 40 + 20 * e
            << "H200' stroke='#dddddd'/>\n";
      for (const std::size_t n : {40, 64, 128, 256})
        svg << "<text x='" << x_of(double(n)) - 8 << "' y='295'>" << n << "</text>\n";
    }
    svg << "<polyline fill='none' stroke-width='2' stroke='" << colors[std::size_t(color[c.variant])] << "' points='";
    for (std::size_t i = 1; i < c.error.size(); ++i)
      svg << x_of(double(resolutions[i])) << ',' << y_of(c.error[i]) << ' ';
    svg << "'/>\n</g>\n";
  }
  for (const auto& [name, n] : color)
    svg << "<text x='" << 50 + 175 * n << "' y='320' fill='" << colors[std::size_t(n)] << "'>" << name << "</text>\n";
  svg << "</svg>\n";
}

void accuracy(const std::string& plot_path) {
  std::printf("Median (95 %%) relative error of K at the vertices\n");
  std::vector<Curve> curves;
  for (const Surface& s : surfaces()) {
    std::vector<double> h;
    std::vector<std::vector<double>> medians(variants.size());
    double worst_tail = 0;
    for (const std::size_t n : resolutions) {
      const Lattice_3<Kernel> lattice({n, n, n}, s.function.bbox());
      const Volume volume = sample_on_lattice<Parallel>(s.function, lattice);
      h.push_back(std::sqrt(lattice.steps()[0].squared_length()));
      std::printf("  %-16s N = %3zu", s.name.c_str(), n);
      for (std::size_t v = 0; v < variants.size(); ++v) {
        const Sampled sampled(volume, {.spline_scheme = variants[v].scheme, .spline_degree = variants[v].degree});
        const Errors e = errors_at(vertices(sampled, variants[v]), sampled, s.function);
        medians[v].push_back(e.median_gaussian);
        std::printf(" | %.1e (%.0e)", e.median_gaussian, e.p95_gaussian);
        if (&variants[v] == &usual && n >= 64) worst_tail = std::max(worst_tail, e.p95_gaussian / e.median_gaussian);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
    const auto order_figure = [&](const std::string& name, std::size_t v, const std::string& target) {
      if (const auto slope = order(h, medians[v], v == 6 ? 0 : 1))
        figure("spline_order_" + name + "_" + s.name, *slope, "1", target);
    };
    order_figure("default", 4, ">=3.8");
    order_figure("degree_9", 6, ">=5.5");
    order_figure("paper", 0, "<=2.5");
    if (s.name != "sine" && s.name != "sphere_distance")
      figure("spline_error_128_" + s.name, medians[4][3], "relative", "<=1e-6");
    figure("spline_p95_over_median_" + s.name, worst_tail, "1", "<=100");
    for (std::size_t v = 0; v < variants.size(); ++v) curves.push_back({s.name, variants[v].name, medians[v]});
  }
  if (!plot_path.empty()) plot(plot_path, curves);
}

/// Figure 10 of the paper: the unit sphere, before and after the matrix of its figure 8; errors of K and H in per cent.
void figure_10() {
  std::printf("Figure 10: sphere, mean relative error in %% of K, H; before | after the matrix (paper: K 0.6 to 0.04, "
              "H 0.1 to 0.0007)\n");
  const Exact sphere(Expression_3("x^2 + y^2 + z^2 - 1"), CGAL::Bbox_3(-1.25, -1.25, -1.25, 1.25, 1.25, 1.25));
  const CGAL::Aff_transformation_3<Kernel> map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6);
  const Transformed_function_traits_3 image(sphere, map);
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double x : values) sum += x;
    return 100 * sum / double(values.size());
  };
  for (const Variant* v : {&paper, &usual})
    for (const std::size_t n : {40, 64, 128, 256}) {
      const auto row = [&](const auto& function) {
        const Sampled sampled(sample_on_lattice<Parallel>(function, Lattice_3<Kernel>({n, n, n}, function.bbox())),
                              {.spline_scheme = v->scheme, .spline_degree = v->degree});
        const Errors e = errors_at(vertices(sampled, *v), sampled, function);
        std::printf(" | %.2g, %.2g", 2 * mean(e.gaussian), std::sqrt(2) * mean(e.mean)); // K = H^2: the scale is 2 K
        return 2 * mean(e.gaussian);
      };
      std::printf("  %-22s N = %3zu", v->name.c_str(), n);
      const double before = row(sphere), after = row(image);
      std::printf("\n");
      if (n != 256) continue;
      const std::string name = v == &paper ? "spline_sphere_256_paper" : "spline_sphere_256_default";
      figure(name, before, "%", "<=0.04");
      figure(name + "_mapped", after, "%", "<=0.04");
    }
}

void noise() {
  std::printf("Noise: ellipsoid, N = 128\n");
  const Surface s = surfaces()[0];
  const Lattice_3<Kernel> lattice({128, 128, 128}, s.function.bbox());
  const Volume clean = sample_on_lattice<Parallel>(s.function, lattice);
  for (const auto& [name, deviation, target] :
       {std::tuple{"float32", 0., "<=1e-4"}, {"sigma_1e-6", 1e-6, "<=5e-3"}, {"sigma_1e-4", 1e-4, "<=5e-2"}}) {
    Volume volume = clean;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (double& x : volume.values) x = deviation == 0 ? double(float(x)) : x + deviation * normal(random);
    const Sample_noise measured = estimate_noise(volume, std::optional(0.));
    const double smoothing = choose_smoothing(volume, measured, {.level = 0});
    const Sampled sampled(smooth_volume(volume, smoothing));
    const auto points = vertices(sampled, usual);
    const Errors e = errors_at(points, sampled, s.function);
    const Errors paper_errors = [&] {
      const Sampled convolved(volume, {.spline_scheme = paper.scheme, .spline_degree = paper.degree});
      return errors_at(vertices(convolved, paper), convolved, s.function);
    }();
    std::printf("  %-10s measured %.2g, scale %g: K %.1e (%.0e), H %.1e; paper K %.1e\n", name, measured.deviation,
                smoothing, e.median_gaussian, e.p95_gaussian, e.median_mean, paper_errors.median_gaussian);
    figure(std::string("spline_noise_") + name, e.median_gaussian, "relative", target);
    const Curvature_error_3<Kernel> estimate(sampled, volume, smoothing, measured.deviation);
    std::vector<double> ratios;
    for (const Point_3& p : points) {
      const auto on_surface = project_to_surface(s.function, p, 0.2);
      const auto reference = local_structure(s.function.taylor(on_surface.point));
      const auto c = affine_invariants(Monge_chart_3<double>(sampled.taylor(p)));
      ratios.push_back(estimate(p).affine_gaussian_curvature /
                       std::abs(c.gaussian_curvature - reference.affine.gaussian_curvature));
    }
    const auto covered = std::count_if(ratios.begin(), ratios.end(), [](double r) { return r >= 1; });
    figure(std::string("spline_estimate_covers_") + name, double(covered) / double(ratios.size()), "1", ">=0.9");
    figure(std::string("spline_estimate_over_error_") + name, median(ratios), "1", "<=10");
  }
}

void cost() {
  std::printf("Cost per point, 128^3 nodes\n");
  constexpr std::size_t n = 128;
  const Lattice_3<Kernel> lattice({n, n, n}, Point_3(0, 0, 0), {Kernel::Vector_3(1, 0, 0), {0, 1, 0}, {0, 0, 1}});
  const Exact sphere(Expression_3("(x-63.5)^2 + (y-63.5)^2 + (z-63.5)^2 - 2500"), lattice.bbox());
  const Volume volume = sample_on_lattice<Parallel>(sphere, lattice);
  Lattice_points in_order, random_order;
  const auto surface_points = marching_cubes<Parallel>(Level_set_traits_3(Sampled(volume), 0.)).points;
  for (std::size_t i = 0; i < 20000; ++i) { // a run of neighbors
    const Point_3& p = surface_points[surface_points.size() / 3 + i];
    in_order.push_back({p.x(), p.y(), p.z()});
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(4, n - 5);
  for (std::size_t i = 0; i < 20000; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    random_order.push_back({x, y, z});
  }
  const auto ours = [&](int degree) -> Spline_evaluation {
    return [spline = std::make_shared<Spline_function_3<Kernel>>(volume, Volume_options{.spline_degree = degree})](
               const Lattice_points& points) {
      for (const auto& [x, y, z] : points) keep(spline->taylor(Point_3(x, y, z)));
      return 0.;
    };
  };
  std::vector<std::pair<std::string, Spline_evaluation>> evaluations = {
      {"degree 5, all 35", ours(5)}, {"degree 7, all 35", ours(7)}, {"degree 9, all 35", ours(9)}};
  evaluations.emplace_back("ITK degree 5, value and gradient", itk_spline(volume.values, n));
#ifdef EQUIAFFINE_HAS_TEEM
  evaluations.emplace_back("gage degree 5, value, gradient, Hessian", gage_spline(volume.values, n));
#endif
  for (const auto* points : {&in_order, &random_order}) {
    const std::string kind = points == &in_order ? "" : "_random";
    std::printf("%s points\n", points == &in_order ? "Neighboring" : "Random");
    std::vector<benchmark_runner::Contender> contenders;
    for (const auto& [name, evaluate] : evaluations)
      contenders.push_back({name, [&evaluate = evaluate, points] { keep(evaluate(*points)); }, double(points->size())});
    benchmark_runner::race(contenders, 7);
    const auto time = [&](std::size_t i) { return contenders[i].nanoseconds; };
    figure("spline_degree_5_over_itk" + kind, time(0) / time(3), "1", "<=0.2");
#ifdef EQUIAFFINE_HAS_TEEM
    figure("spline_degree_5_over_gage" + kind, time(0) / time(4), "1", "<=0.5");
    figure("spline_degree_7_over_gage" + kind, time(1) / time(4), "1", "<=1");
#endif
  }
}

/// The fraction of vertices with estimated errors of at most a tenth of |K| + H^2.
double trusted(const Volume& volume, double isovalue, const char* name) {
  const Sample_noise measured = estimate_noise(volume, std::optional(isovalue));
  const double smoothing = choose_smoothing(volume, measured, {.level = isovalue});
  double result = 0;
  for (const double scale : {0., smoothing, 4.}) {
    const Sampled sampled(smooth_volume(volume, scale));
    const Curvature_error_3<Kernel> estimate(sampled, volume, scale, measured.deviation);
    const auto points = vertices(sampled, usual, isovalue);
    double count = 0;
    for (const Point_3& p : points) {
      const auto c = affine_invariants(Monge_chart_3<double>(sampled.taylor(p)));
      count += estimate(p).affine_gaussian_curvature <= 0.1 * scale_of(c.gaussian_curvature, c.mean_curvature);
    }
    std::printf("  %-12s noise %.2g, scale %g%s: %.1f %% of the vertices are trusted\n", name, measured.deviation,
                scale, scale == smoothing ? " (auto)" : "", 100 * count / double(points.size()));
    if (scale == smoothing) result = count / double(points.size());
  }
  return result;
}

void real_data(const std::string& folder) {
  std::printf("Real data\n");
  CGAL::Image_3 image;
  if (image.read((folder + "/images/skull_2.9.inr").c_str())) {
    const Lattice_3<Kernel> lattice({image.xdim(), image.ydim(), image.zdim()}, Point_3(0, 0, 0),
                                    {Kernel::Vector_3(image.vx(), 0, 0), {0, image.vy(), 0}, {0, 0, image.vz()}});
    Volume skull{lattice, {}};
    for (std::size_t k = 0; k < image.zdim(); ++k)
      for (std::size_t j = 0; j < image.ydim(); ++j)
        for (std::size_t i = 0; i < image.xdim(); ++i) skull.values.push_back(image.value(i, j, k));
    figure("spline_trusted_skull", trusted(skull, 2.9, "skull"), "1", ">=0");
  }
  CGAL::Surface_mesh<Point_3> bunny;
  if (!CGAL::IO::read_OFF(folder + "/meshes/bunny00.off", bunny)) return;
  CGAL::Bbox_3 box;
  for (const Point_3& p : bunny.points()) box += p.bbox();
  const double margin = std::max({box.x_span(), box.y_span(), box.z_span()}) / 10;
  box = {box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
         box.xmax() + margin, box.ymax() + margin, box.zmax() + margin};
  for (const std::size_t n : {129, 257}) {
    const Volume distances = signed_distance_volume<Parallel>(bunny, Lattice_3<Kernel>({n, n, n}, box));
    const std::string name = "bunny_" + std::to_string(n);
    figure("spline_trusted_" + name, trusted(distances, 0, name.c_str()), "1", ">=0");
    if (n != 129) continue;
    // f o A^-1 sampled on the box of the image; A is the matrix of the paper's figure 11.
    const CGAL::Aff_transformation_3<Kernel> map(1.4, -0.2, 0, 0.1, 0.7, 0, 0, 0, 1);
    const Lattice_3<Kernel> image_lattice({n, n, n}, distances.lattice.transform(map).bbox());
    const Volume image_distances = signed_distance_volume<Parallel>(bunny, image_lattice.transform(map.inverse()));
    for (const double scale : {0., 4.}) {
      const Sampled before(smooth_volume(distances, scale)), after(smooth_volume(image_distances, scale));
      std::vector<double> differences;
      for (const Point_3& p : vertices(before, usual)) {
        const auto a = affine_invariants(Monge_chart_3<double>(before.taylor(p)));
        const auto b = affine_invariants(Monge_chart_3<double>(after.taylor(p)));
        const double difference = std::abs(a.gaussian_curvature - b.gaussian_curvature);
        const double relative = difference / scale_of(a.gaussian_curvature, a.mean_curvature);
        if (std::isfinite(relative)) differences.push_back(relative);
      }
      std::printf("  bunny, scale %g: median difference of K before and after the map %.2g of |K| + H^2\n", scale,
                  median(differences));
    }
  }
}

} // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int n, const char* otherwise) { return std::string(argc > n ? argv[n] : otherwise); };
  const std::string part = argument(3, "all");
  const auto is_asked_for = [&](const char* name) { return part == "all" || part == name; };
  if (is_asked_for("cost")) cost();
  if (is_asked_for("noise")) noise();
  if (is_asked_for("figure_10")) figure_10();
  if (is_asked_for("real_data")) real_data(argument(1, "build/data"));
  if (is_asked_for("accuracy")) accuracy(argument(2, ""));
}
