// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/memory_limit.h"

#include "system/file_memory.h"
#include "system/files.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace equiaffine {

namespace {

std::string gigabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g GB", bytes / 1e9);
  return text.data();
}

/// Throws if more memory is needed than allowed: "`reason` need about X GB of memory for `purpose`, ...".
void check_memory(double needed, Memory_use use, const std::string& reason, const std::string& purpose,
                  const std::string& advice) {
  if (is_resident_memory_limited()) {
    const double room = room_for_scratch_memory();
    if (needed <= room) return;
    throw Input_error(reason + " need about " + gigabytes(needed) + " for " + purpose +
                      ", and the folder of the output has " + gigabytes(room) + " of free space; " + advice +
                      ", or free space there");
  }
  const double all = physical_memory();
  if (needed <= (use == Memory_use::ALL ? all : all / 2)) return;
  const std::string need = reason + " need about " + gigabytes(needed) + " of memory for " + purpose + ", and ";
  if (needed > all) throw Input_error(need + "this computer has " + gigabytes(all) + "; " + advice);
  throw Input_error(need + "this is more than half of the " + gigabytes(all) + " of this computer; " + advice +
                    by_front_end(", or add --yes to use more than half", ""));
}

void check_memory(double needed, Memory_use use, const std::array<std::size_t, 3>& n, const std::string& purpose) {
  check_memory(needed, use,
               option_text("resolution") + ": " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                   std::to_string(n[2]) + " nodes",
               purpose, "use a smaller resolution");
}

} // namespace

double physical_memory() {
  const double pages = double(::sysconf(_SC_PHYS_PAGES)), page_size = double(::sysconf(_SC_PAGE_SIZE));
  return pages > 0 && page_size > 0 ? pages * page_size : std::numeric_limits<double>::infinity();
}

void check_memory_of_volume(const std::array<std::size_t, 3>& resolution, Memory_use use) {
  constexpr double bytes_per_node = 16; // sample and coefficient
  double nodes = 1;
  for (const std::size_t n : resolution) nodes *= double(n);
  check_memory(bytes_per_node * nodes, use, resolution, "the samples");
}

void check_memory_of_surface(const std::array<std::size_t, 3>& resolution, Memory_use use) {
  // The sphere in a cube of n^3 nodes has 3 pi / 2 n^2 vertices: two discs of diameter n along each axis. A vertex has
  // coordinates (24 bytes), its grid edge (40), two triangles (24) and the basic attributes (129).
  constexpr double vertices_per_node = 3.14159265 / 2, bytes_per_vertex = 217, bytes_per_node = 42;
  const auto [nx, ny, nz] = resolution;
  const double sides = double(nx) * double(ny) + double(ny) * double(nz) + double(nz) * double(nx);
  check_memory(vertices_per_node * bytes_per_vertex * sides + bytes_per_node * double(nx) * double(ny), use, resolution,
               "the surface");
}

void check_memory_of_delaunay_surface(double diagonal, double radius, double distance, Memory_use use) {
  // A ball of radius r about a point of the sphere of diameter d rises r^2 / d above the plane of its triangle. A
  // square of side r has 2/3 vertices, each with 7 tetrahedra of the triangulation, 2 triangles and its attributes.
  // The surface may be much smaller than the sphere, so only a small part of it is required to fit.
  constexpr double vertices_per_square = 2.0 / 3, bytes_per_vertex = 1500, part_of_sphere = 1e-4;
  const double diameter = diagonal / std::sqrt(3.0), area = std::numbers::pi * diameter * diameter;
  const double squared_radius = std::min(radius * radius, distance * diameter);
  std::ostringstream reason;
  reason << option_text("radius") << " and " << option_text("distance") << ": triangles within " << radius << " and "
         << distance;
  check_memory(part_of_sphere * bytes_per_vertex * vertices_per_square * area / squared_radius, use, reason.str(),
               "1/10000 of the sphere in the box", "use larger values");
}

