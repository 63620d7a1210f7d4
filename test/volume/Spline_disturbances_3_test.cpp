// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/internal/spline_errors.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Spline_disturbances_3_test {

using namespace equiaffine;

using Kernel = CGAL::Simple_cartesian<double>;
using Volume = Volume_3<Kernel>;
using Spline = Spline_function_3<Kernel>;
using Jet = Jet_3<double>;

// Expansions in the middle of a cell of the splines through unit impulses, one for each node of the lattice: what each
// sample contributes to the expansion of any spline.
std::vector<Jet> contributions_of_samples(const Lattice_3<Kernel>& lattice, const std::array<std::size_t, 3>& cell,
                                          const Volume_options& parameters) {
  const auto middle = lattice.point(double(cell[0]) + 0.5, double(cell[1]) + 0.5, double(cell[2]) + 0.5);
  std::vector<Jet> result;
  for (std::size_t n = 0; n < lattice.number_of_nodes(); ++n) {
    Volume impulse{lattice, std::vector<double>(lattice.number_of_nodes())};
    impulse.values[n] = 1;
    result.push_back(Spline(impulse, parameters).taylor(middle));
  }
  return result;
}

std::vector<Jet> disturbances(const Spline_disturbances_3<Kernel>& of_noise, const std::array<std::size_t, 3>& cell) {
  std::vector<Jet> result;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      for (int k = 0; i + j + k <= 4; ++k) result.push_back(of_noise(cell, {i, j, k}));
  return result;
}

double sum_of_products(const std::vector<Jet>& jets, std::size_t m, std::size_t n) {
  double sum = 0;
  for (const Jet& jet : jets) sum += jet.coefficients()[m] * jet.coefficients()[n];
  return sum;
}

TEST(Spline_disturbances_3, their_covariance_is_that_of_the_expansion_under_white_noise) {
  const Lattice_3<Kernel> lattice({7, 8, 7}, CGAL::Bbox_3(0, 0, 0, 6, 7, 6));
  const Volume_options parameters = {.spline_scheme = Spline_scheme::INTERPOLATION, .spline_degree = 5};
  const double deviation = 0.25;
  const Spline spline(Volume{lattice, std::vector<double>(lattice.number_of_nodes())}, parameters);
  const Spline_disturbances_3<Kernel> of_noise(spline, 0, deviation);
  for (const std::array<std::size_t, 3>& cell : {std::array<std::size_t, 3>{0, 1, 5}, {3, 3, 2}}) {
    const auto samples = contributions_of_samples(lattice, cell, parameters);
    const auto columns = disturbances(of_noise, cell);
    ASSERT_EQ(columns.size(), 35u);
    for (std::size_t m = 0; m < Jet::size; ++m)
      for (std::size_t n = 0; n <= m; ++n) {
        const double scale = std::sqrt(sum_of_products(samples, m, m) * sum_of_products(samples, n, n));
        const double covariance = sum_of_products(samples, m, n);
        EXPECT_NEAR(sum_of_products(columns, m, n), deviation * deviation * covariance, 1e-10 * scale)
            << "coefficients " << m << " and " << n;
      }
  }
}

} // namespace Spline_disturbances_3_test
