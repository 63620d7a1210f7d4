// SPDX-License-Identifier: GPL-3.0-or-later
// Compares delaunay_surface with CGAL's two surface meshers for the same criteria. Runs alternate; figures are ratios
// of median CPU times. Argument: number of repeats (5).
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/Timer.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/make_surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
namespace functions = equiaffine::analytic_functions;
using Kernel = CGAL::Simple_cartesian<double>;
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

/// 0.5 - the sum of 60 Gaussians: an expensive function.
struct Gaussians {
  struct Center {
    double x, y, z;
  };
  std::array<Center, 60> centers;

  Gaussians() {
    std::mt19937 random(3);
    const auto coordinate = [&] { return double(random()) / double(std::mt19937::max()) * 2 - 1; };
    for (Center& c : centers) c = {coordinate(), coordinate(), coordinate()};
  }

  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto term = [&](const Center& c) {
      using functions::square;
      using std::exp;
      return exp((square(x - c.x) + square(y - c.y) + square(z - c.z)) * -8.0);
    };
    auto sum = 0.5 - term(centers[0]);
    for (std::size_t i = 1; i < centers.size(); ++i) sum = sum - term(centers[i]);
    return sum;
  }
  CGAL::Bbox_3 box() const { return CGAL::Bbox_3(-2, -2, -2, 2, 2, 2); }
};

void figure(const std::string& name, double value, const std::string& unit, const std::string& target) {
  std::cout << "figure " << name << ' ' << value << ' ' << unit << " target " << target << std::endl;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

template <class F>
double seconds(F f) {
  CGAL::Timer timer;
  timer.start();
  f();
  return timer.time();
}

/// The starting point of CGAL's Surface_mesher: the grid point with f < 0 that is nearest to the center.
template <class Function>
Epick::Point_3 inner_point(const Function& f, const Clip_domain_3& domain) {
  const CGAL::Bbox_3& b = domain.bbox();
  const Epick::Point_3 center =
      CGAL::midpoint(Epick::Point_3(b.xmin(), b.ymin(), b.zmin()), Epick::Point_3(b.xmax(), b.ymax(), b.zmax()));
  Epick::Point_3 best = center;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j)
      for (int k = 0; k <= 40; ++k) {
        const Epick::Point_3 p(b.xmin() + i * b.x_span() / 40, b.ymin() + j * b.y_span() / 40,
                               b.zmin() + k * b.z_span() / 40);
        const double d = CGAL::squared_distance(p, center);
        if (d < least && domain.contains(p) && f(p) < 0) {
          best = p;
          least = d;
        }
      }
  return best;
}

template <class Function>
std::size_t stock_surface_mesher(const Function& f, const Epick::Sphere_3& sphere, double radius) {
  using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const CGAL::Implicit_surface_3<Triangulation::Geom_traits, Function> surface(f, sphere, 1e-3);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30, radius, radius / 10);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_with_boundary_tag());
  return complex.number_of_facets();
}

template <class Function>
std::size_t stock_mesh_3(const Function& f, const Clip_domain_3& clip, double radius) {
  using Domain = CGAL::Labeled_mesh_domain_3<Epick>;
  using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
  using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
  namespace parameters = CGAL::parameters;
  const Domain domain = Domain::create_implicit_mesh_domain(f, clip.bbox()); // relative error 1e-3
#if CGAL_VERSION_NR >= 1060000000
  const CGAL::Mesh_criteria_3<Triangulation> criteria(
      parameters::facet_angle(30).facet_size(radius).facet_distance(radius / 10));
  const auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb().no_exude());
#else
  const CGAL::Mesh_criteria_3<Triangulation> criteria(parameters::facet_angle = 30, parameters::facet_size = radius,
                                                      parameters::facet_distance = radius / 10);
  const auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb(), parameters::no_exude());
#endif
  return complex.number_of_facets();
}

struct Expected {
  std::size_t components;
  std::ptrdiff_t euler_characteristic;
  bool is_closed = true, mesh_3_finishes = true;
  double evaluations = 60, over_surface_mesher = 2, over_mesh_3 = 1.3;
};

template <class Traits>
void check(const std::string& name, const Delaunay_surface_3<Kernel>& mesh, const Traits& traits,
           const Clip_domain_3& domain, const Expected& expected) {
  const auto topology = mesh_topology(mesh.triangles, mesh.points.size());
  double angle = 180, distance = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      angle = std::min(
          angle, CGAL::approximate_angle(mesh.points[t[(i + 1) % 3]], mesh.points[t[i]], mesh.points[t[(i + 2) % 3]]));
  for (const auto& p : mesh.points) distance = std::max(distance, distance_estimate(first_order(traits, p)));
  const bool is_right = topology.is_manifold && topology.components == expected.components &&
                        topology.euler_characteristic == expected.euler_characteristic &&
                        (topology.boundary_edges == 0) == expected.is_closed;
  figure("delaunay_" + name + "_right_topology", is_right, "bool", ">=1");
  figure("delaunay_" + name + "_certified", mesh.is_certified, "bool", ">=1");
  figure("delaunay_" + name + "_smallest_angle", angle, "degrees", ">=30");
  figure("delaunay_" + name + "_distance", distance / domain.diagonal(), "diagonals", "<=1e-14");
  figure("delaunay_" + name + "_evaluations", double(mesh.function_evaluations) / double(mesh.triangles.size()),
         "per_facet", "<=" + std::to_string(int(expected.evaluations)));
}

