// SPDX-License-Identifier: GPL-3.0-or-later
// From the 34 derivatives of f at a point to co-normal, normal, B, K, H and J: operations, times, accuracy.
#include "runner.h"
#include "support/anisotropic_surface.h"
#include "support/operation_counts.h"
#include "support/reference.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using namespace benchmark_runner;
using Kernel = CGAL::Simple_cartesian<double>;
using Lanes = Pack<double>;

constexpr std::size_t number_of_jets = 64; // they stay in the first-level cache
constexpr std::size_t repetitions = 64;

std::vector<Jet_3<double>> random_jets() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Jet_3<double>> jets(number_of_jets);
  for (auto& jet : jets)
    for (double& c : jet.coefficients()) c = unit(random);
  return jets;
}

std::vector<Jet_3<Lanes>> packed(const std::vector<Jet_3<double>>& jets) {
  std::vector<Jet_3<Lanes>> result(jets.size() / Lanes::size);
  for (std::size_t p = 0; p < result.size(); ++p)
    for (std::size_t n = 0; n < 35; ++n)
      result[p].coefficients()[n] =
          Lanes::generate([&](std::size_t i) { return jets[p * Lanes::size + i].coefficients()[n]; });
  return result;
}

void table_1() {
  const Operation_counts count = operation_counts();
  std::printf("Table 1: floating-point operations per point\n"
              "                                matrices  mapping  formulas   total   direct\n"
              "  Andrade, Lewiner 2012              749     7335      1783    9867    23690\n"
              "  the same methods here      %12ld %8ld %9ld %7ld %8ld\n"
              "  pivot and shear, with J    %12s %8s %9s %7ld\n",
              count.matrices, count.mapping, count.transformation - count.matrices - count.mapping,
              count.transformation, count.direct, "", "", "", count.compact);
  figure("kernel_operations", double(count.compact), "flop", "<=327");
}

/// Billions of independent products and sums per second without memory access: the current peak of the processor
/// without fused operations, which would change the numbers.
double peak() {
  std::array<Lanes, 12> x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = Lanes(double(i));
  std::vector<Contender> arithmetic = {{"a product and a sum at their best, packs",
                                        [&] {
                                          for (int n = 0; n < 4096; ++n) {
                                            for (Lanes& lanes : x) lanes = lanes * Lanes(0.999) + Lanes(0.001);
                                            keep(n);
                                          }
                                          keep(x[0]);
                                        },
                                        4096. * double(x.size() * Lanes::size)}};
  race(arithmetic, 101);
  return 2 / arithmetic[0].nanoseconds;
}

void times() {
  const auto jets = random_jets();
  const auto packs = packed(jets);
  std::vector<Affine_invariants_3<double>> out(jets.size());
  std::vector<Affine_invariants_3<Lanes>> out_packs(packs.size());
  std::vector<Affine_estimate_3<double>> estimates(jets.size());
  const auto estimated = [&](auto estimator) {
    return [&, estimator] {
      for (std::size_t i = 0; i < jets.size(); ++i) estimates[i] = estimator(jets[i]);
      keep(estimates[0]);
    };
  };
  std::vector<Contender> contenders = {
      {"compact, one by one",
       [&] {
         for (std::size_t n = 0; n < repetitions; ++n) {
           for (std::size_t i = 0; i < jets.size(); ++i) out[i] = affine_invariants(Monge_chart_3<double>(jets[i]));
           keep(out[0]);
         }
       },
       double(repetitions * jets.size())},
      {"compact, packs",
       [&] {
         for (std::size_t n = 0; n < repetitions; ++n) {
           for (std::size_t i = 0; i < packs.size(); ++i)
             out_packs[i] = affine_invariants(Monge_chart_3<Lanes>(packs[i]));
           keep(out_packs[0]);
         }
       },
       double(repetitions * jets.size())},
      {"transformation", estimated([](const auto& jet) { return internal::transformation_estimate(jet); }),
       double(jets.size())},
      {"direct", estimated([](const auto& jet) { return affine_estimate(jet, Estimator::DIRECT); }),
       double(jets.size())}};
  std::printf("Kernel alone, per point, %zu lanes\n", Lanes::size);
  race(contenders, 101);
  const double scalar = time_of(contenders, "compact, one by one");
  const double rate = double(operation_counts().compact) / time_of(contenders, "compact, packs"), best = peak();
  std::printf("  packs: %.1f of %.1f GFlop/s\n", rate, best);
  figure("kernel_packs_to_scalar", scalar / time_of(contenders, "compact, packs"), "x",
         Lanes::size >= 8 ? ">=3.8" : ">=1.9");
  figure("kernel_transformation_to_compact", time_of(contenders, "transformation") / scalar, "x", ">=8");
}

