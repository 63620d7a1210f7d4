// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/files.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace atomic_file_test {

namespace fs = std::filesystem;

using equiaffine::Input_error;
using equiaffine::Output_file;

class Program_atomic_file : public testing::Test {
protected:
  Program_atomic_file() {
    std::string name = (fs::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Program_atomic_file() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  fs::path path(const std::string& name) const { return folder_ / name; }

  void write_file(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  std::string read_file(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  std::size_t number_of_files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  static std::string error_of(const std::string& path) {
    try {
      Output_file file(path);
      file.stream() << "x";
      file.commit();
    } catch (const Input_error& error) {
      return error.what();
    }
    return "no error";
  }

private:
  fs::path folder_;
};

TEST_F(Program_atomic_file, the_target_appears_with_commit_and_not_before) {
  write_file("a.txt", "old");
  Output_file file(path("a.txt"));
  file.stream() << "new";
  file.close();
  EXPECT_EQ(read_file("a.txt"), "old");
  file.commit();
  EXPECT_EQ(read_file("a.txt"), "new");
  EXPECT_EQ(number_of_files(), 1u);
}

TEST_F(Program_atomic_file, nothing_remains_without_commit) {
  write_file("a.txt", "old");
  {
    Output_file file(path("a.txt"));
    file.stream() << "new";
    Output_file unused(path("b.txt"));
  }
  EXPECT_EQ(read_file("a.txt"), "old");
  EXPECT_EQ(number_of_files(), 1u);
}

TEST_F(Program_atomic_file, files_that_a_library_writes_beside_the_temporary_file_are_committed_with_it) {
  Output_file file(path("a.mhd"));
  EXPECT_EQ(file.temporary_path().filename(), "a.mhd");
  std::ofstream(file.temporary_path()) << "header";
  std::ofstream(file.temporary_path().replace_extension(".raw")) << "data";
  EXPECT_EQ(number_of_files(), 1u);
  file.commit();
  EXPECT_EQ(read_file("a.mhd"), "header");
  EXPECT_EQ(read_file("a.raw"), "data");
  EXPECT_EQ(number_of_files(), 2u);
}

TEST_F(Program_atomic_file, several_outputs_are_committed_only_if_all_could_be_stored) {
  std::array<Output_file, 2> files = {Output_file(path("a.txt")), Output_file(path("b.txt"))};
  files[0].stream() << "a";
  files[1].stream() << "b";
  files[1].stream().setstate(std::ios::badbit);
  EXPECT_THROW(equiaffine::commit_all(files), Input_error);
  EXPECT_FALSE(fs::exists(path("a.txt")));

  std::array<Output_file, 2> good_files = {Output_file(path("a.txt")), Output_file(path("b.txt"))};
  good_files[0].stream() << "a";
  good_files[1].stream() << "b";
  equiaffine::commit_all(good_files);
  EXPECT_EQ(read_file("a.txt") + read_file("b.txt"), "ab");
}

TEST_F(Program_atomic_file, a_device_that_refuses_its_copy_leaves_the_other_files_as_they_were) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  write_file("a.txt", "old");
  std::array<Output_file, 2> files = {Output_file(path("a.txt")), Output_file("/dev/full")};
  files[0].stream() << "new";
  files[1].stream() << "x";
  EXPECT_THROW(equiaffine::commit_all(files), Input_error);
  EXPECT_EQ(read_file("a.txt"), "old");
}

TEST_F(Program_atomic_file, a_file_that_is_replaced_hands_on_its_permissions) {
  constexpr fs::perms mode = fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read;
  for (const char* name : {"a.mhd", "a.raw"}) {
    write_file(name, "old");
    fs::permissions(path(name), mode);
  }
  Output_file file(path("a.mhd"));
  file.stream() << "new";
  std::ofstream(file.temporary_path().replace_extension(".raw")) << "data";
  file.commit();
  EXPECT_EQ(read_file("a.mhd") + read_file("a.raw"), "newdata");
  for (const char* name : {"a.mhd", "a.raw"}) EXPECT_EQ(fs::status(path(name)).permissions(), mode) << name;
}

TEST_F(Program_atomic_file, a_link_stays_a_link) {
  write_file("a.txt", "old");
  fs::create_symlink("a.txt", path("link.txt"));
  EXPECT_EQ(error_of(path("link.txt")), "no error");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(read_file("a.txt"), "x");
}

TEST_F(Program_atomic_file, a_name_without_a_folder_is_written_in_the_current_one) {
  const fs::path before = fs::current_path();
  fs::current_path(path("."));
  EXPECT_EQ(error_of("a.txt"), "no error");
  fs::current_path(before);
  EXPECT_EQ(read_file("a.txt"), "x");
  EXPECT_EQ(number_of_files(), 1u);
}

TEST_F(Program_atomic_file, standard_output_receives_everything_at_commit) {
  testing::internal::CaptureStdout();
  Output_file file("-");
  file.stream() << "x,y,z\n";
  file.close();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  testing::internal::CaptureStdout();
  file.commit();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "x,y,z\n");
}

TEST_F(Program_atomic_file, a_device_is_written_to_and_not_replaced) {
  EXPECT_EQ(error_of("/dev/null"), "no error");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Program_atomic_file, a_full_device_is_an_error_at_commit) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  Output_file file("/dev/full");
  file.stream() << "x";
  EXPECT_NO_THROW(file.close());
  EXPECT_THROW(file.commit(), Input_error);
}

TEST_F(Program_atomic_file, mistakes_are_found_before_anything_is_written) {
  EXPECT_EQ(error_of(path(".")), "cannot write '" + path(".").string() + "': it is a folder; name a file");
  EXPECT_EQ(error_of(path("absent/a.txt")), "cannot write '" + path("absent/a.txt").string() + "': the folder '" +
                                                path("absent").string() +
                                                "' does not exist; create it or choose another one");
  EXPECT_NE(error_of(path("absent/")).find("it names a folder"), std::string::npos);
  EXPECT_NE(error_of("").find("name a file"), std::string::npos);
  EXPECT_EQ(number_of_files(), 0u);
}

TEST_F(Program_atomic_file, a_folder_where_nobody_can_write_is_an_error_at_once) {
  if (!fs::is_directory("/proc/self")) GTEST_SKIP() << "this system has no /proc, which not even the superuser changes";
  EXPECT_NE(error_of("/proc/a.txt").find("cannot write '/proc/a.txt': cannot create a file in '/proc'"),
            std::string::npos);
}

} // namespace atomic_file_test