namespace {

constexpr std::size_t large_array = std::size_t(1) << 22, mebibyte = std::size_t(1) << 20;

std::atomic<std::size_t> limit = 0; ///< 0 for no limit
std::atomic<pid_t> child_that_counts = 0;

int statm = -1; ///< descriptor of /proc/self/statm, open since the limit was set

/// The resident bytes, from the second number of statm (in pages); 0 if it cannot be read.
std::size_t resident_memory_of_process() {
  std::array<char, 128> text{};
  if (::pread(statm, text.data(), text.size() - 1, 0) <= 0) return 0;
  char* end = nullptr;
  std::strtoull(text.data(), &end, 10);
  return std::size_t(std::strtoull(end, nullptr, 10)) * std::size_t(::sysconf(_SC_PAGE_SIZE));
}

/// The sum in bytes of some lines, in kilobytes, of a file in /proc about a process; 0 if there is no such file.
std::size_t memory_in(const char* name_of_file, const std::string& process,
                      std::initializer_list<std::string_view> names) {
  std::ifstream file("/proc/" + process + "/" + name_of_file);
  std::size_t kilobytes = 0;
  for (std::string line; std::getline(file, line);)
    for (const std::string_view name : names)
      if (line.starts_with(name)) kilobytes += std::strtoull(line.c_str() + name.size(), nullptr, 10);
  return 1024 * kilobytes;
}

/// The resident memory of this process and of the counted child.
std::size_t resident_memory() {
  const pid_t child = child_that_counts;
  return resident_memory_of_process() + (child == 0 ? 0 : memory_in("status", std::to_string(child), {"VmRSS:"}));
}

/// The part of it that is not backed by files; memory shared by both counts once.
std::size_t irreclaimable_memory() {
  const auto of = [](const std::string& process) {
    const std::size_t proportional = memory_in("smaps_rollup", process, {"Pss_Anon:", "Pss_Shmem:"});
    return proportional > 0 ? proportional : memory_in("status", process, {"RssAnon:", "RssShmem:"}); // older systems
  };
  const pid_t child = child_that_counts;
  return of("self") + (child == 0 ? 0 : of(std::to_string(child)));
}

/// Starts watching this process, which may be a child, and disables huge pages; see disable_huge_pages() in
/// file_memory.cpp.
void begin_watching() {
  if (statm != -1) ::close(statm);
  statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
#ifdef __linux__
  ::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
#endif
}

std::string in_mebibytes(std::size_t bytes) { return std::to_string((bytes + mebibyte - 1) / mebibyte) + "M"; }

/// Ends the process like an error of the user.
[[noreturn]] void end_for_lack_of_memory(std::size_t used) {
  const std::string end_of_progress = ::isatty(STDERR_FILENO) ? "\n" : "";
  const std::string report = end_of_progress + "equiaffine: error: " + option_text("memory") + ": " +
                             in_mebibytes(limit) +
                             " are too few for the data that cannot be kept in a file; give more, such as " +
                             in_mebibytes(2 * used) + ", or leave it out\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, report.data(), report.size());
  remove_all_temporary_folders();
  constexpr int error_of_user = 2;
  ::_exit(error_of_user);
}

/// Keeps the resident memory below `bytes` by releasing pages; ends the process if that is impossible and it `may_end`.
/// Checks more often near the limit.
void watch(std::size_t bytes, bool may_end) {
  constexpr std::size_t while_releasing = 256 * mebibyte; // may be read again while pages are released
  const std::size_t high = bytes - std::min(bytes / 2, std::max(bytes / 20 * 3, while_releasing));
  const std::size_t too_high = bytes / 20 * 21;
  constexpr std::size_t bytes_per_microsecond = 400000; // a read of one byte of a mapped file may bring 2 MB
  while (true) {
    std::size_t used = resident_memory();
    if (used > high) {
      release_reclaimable_memory();
      used = resident_memory();
      if (may_end && used > too_high)
        if (const std::size_t rest = irreclaimable_memory(); rest > too_high) end_for_lack_of_memory(rest);
    }
    const std::size_t microseconds = ((used > high ? too_high : high) - std::min(used, high)) / bytes_per_microsecond;
    std::this_thread::sleep_for(std::chrono::microseconds(std::clamp<std::size_t>(microseconds, 50, 20000)));
  }
}

} // namespace

void limit_resident_memory(std::size_t bytes, const std::filesystem::path& folder) {
  begin_watching();
  const std::size_t used = resident_memory();
  if (used == 0)
    throw Input_error(option_text("memory") + ": this system does not report the memory of a process; leave it out");
  const std::size_t least = (used / mebibyte + 128) / 10 * 10 * mebibyte;
  if (bytes < least)
    throw Input_error(option_text("memory") + ": " + in_mebibytes(bytes) + " are too few: the program itself needs " +
                      in_mebibytes(used) + "; give at least " + in_mebibytes(least));
  open_scratch_memory(folder, bytes / 8);
  limit = bytes;
  std::thread([bytes] { watch(bytes, true); }).detach();
}

bool is_resident_memory_limited() { return limit > 0; }

void limit_resident_memory_of_child() {
  if (limit == 0) return;
  forget_reclaimable_memory();
  reopen_scratch_memory();
  begin_watching();
  child_that_counts = 0;
  const std::size_t of_parent = memory_in("status", std::to_string(::getppid()), {"VmRSS:"});
  const std::size_t shared = memory_in("status", "self", {"RssAnon:"});
  limit = std::max(limit - std::min<std::size_t>(limit, of_parent), limit / 4) + shared;
  std::thread([bytes = limit.load()] { watch(bytes, false); }).detach();
}

void count_memory_of_child(pid_t child) { child_that_counts = child; }

bool belongs_in_scratch_memory(std::size_t size) {
  return size >= large_array && has_scratch_memory() && resident_memory_of_process() + size > limit / 3;
}

} // namespace equiaffine
