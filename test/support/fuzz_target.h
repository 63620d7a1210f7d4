// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_FUZZ_TARGET_H
#define EQUIAFFINE_TEST_SUPPORT_FUZZ_TARGET_H

// A fuzz target is a function of the bytes of an input that throws if it finds a defect:
//
//     EQUIAFFINE_FUZZ_TARGET(name) { read(input); }
//
// Compiled with EQUIAFFINE_FUZZING, it is the entry point of libFuzzer, run by test/long/fuzz. Otherwise it is a test
// that runs the files of its corpus, test/data/fuzz/NAME, and all their prefixes.

#include <equiaffine/base/Input_error.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace equiaffine::test {

/// Throws if an invariant does not hold.
inline void expect(bool holds, const std::string& what_holds) {
  if (!holds) throw std::logic_error("it does not hold that " + what_holds);
}

/// Runs `read` and returns whether it accepts its input. A rejection must have a message with the problem and, after a
/// colon or semicolon, what to do.
template <class Read>
bool accepts(const Read& read) {
  try {
    read();
    return true;
  } catch (const Input_error& error) {
    const std::string_view text = error.what();
    expect(text.find_first_of(":;") != std::string_view::npos, "a message has an advice: " + std::string(text));
    return false;
  }
}

} // namespace equiaffine::test

#ifdef EQUIAFFINE_FUZZING
#define EQUIAFFINE_FUZZ_TARGET(name)                                                                                   \
  static void fuzz(std::string_view input);                                                                            \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {                                  \
    fuzz({reinterpret_cast<const char*>(data), size});                                                                 \
    return 0;                                                                                                          \
  }                                                                                                                    \
  void fuzz(std::string_view input)
#else
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace equiaffine::test {

inline void replay_corpus(const std::string& name, void (*target)(std::string_view)) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(EQUIAFFINE_TEST_DATA "/fuzz/" + name)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    for (std::size_t size = 0; size <= input.size(); ++size)
      ASSERT_NO_THROW(target(std::string_view(input).substr(0, size))) << entry.path() << ", the first " << size;
    ++count;
  }
  EXPECT_GT(count, 0u);
}

} // namespace equiaffine::test

#define EQUIAFFINE_FUZZ_TARGET(name)                                                                                   \
  static void fuzz_##name(std::string_view input);                                                                     \
  TEST(Fuzz_corpus, name) { equiaffine::test::replay_corpus(#name, fuzz_##name); }                                     \
  void fuzz_##name(std::string_view input)
#endif

#endif
