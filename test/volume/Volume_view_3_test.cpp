// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace Volume_view_3_test {

using Kernel = CGAL::Simple_cartesian<double>;
using View = equiaffine::Volume_view_3<Kernel>;
using Volume = equiaffine::Volume_3<Kernel>;

const equiaffine::Lattice_3<Kernel> lattice({4, 3, 2}, CGAL::Bbox_3(0, 0, 0, 1, 1, 1));

// The number of a node, which is its sample in these tests.
double number(std::size_t i, std::size_t j, std::size_t k) { return double(i + 4 * j + 12 * k); }

void expect_numbers(const View& view) {
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(view(i, j, k), number(i, j, k));
  std::vector<double> row(3), column(3), depth(2);
  view.copy_line({1, 2, 1}, 0, row);
  EXPECT_EQ(row, (std::vector{number(1, 2, 1), number(2, 2, 1), number(3, 2, 1)}));
  view.copy_line({2, 0, 1}, 1, column);
  EXPECT_EQ(column, (std::vector{number(2, 0, 1), number(2, 1, 1), number(2, 2, 1)}));
  view.copy_line_backwards({3, 1, 1}, 2, depth);
  EXPECT_EQ(depth, (std::vector{number(3, 1, 1), number(3, 1, 0)}));
  std::vector<double> block(8);
  view.copy_block({2, 1, 0}, {2, 2, 2}, block);
  EXPECT_EQ(block, (std::vector{number(2, 1, 0), number(3, 1, 0), number(2, 2, 0), number(3, 2, 0), number(2, 1, 1),
                                number(3, 1, 1), number(2, 2, 1), number(3, 2, 1)}));
  view.copy_line_backwards({3, 0, 0}, 0, row);
  EXPECT_EQ(row, (std::vector{number(3, 0, 0), number(2, 0, 0), number(1, 0, 0)}));
}

template <class Number>
class Volume_view_3_of : public ::testing::Test {};
using Numbers = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t, std::int32_t,
                                 std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(Volume_view_3_of, Numbers);

TYPED_TEST(Volume_view_3_of, numbers_that_lie_one_after_the_other) {
  std::vector<TypeParam> samples;
  for (int n = 0; n < 24; ++n) samples.push_back(TypeParam(n));
  expect_numbers(View(lattice, samples.data()));
}

TYPED_TEST(Volume_view_3_of, numbers_with_any_strides_and_alignment) {
  constexpr std::ptrdiff_t width = sizeof(TypeParam), i = -(width + 1), j = 1 - 8 * i, k = -4 * j;
  std::vector<char> bytes(1000);
  char* const first = bytes.data() + 500;
  for (std::size_t n = 0; n < 24; ++n) {
    const auto sample = TypeParam(n);
    std::memcpy(first + std::ptrdiff_t(n % 4) * i + std::ptrdiff_t(n / 4 % 3) * j + std::ptrdiff_t(n / 12) * k, &sample,
                sizeof sample);
  }
  expect_numbers(View(lattice, reinterpret_cast<const TypeParam*>(first), {i, j, k}));
}

TYPED_TEST(Volume_view_3_of, numbers_with_k_or_j_fastest) {
  constexpr std::ptrdiff_t width = sizeof(TypeParam);
  for (const View::Strides& strides : {View::Strides{6 * width, 2 * width, width}, {3 * width, width, 12 * width}}) {
    std::vector<TypeParam> samples(24);
    for (std::size_t n = 0; n < 24; ++n)
      samples[std::size_t(std::ptrdiff_t(n % 4) * strides[0] + std::ptrdiff_t(n / 4 % 3) * strides[1] +
                          std::ptrdiff_t(n / 12) * strides[2]) /
              sizeof(TypeParam)] = TypeParam(n);
    expect_numbers(View(lattice, samples.data(), strides));
  }
}

TEST(Volume_view_3, a_volume_is_viewed_or_taken_over) {
  Volume volume{lattice, {}};
  for (int n = 0; n < 24; ++n) volume.values.push_back(n);
  const auto viewed = View::of(volume);
  expect_numbers(viewed);
  volume.values[0] = 7;
  EXPECT_EQ(viewed(0, 0, 0), 7) << "a view sees what becomes of the volume";
  volume.values[0] = 0;
  auto owner = std::make_unique<View>(std::move(volume));
  const View copy = *owner;
  owner.reset();
  expect_numbers(copy);
  const Volume again = copy.to_volume();
  EXPECT_EQ(again.lattice.size(), lattice.size());
  for (int n = 0; n < 24; ++n) EXPECT_EQ(again.values[std::size_t(n)], n);
}

TEST(Volume_view_3, another_number_of_values_than_nodes_is_refused) {
  const Volume volume{lattice, std::vector<double>(23)};
  EXPECT_THROW(View::of(volume), std::invalid_argument);
  EXPECT_THROW(View{volume}, std::invalid_argument);
}

} // namespace Volume_view_3_test
