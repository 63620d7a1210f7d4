// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/sample_on_lattice.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

namespace sample_on_lattice_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;

const auto function = equiaffine::make_analytic_traits<Kernel>(
    [](const auto& x, const auto& y, const auto& z) { return x + 10.0 * y + 100.0 * z; },
    CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
const Lattice_3 skew({3, 4, 5}, {1, 2, 3}, {Kernel::Vector_3(1, 0, 0), {2, 3, 0}, {0, 5, 7}});

TEST(Sample_on_lattice, stores_the_value_of_every_node_at_its_index) {
  const auto volume = equiaffine::sample_on_lattice(function, skew);
  ASSERT_EQ(volume.values.size(), 60U);
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(volume(i, j, k), function.value(skew.point(double(i), double(j), double(k))));
}

TEST(Sample_on_lattice, does_not_depend_on_threads_and_reports_every_node_once) {
  std::atomic<std::size_t> reported = 0;
  const auto parallel = equiaffine::sample_on_lattice<CGAL::Parallel_if_available_tag>(
      function, skew, [&](std::size_t nodes) { reported += nodes; });
  EXPECT_EQ(reported, 60U);
  EXPECT_EQ(parallel.values, equiaffine::sample_on_lattice<CGAL::Sequential_tag>(function, skew).values);
}

} // namespace sample_on_lattice_test
