// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_RUN_PROGRAM_H
#define EQUIAFFINE_TEST_SUPPORT_RUN_PROGRAM_H

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace equiaffine::test {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// The text without progress lines, whose number depends on the computer.
inline std::string without_progress(const std::string& text) {
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("equiaffine: progress: ")) rest += line + (lines.eof() ? "" : "\n");
  return rest;
}

struct Result {
  int status = -1; ///< the exit status; -1 if the program was terminated by a signal
  std::string out, error;
};

/// Runs the program in a temporary folder, which is empty at first.
class Program_test : public ::testing::Test {
protected:
  Program_test() {
    std::string name = (std::filesystem::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) std::abort();
    root_ = name;
    folder_ = root_ / "work";
    std::filesystem::create_directory(folder_);
  }
  ~Program_test() override { std::filesystem::remove_all(root_); }

  /// Runs the program until it exits. Standard output is written to `standard_output`, for example a device, or to a
  /// temporary file.
  Result run(std::vector<std::string> arguments, const std::string& input = {},
             const std::string& standard_output = {}) const {
    Result result = wait_for(start(std::move(arguments), input, standard_output));
    if (!standard_output.empty()) result.out.clear();
    return result;
  }

  /// Starts the program and returns the id of its process.
  pid_t start(std::vector<std::string> arguments, const std::string& input = {},
              const std::string& standard_output = {}) const {
    const std::string in = root_ / "in", out = standard_output.empty() ? (root_ / "out").string() : standard_output,
                      error = root_ / "error";
    write_file(in, input);
    arguments.insert(arguments.begin(), EQUIAFFINE_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
      for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL); // the parent can ignore them
      redirect(in, O_RDONLY, STDIN_FILENO);
      redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
      redirect(error, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
      if (::chdir(folder_.c_str()) == 0) ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    return child;
  }

  Result wait_for(pid_t child) const {
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(root_ / "out"),
            without_progress(read_file(root_ / "error"))};
  }

  /// Runs the program, expects success, and returns its standard output.
  std::string run_well(const std::vector<std::string>& arguments, const std::string& input = {}) const {
    const Result result = run(arguments, input);
    EXPECT_EQ(result.status, 0) << result.error;
    EXPECT_EQ(result.error, "");
    return result.out;
  }

  std::string file(const std::string& name) const { return read_file(folder_ / name); }

  /// The names of the files in the folder, in alphabetical order.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::filesystem::path root_, folder_;

private:
  static void redirect(const std::string& path, int flags, int target) {
    const int descriptor = ::open(path.c_str(), flags, 0600);
    ::dup2(descriptor, target);
    ::close(descriptor);
  }
};

} // namespace equiaffine::test

#endif
