// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Input_error.h>
#include <equiaffine/io/internal/shared/input_file.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace equiaffine;

namespace {

std::string error_of(const std::string& path) {
  try {
    open_input(path);
  } catch (const Input_error& error) {
    return error.what();
  }
  return "";
}

} // namespace

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
