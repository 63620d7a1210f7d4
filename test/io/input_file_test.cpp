// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <thread>

namespace input_file_test {

using namespace equiaffine;

std::string error_of(const std::string& path) {
  try {
    open_input(path);
  } catch (const Input_error& error) {
    return error.what();
  }
  return "";
}

TEST(Input_file, extensions_are_the_same_in_lower_and_upper_case) {
  EXPECT_TRUE(has_extension("folder/mesh.ply", ".ply"));
  EXPECT_TRUE(has_extension("MESH.Ply", ".ply"));
  EXPECT_FALSE(has_extension("ply", ".ply"));
  EXPECT_FALSE(has_extension("mesh.ply.gz", ".ply"));
}

TEST(Input_file, errors_say_why_there_is_nothing_to_read) {
  const auto folder = std::filesystem::temp_directory_path() / "equiaffine_input_file_test";
  std::filesystem::create_directories(folder);
  const std::string empty = (folder / "empty.ply").string(), absent = (folder / "absent.ply").string();
  std::ofstream(empty).close();
  EXPECT_EQ(error_of(absent), "cannot read '" + absent + "': there is no such file; check the path");
  EXPECT_EQ(error_of(folder.string()), "cannot read '" + folder.string() + "': it is a folder; name a file");
  EXPECT_EQ(error_of(empty), "cannot read '" + empty + "': it is empty; check the path");
  std::ofstream(empty) << "ply";
  EXPECT_EQ(error_of(empty), "");
  std::filesystem::remove_all(folder);
}

TEST(Input_file, devices_and_pipes_to_which_nothing_writes_are_refused) {
  EXPECT_EQ(error_of("/dev/zero"), "cannot read '/dev/zero': it is a device; name a file");
  const auto pipe = std::filesystem::temp_directory_path() / "equiaffine_input_file_test.pipe";
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(error_of(pipe.string()).find("no program writes"), std::string::npos);
  std::thread writer([&] { std::ofstream(pipe) << "ply"; });
  EXPECT_EQ(error_of(pipe.string()), "");
  writer.join();
  std::filesystem::remove(pipe);
}

TEST(Input_file, errors_quote_the_ends_of_what_is_long) {
  try {
    internal::fail_to_read("a.csv", "'" + std::string(1000000, '1') + "' is not a number", "correct it");
    FAIL();
  } catch (const Input_error& error) {
    EXPECT_LT(std::string(error.what()).size(), 400U);
    EXPECT_NE(std::string(error.what()).find("1' is not a number; correct it"), std::string::npos) << error.what();
  }
}

} // namespace input_file_test
