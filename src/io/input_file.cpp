// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <istream>
#include <new>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace equiaffine {

bool has_extension(std::string_view path, std::string_view extension) {
  return path.size() >= extension.size() &&
         std::equal(extension.begin(), extension.end(), path.end() - std::ptrdiff_t(extension.size()),
                    [](char a, unsigned char b) { return a == char(std::tolower(b)); });
}

namespace internal {

namespace {

/// Keeps both ends of a named pipe open while it is opened for reading. Otherwise this could block forever if the
/// writer has already finished.
class Open_pipe {
public:
  /// Throws if no program writes to the pipe within ten seconds.
  explicit Open_pipe(const std::string& path) : for_reading_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (for_reading_ < 0) return; // open_input() reports the reason
    pollfd request = {for_reading_, POLLIN, 0};
    char byte;
    const bool has_writer = poll(&request, 1, 10'000) > 0 || read(for_reading_, &byte, 1) < 0;
    if (!has_writer) {
      close(for_reading_);
      fail_to_read(path, "it is a pipe to which no program writes", "start that program first");
    }
    for_writing_ = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  Open_pipe(const Open_pipe&) = delete;
  Open_pipe& operator=(const Open_pipe&) = delete;
  ~Open_pipe() {
    close(for_reading_);
    close(for_writing_);
  }

private:
  int for_reading_, for_writing_ = -1;
};

} // namespace

void fail_to_read(const std::string& name, std::string reason, const std::string& advice) {
  constexpr std::size_t longest = 300, begin = 200, end = 60;
  if (reason.size() > longest) reason.replace(begin, reason.size() - begin - end, " ... ");
  throw Input_error("cannot read '" + name + "': " + reason + "; " + advice);
}

std::string read_all(std::istream& stream) {
  const std::size_t most = std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE)) / 2;
  std::string text, chunk(1 << 20, '\0');
  while (stream.read(chunk.data(), std::streamsize(chunk.size())) || stream.gcount() > 0) {
    text.append(chunk, 0, std::size_t(stream.gcount()));
    if (text.size() > most) throw std::bad_alloc();
  }
  return text;
}

} // namespace internal

std::ifstream open_input(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    internal::fail_to_read(path, "there is no such file", "check the path");
  if (std::filesystem::is_directory(status)) internal::fail_to_read(path, "it is a folder", "name a file");
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    internal::fail_to_read(path, "it is a device", "name a file");
  std::optional<internal::Open_pipe> pipe;
  if (std::filesystem::is_fifo(status)) pipe.emplace(path);
  std::ifstream file(path, std::ios::binary);
  pipe.reset();
  if (!file) internal::fail_to_read(path, "permission denied", "make it readable");
  if (file.peek() == std::ifstream::traits_type::eof()) internal::fail_to_read(path, "it is empty", "check the path");
  return file;
}

} // namespace equiaffine