template <class F>
void compare(const std::string& name, const F& f, const Clip_domain_3& domain, double radius, const Expected& expected,
             int repeats) {
  const auto traits = make_analytic_traits<Kernel>(f, f.box());
  const auto plain = [&f](const Epick::Point_3& p) { return f(p.x(), p.y(), p.z()); };
  const Epick::Point_3 inner = inner_point(plain, domain);
  double reach = domain.radius();
  if (!domain.is_ball())
    for (int corner = 0; corner < 8; ++corner) {
      const auto& b = domain.bbox();
      reach =
          std::max(reach, std::sqrt(CGAL::squared_distance(inner, Epick::Point_3(corner & 1 ? b.xmax() : b.xmin(),
                                                                                 corner & 2 ? b.ymax() : b.ymin(),
                                                                                 corner & 4 ? b.zmax() : b.zmin()))));
    }
  const Epick::Sphere_3 sphere(inner, reach * reach);

  std::vector<double> ours, surface_mesher, mesh_3;
  std::size_t our_facets = 0, surface_mesher_facets = 0, mesh_3_facets = 0;
  for (int n = 0; n < repeats; ++n) {
    ours.push_back(seconds([&] {
      const auto mesh = delaunay_surface(traits, {.radius = radius, .clip = domain});
      our_facets = mesh.triangles.size();
      if (n == 0) check(name, mesh, traits, domain, expected);
    }));
    surface_mesher.push_back(seconds([&] { surface_mesher_facets = stock_surface_mesher(plain, sphere, radius); }));
    if (expected.mesh_3_finishes)
      mesh_3.push_back(seconds([&] { mesh_3_facets = stock_mesh_3(plain, domain, radius); }));
  }
  const auto target = [](double t) { return ">=" + std::to_string(t).substr(0, 3); };
  std::cout << name << ": facets " << our_facets << ' ' << surface_mesher_facets << ' ' << mesh_3_facets << ", seconds "
            << median(ours) << ' ' << median(surface_mesher) << ' ' << (mesh_3.empty() ? 0 : median(mesh_3))
            << std::endl;
  figure("delaunay_" + name + "_over_Surface_mesher", median(surface_mesher) / median(ours), "ratio",
         target(expected.over_surface_mesher));
  if (expected.mesh_3_finishes)
    figure("delaunay_" + name + "_over_Mesh_3", median(mesh_3) / median(ours), "ratio", target(expected.over_mesh_3));
}

template <class F>
void compare(const std::string& name, const F& f, double radius, const Expected& expected, int repeats) {
  compare(name, f, Clip_domain_3(f.box()), radius, expected, repeats);
}

/// The number of runs that find a sphere with a radius of a thousandth of the box next to a large one.
int tiny_spheres_found(int placements) {
  std::mt19937 random(7);
  const auto coordinate = [&] { return (double(random()) / double(std::mt19937::max()) * 2 - 1) * 1.9; };
  int found = 0;
  for (int n = 0; n < placements;) {
    functions::Two_spheres f;
    f.small_radius = 0.004;
    f.center = {coordinate(), coordinate(), coordinate()};
    if (std::hypot(f.center[0], f.center[1], f.center[2]) < 1.02) continue;
    const auto mesh = delaunay_surface(make_analytic_traits<Kernel>(f, f.box()), {.radius = 0.4});
    const auto topology = mesh_topology(mesh.triangles, mesh.points.size());
    found += topology.components == 2 && topology.euler_characteristic == 4;
    ++n;
  }
  return found;
}

} // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  compare("sphere", functions::Sphere(), 0.031, {1, 2}, repeats);
  compare("torus", functions::Torus(), 0.017, {1, 0}, repeats);
  compare("blobby", functions::Blobby(), 0.034, {2, 4}, repeats);
  compare("sextic", functions::Barth_sextic{0.3}, Clip_domain_3({0, 0, 0}, 1.7), 0.047, {1, -40, false, false},
          repeats);
  compare("two_spheres", functions::Two_spheres(), 0.031, {2, 4}, repeats);
  compare("genus_2", functions::Genus_two(), Clip_domain_3({0, 0, 0}, 2.5), 0.046, {1, -2, true, false}, repeats);
  compare("tanglecube", functions::Tanglecube(), 0.087, {1, -8}, repeats);
  compare("chmutov", functions::Chmutov_sextic(), 0.053, {1, -54, true, true, 100}, repeats);
  const Gaussians gaussians;
  compare("gaussians", gaussians, 0.05, {1, 2, true, true, 60, 1.4, 1.4}, repeats);
  figure("delaunay_tiny_spheres_found", tiny_spheres_found(1000), "of_1000", ">=1000");
}