/// annotate() of a mesh, compared with a loop over its vertices that computes the structure at one vertex at a time.
void meshes() {
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  const auto traits = make_analytic_traits<Kernel>(analytic_functions::Metaballs(), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  Mesh mesh = to_surface_mesh(marching_cubes(traits, {.resolution = 128}));
  const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("H").first;
  const auto K = mesh.add_property_map<Mesh::Vertex_index, double>("K").first;
  const auto one_by_one = [&] {
    for (const auto v : mesh.vertices()) {
      const auto structure = local_structure_at(traits, mesh.point(v));
      map[v] = structure.affine.mean_curvature;
      K[v] = structure.affine.gaussian_curvature;
    }
  };
  const auto maps = parameters::vertex_affine_mean_curvature_map(map).vertex_affine_Gaussian_curvature_map(K);
  const auto given = compare(processor_clock, 9, one_by_one, [&] { annotate(mesh, traits, maps); });
  const auto all = compare(processor_clock, 9, one_by_one, [&] { annotate(mesh, traits); });
  const double vertices = double(mesh.number_of_vertices());
  std::printf("A mesh of %.0f vertices, ns per vertex: one by one %.0f, annotate two maps %.0f, all maps %.0f\n",
              vertices, 1e9 * given.a / vertices, 1e9 * given.b / vertices, 1e9 * all.b / vertices);
  figure("kernel_annotate_to_one_by_one", given.ratio, "x", ">=2");
}

void threads() {
#ifdef CGAL_LINKED_WITH_TBB
  constexpr std::size_t size = 10'000'000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Kernel::Point_3> points;
  points.reserve(size);
  for (std::size_t i = 0; i < size; ++i) points.emplace_back(unit(random), unit(random), unit(random));
  const auto traits = make_analytic_traits<Kernel>(analytic_functions::Metaballs(), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto selection = select_attributes("affine_gaussian_curvature,affine_mean_curvature");
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    keep(compute_attributes<CGAL::Parallel_tag>(traits, points, selection));
  };
  const auto best = compare_threads(
      5, [&] { run(1); }, [&] { run(2); });
  std::printf("Jets and structure of 10^7 points of metaballs: %.2f s on one thread, %.2f s on two\n", best.a, best.b);
  figure("kernel_two_threads", best.ratio, "x", ">=1.8");
#endif
}

double error_of(const Affine_invariants_3<double>& s, double K, double H, double euclidean_K) {
  const double S = std::abs(K) + H * H + std::pow(std::abs(euclidean_K), 1.5);
  return std::max(std::abs(s.gaussian_curvature - K) / S, std::abs(s.mean_curvature - H) / std::sqrt(S));
}

void accuracy() {
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
  std::vector<double> errors;
  double worst = 0;
  for (const Reference_row& row : read_reference(EQUIAFFINE_TEST_DATA "/affine_structure.csv")) {
    const auto& [x, y, z] = row.point;
    const auto s = local_structure(expand<4, double>(Expression_3(row.expression), x, y, z));
    errors.push_back(error_of(s.affine, row.affine_K, row.affine_H, row.euclidean_K));
    worst = std::max(worst, errors.back() / row.limit);
  }
  std::sort(errors.begin(), errors.end());
  figure("kernel_reference_worst_to_limit", worst, "x", "<=1");
  figure("kernel_reference_median_error", errors[errors.size() / 2], "1", "<=1e-14");

  const Anisotropic_surface f;
  const auto traits = f.traits();
  double anisotropic = 0;
  for (const auto& p : f.points(3000)) {
    const auto t = local_structure(expand<4, Number>(f, Number(p.x()), Number(p.y()), Number(p.z())));
    anisotropic =
        std::max(anisotropic, error_of(local_structure(traits.taylor(p)).affine, double(t.affine.gaussian_curvature),
                                       double(t.affine.mean_curvature), double(t.euclidean.gaussian_curvature)));
  }
  figure("kernel_anisotropic_worst_error", anisotropic, "1", "<=1e-12");

  double stretched = 0; // of the kernel alone: both start from the same derivatives
  for (const double s : {1., 10., 100., 1e3, 1e4, 1e5, 1e6}) {
    const Stretched_surface surface{s};
    for (const auto& [x, y, z] : surface.points(1500)) {
      const auto jet = expand<4, double>(surface, x, y, z);
      Jet_3<Number> exact;
      std::copy(jet.coefficients().begin(), jet.coefficients().end(), exact.coefficients().begin());
      const auto t = affine_invariants(Monge_chart_3<Number>(exact));
      stretched = std::max(stretched, error_of(affine_invariants(Monge_chart_3<double>(jet)),
                                               double(t.gaussian_curvature), double(t.mean_curvature), 0));
    }
  }
  figure("kernel_stretched_worst_error", stretched, "1", "<=1e-13");
}

/// Compile times of the small programs in the folder `user`.
void compilation() {
  for (const std::string name : {"local_structure", "attributes"}) {
    std::vector<double> times;
    const std::string command = EQUIAFFINE_COMPILER " -c -o /dev/null " EQUIAFFINE_USER_SOURCES "/" + name + ".cpp";
    for (int n = 0; n < 3; ++n) times.push_back(processor_seconds_of(command));
    figure("kernel_compile_" + name, median(times), "s", "<=10");
  }
}

} // namespace

int main() {
  table_1();
  times();
  meshes();
  threads();
  accuracy();
  compilation();
}
