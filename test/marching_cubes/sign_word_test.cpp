// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/marching_cubes/internal/node_signs.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace sign_word_test {

template <class FT>
class Sign_word : public testing::Test {};
using Number_types = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Sign_word, Number_types);

TYPED_TEST(Sign_word, bit_i_is_the_sign_of_number_i_and_bits_behind_the_last_are_0) {
  std::mt19937 random(1);
  const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  for (std::size_t n = 1; n <= 64; ++n)
    for (int round = 0; round < 8; ++round) {
      const TypeParam isovalue = TypeParam(round % 3) - 1;
      std::vector<TypeParam> values(n);
      for (TypeParam& x : values) x = TypeParam(random() % 5) - 2;
      if (round > 1) values[random() % n] = nan;
      const auto word = equiaffine::internal::sign_word(values.data(), n, isovalue);
      for (std::size_t i = 0; i < 64; ++i) {
        ASSERT_EQ(word.positive >> i & 1, i < n && values[i] >= isovalue) << n << " " << i;
        ASSERT_EQ(word.undefined >> i & 1, i < n && std::isnan(values[i])) << n << " " << i;
      }
    }
}

} // namespace sign_word_test
