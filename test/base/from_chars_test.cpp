// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/internal/from_chars.h>

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <system_error>

namespace from_chars_test {

using namespace equiaffine;

struct Read {
  double value = 42; // what from_chars leaves where it fails
  std::size_t length = 0;
  std::errc error{};

  bool operator==(const Read& other) const {
    const bool have_same_value = value == other.value || (std::isnan(value) && std::isnan(other.value));
    return have_same_value && std::signbit(value) == std::signbit(other.value) && length == other.length &&
           error == other.error;
  }
};

std::ostream& operator<<(std::ostream& stream, const Read& read) {
  return stream << read.value << ", " << read.length << " characters, error " << int(read.error);
}

template <class Function>
Read read(const std::string& text, Function function) {
  Read result;
  const auto [end, error] = function(text.data(), text.data() + text.size(), result.value);
  result.length = std::size_t(end - text.data());
  result.error = error;
  return result;
}

Read read_by_strtod(const std::string& text) { return read(text, internal::from_chars_by_strtod<double>); }

TEST(From_chars, numbers_end_where_their_grammar_ends) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  EXPECT_EQ(read_by_strtod("1.5"), (Read{1.5, 3}));
  EXPECT_EQ(read_by_strtod("-.5e1x"), (Read{-5, 5}));
  EXPECT_EQ(read_by_strtod("5.e"), (Read{5, 2}));
  EXPECT_EQ(read_by_strtod("5E+"), (Read{5, 1}));
  EXPECT_EQ(read_by_strtod("5e+2"), (Read{500, 4}));
  EXPECT_EQ(read_by_strtod("0x10"), (Read{0, 1}));
  EXPECT_EQ(read_by_strtod("1,5"), (Read{1, 1}));
  EXPECT_EQ(read_by_strtod("-0"), (Read{-0., 2}));
  EXPECT_EQ(read_by_strtod("0e999"), (Read{0, 5}));
  EXPECT_EQ(read_by_strtod("-inf"), (Read{-infinity, 4}));
  EXPECT_EQ(read_by_strtod("INFinityx"), (Read{infinity, 8}));
  EXPECT_EQ(read_by_strtod("infinit"), (Read{infinity, 3}));
  EXPECT_EQ(read_by_strtod("nan"), (Read{nan, 3}));
  EXPECT_EQ(read_by_strtod("NaN(12_a)"), (Read{nan, 9}));
  EXPECT_EQ(read_by_strtod("nan(-)"), (Read{nan, 3}));
  EXPECT_EQ(read_by_strtod("4.9e-324"), (Read{std::numeric_limits<double>::denorm_min(), 8}));
  for (const char* const text : {"", "-", "+1", " 1", ".", "-.e5", "e5", "x", "- 1", "in"})
    EXPECT_EQ(read_by_strtod(text), (Read{42, 0, std::errc::invalid_argument})) << text;
  for (const char* const text : {"1e999", "-1e999", "1e-999", "-0.0001e-400"})
    EXPECT_EQ(read_by_strtod(text), (Read{42, std::string(text).size(), std::errc::result_out_of_range})) << text;
}

#ifdef __cpp_lib_to_chars
TEST(From_chars, any_text_of_the_characters_of_numbers_is_read_as_by_the_standard_library) {
  std::mt19937 random(4);
  const std::string characters = "0123456789.eE+-infatyNAN()_,x ";
  const auto standard = [](const char* first, const char* last, double& value) {
    return std::from_chars(first, last, value);
  };
  for (int n = 0; n < 100000; ++n) {
    std::string text;
    const std::size_t size = 1 + random() % 8, choice = n % 2 == 0 ? 15 : characters.size();
    for (std::size_t i = 0; i < size; ++i) text += characters[random() % choice];
    EXPECT_EQ(read_by_strtod(text), read(text, standard)) << '"' << text << '"';
  }
}
#endif

} // namespace from_chars_test
