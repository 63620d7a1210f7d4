// SPDX-License-Identifier: GPL-3.0-or-later
// Results of the paper's methods that only this report needs:
//   equiaffine-estimates operations         numbers of floating-point operations of each step, as JSON
//   equiaffine-estimates splines < NUMBERS  the library's B-splines of degree 5 and 7, as CSV
//   equiaffine-estimates SURFACE < CSV      K, H and xi at points by each method and by the printed formula, as CSV
#include "support/operation_counts.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/volume/internal/bspline.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

namespace {

using namespace equiaffine;

template <class FT, class F>
Jet_3<FT> expand(const F& f, const std::array<double, 3>& p) {
  return Jet_3<FT>(
      f(Jet_3<FT>::variable(0, FT(p[0])), Jet_3<FT>::variable(1, FT(p[1])), Jet_3<FT>::variable(2, FT(p[2]))));
}

/// The direct method with the axis closest to the gradient, and with xi_1 as printed in section 2(d): its second term
/// contains g_xxy instead of g_xyy.
Affine_estimate_3<double> printed_estimate(const Jet_3<double>& jet) {
  using internal::determinant;
  const auto& c = jet.coefficients();
  const double x = std::abs(c[1]), y = std::abs(c[2]), z = std::abs(c[3]);
  const std::size_t axis = x > y && x > z ? 0 : y > z ? 1 : 2;
  const auto f = internal::with_last_axis(internal::partial_derivatives(jet), axis);
  const internal::Graph_derivatives<double> graph(f);
  auto normal = internal::normal_of_graph(graph);
  const auto xx = graph.with_gradient(2, 0), xy = graph.with_gradient(1, 1), yy = graph.with_gradient(0, 2);
  const auto d = xx * yy - xy * xy;
  const auto factor = sqrt(sqrt(d.value() < 0 ? -d : d)) / (4. * (d * d));
  normal[0] = normal[0] + factor * (xx * yy * (graph.with_gradient(1, 2) - graph.with_gradient(2, 1)));

  std::array<double, 3> xi, xi_x, xi_y;
  for (std::size_t i = 0; i < 3; ++i) {
    xi[i] = normal[i].at<0>();
    xi_x[i] = normal[i].at<1>();
    xi_y[i] = normal[i].at<2>();
  }
  const std::array<double, 3> tangent_x = {1, 0, graph.g[1][0]}, tangent_y = {0, 1, graph.g[0][1]};
  const double a4 = std::sqrt(std::sqrt(std::abs(d.value())));
  const double b11 = -determinant(xi_x, tangent_y, xi) / a4, b12 = -determinant(tangent_x, xi_x, xi) / a4;
  const double b21 = -determinant(xi_y, tangent_y, xi) / a4, b22 = -determinant(tangent_x, xi_y, xi) / a4;
  const double sign = f[3] < 0 ? -1 : 1;
  Affine_estimate_3<double> r{};
  for (std::size_t i = 0; i < 3; ++i) r.normal[(axis + 1 + i) % 3] = sign * xi[i];
  r.gaussian_curvature = b11 * b22 - b12 * b21;
  r.mean_curvature = sign * (b11 + b22) / 2;
  return r;
}

template <class FT>
void print(const Affine_estimate_3<FT>& e) {
  std::printf(",%.17g,%.17g,%.17g,%.17g,%.17g", double(e.gaussian_curvature), double(e.mean_curvature),
              double(e.normal[0]), double(e.normal[1]), double(e.normal[2]));
}

/// `reference` is our method in long double.
template <class F>
void print_estimates(const F& f) {
  std::printf("x,y,z");
  for (const char* way : {"reference", "compact", "transformation", "direct", "direct_z", "printed"})
    std::printf(",%s_K,%s_H,%s_xi_x,%s_xi_y,%s_xi_z", way, way, way, way, way);
  std::printf("\n");
  std::string line;
  std::getline(std::cin, line);
  while (std::getline(std::cin, line)) {
    std::array<double, 3> p{};
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &p[0], &p[1], &p[2]) != 3)
      throw Input_error("the line '" + line + "' is not a point; write x,y,z");
    const Jet_3<double> jet = expand<double>(f, p);
    std::printf("%.17g,%.17g,%.17g", p[0], p[1], p[2]);
    print(affine_estimate(expand<long double>(f, p), Estimator::COMPACT));
    for (const Estimator way : {Estimator::COMPACT, Estimator::TRANSFORMATION, Estimator::DIRECT, Estimator::DIRECT_Z})
      print(affine_estimate(jet, way));
    print(printed_estimate(jet));
    std::printf("\n");
  }
}

void print_splines() {
  std::printf("t,degree_5,degree_7\n");
  for (double t = 0; std::cin >> t;) std::printf("%.17g,%.17g,%.17g\n", t, bspline<5>(t), bspline<7>(t));
}

void print_operations() {
  const Operation_counts n = operation_counts();
  std::printf("{\"matrices\": %ld, \"mapping\": %ld, \"transformation\": %ld, \"direct\": %ld, \"compact\": %ld}\n",
              n.matrices, n.mapping, n.transformation, n.direct, n.compact);
}

} // namespace

int main(int argc, char* argv[]) try {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "operations") print_operations();
  else if (what == "splines") print_splines();
  else if (what == "ellipsoid") print_estimates(analytic_functions::Ellipsoid{.a = 3, .b = 1, .c = 0.3});
  else if (what == "sine") print_estimates(analytic_functions::Sine_surface());
  else if (what == "sphere") print_estimates(analytic_functions::Sphere());
  else if (what == "torus") print_estimates(analytic_functions::Torus());
  else {
    std::fprintf(stderr, "usage: equiaffine-estimates operations|splines|ellipsoid|sine|sphere|torus\n");
    return 2;
  }
} catch (const equiaffine::Input_error& error) {
  std::fprintf(stderr, "equiaffine-estimates: %s\n", error.what());
  return 2;
}
