// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/process.h"

#include "system/file_memory.h"
#include "system/files.h"
#include "system/memory_limit.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_scheduler_observer.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <new>
#include <poll.h>
#include <pthread.h>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace equiaffine {

namespace {

constexpr std::array requests_to_end = {SIGHUP,  SIGINT,  SIGTERM,   SIGQUIT, SIGALRM,
                                        SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU};
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP};
constexpr int wake = SIGUSR1; ///< sent by a crash to the thread that removes the temporary folders
constexpr std::array errors_of_writing = {SIGPIPE, SIGXFSZ};

/// The signal of the first crash, or zero, and whether the temporary folders have been removed since.
std::atomic<int> crash = 0;
std::atomic<bool> is_clean = false;

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// Waits for a request to end, removes the temporary folders and ends the process. A crash also wakes this thread, but
/// the thread that crashed ends the process.
void end_at(const sigset_t& signals) {
  int signal = 0;
  ::sigwait(&signals, &signal);
  remove_all_temporary_folders();
  if (crash != 0) {
    is_clean = true;
    while (true) ::pause();
  }
  if (::isatty(STDERR_FILENO)) std::cerr << std::endl; // ends the line of the progress
  ::_exit(128 + signal);
}

/// Handles a crash, async-signal-safe: another thread removes the temporary folders, if it still can.
extern "C" void report_crash(int signal) {
  constexpr std::string_view report =
      "equiaffine: internal error: the program crashed; please report this defect with the command line and the "
      "input\n";
  constexpr timespec moment = {0, 10'000'000};
  constexpr int most_moments = 300;
  if (int none = 0; !crash.compare_exchange_strong(none, signal))
    while (true) ::pause(); // the thread that crashed first ends the process
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, report.data(), report.size());
  ::kill(::getpid(), wake);
  for (int i = 0; i < most_moments && !is_clean; ++i) ::nanosleep(&moment, nullptr);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Gives the thread a second stack, for crashes by stack overflow.
void use_second_stack() {
  constexpr std::size_t size = 1 << 16;
  thread_local std::array<std::byte, size> stack;
  stack_t alternative = {};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
}

#ifdef CGAL_LINKED_WITH_TBB
/// Gives every worker thread of TBB a second stack.
class Second_stacks : public tbb::task_scheduler_observer {
public:
  Second_stacks() { observe(true); }
  void on_scheduler_entry(bool) override { use_second_stack(); }
};
#endif

void handle_crashes() {
  use_second_stack();
#ifdef CGAL_LINKED_WITH_TBB
  // Never destroyed, since the threads may outlive the objects of main().
  [[maybe_unused]] static const auto* const second_stacks = new Second_stacks;
#endif
  struct sigaction action = {};
  action.sa_handler = report_crash;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int signal : crashes) ::sigaction(signal, &action, nullptr);
}

} // namespace

void clean_up_at_signals() {
  for (const int signal : errors_of_writing) std::signal(signal, SIG_IGN);
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : requests_to_end) {
    struct sigaction action;
    const bool is_ignored = ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
    if (!is_ignored || signal == wake) ::sigaddset(&signals, signal);
  }
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr); // also in later threads, so that one of them can wait for these
  std::thread(end_at, signals).detach();
  handle_crashes();
}

void forget_signals() {
  for (const int signal : requests_to_end) std::signal(signal, SIG_DFL);
  for (const int signal : crashes) std::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

namespace {

/// Opens an unnamed file, in memory if the system supports it.
int open_nameless_file() {
#ifdef __linux__
  return ::memfd_create("equiaffine", MFD_CLOEXEC);
#else
  std::FILE* const file = std::tmpfile();
  if (!file) return -1;
  const int descriptor = ::dup(::fileno(file));
  std::fclose(file);
  return descriptor;
#endif
}

} // namespace

Shared_memory::Shared_memory() : descriptor_(open_nameless_file()) {
  if (descriptor_ == -1) throw std::bad_alloc();
}

Shared_memory::~Shared_memory() {
  if (data_) ::munmap(data_, size_);
  ::close(descriptor_);
}

std::byte* Shared_memory::allocate(std::size_t size) {
  if (::ftruncate(descriptor_, off_t(size)) != 0) {
    if (errno == EFBIG)
      throw Input_error("the limit of file sizes is less than the " + std::to_string(size) +
                        " bytes to pass between processes; raise it with ulimit -f");
    throw std::bad_alloc();
  }
  map(size);
  return data_;
}

const std::byte* Shared_memory::data() {
  struct stat status = {};
  if (!data_ && ::fstat(descriptor_, &status) == 0 && status.st_size > 0) map(std::size_t(status.st_size));
  return data_;
}

void Shared_memory::map(std::size_t size) {
  if (data_) ::munmap(data_, size_);
  data_ = nullptr;
  void* const place = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(place);
  size_ = size;
}

namespace {

using Clock = std::chrono::steady_clock;

/// The first letter of a child's answer; that of an Input_error is followed by its two texts.
constexpr char done = 'd', input_error = 'i', no_memory = 'm', other_exception = 'e';

bool is_child = false;

void set_limit(int resource, double amount) {
  struct rlimit bounds;
  if (::getrlimit(decltype(RLIMIT_AS)(resource), &bounds) != 0) return;
  const bool fits = bounds.rlim_max == RLIM_INFINITY || amount < double(bounds.rlim_max);
  bounds.rlim_cur = fits ? rlim_t(amount) : bounds.rlim_max;
  ::setrlimit(decltype(RLIMIT_AS)(resource), &bounds);
}

/// The size of this process's address space in bytes, or zero if unknown.
double address_space() {
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * double(::sysconf(_SC_PAGE_SIZE));
}

/// Limits this process to `bytes` more than it has, at most the memory of this computer.
void limit_memory(double bytes) {
  if (const double used = address_space(); used > 0) set_limit(RLIMIT_AS, used + std::min(bytes, physical_memory()));
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + written, text.size() - written);
    if (count <= 0) return; // the parent has ended
    written += std::size_t(count);
  }
}

std::string answer_of_task(const std::function<void()>& task) {
  try {
    task();
    return {done};
  } catch (const Input_error& error) {
    return input_error + std::string(error.what()) + '\0' + error.excerpt();
  } catch (const std::bad_alloc&) {
    return {no_memory};
  } catch (const std::exception& error) {
    return other_exception + std::string(error.what());
  } catch (...) {
    return {other_exception};
  }
}

std::string answer_of(const std::function<void()>& task) {
  const std::string answer = answer_of_task(task);
  const std::string lack = lack_of_room_for_scratch_memory(); // libraries replace the exception by their own errors
  return answer.starts_with(done) || lack.empty() ? answer : input_error + lack + '\0';
}

/// Runs the child. It ends with _exit, so that nothing of its parent is flushed, removed or joined.
[[noreturn]] void run_child(const std::function<void()>& task, const Child_limits& limits, int answer) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  forget_signals();
  std::signal(SIGINT, SIG_IGN); // Ctrl-C is sent to both processes, and the parent decides
  if (const int nothing = ::open("/dev/null", O_RDWR); nothing != -1) {
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(nothing, STDERR_FILENO);
  }
  is_child = true;
  // Hides the parent's observer, which may wait for locks of threads that do not exist in the child.
  const Progress_observer nobody([](const Progress_observer::Stage&) {}, std::chrono::hours(1 << 16));
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, std::ceil(limits.seconds));
  write_all(answer, answer_of([&] {
              limit_resident_memory_of_child();
              limit_memory(limits.memory);
              allow_scratch_memory(limits.memory);
              task();
            }));
  ::_exit(0);
}

/// A child process, which is killed when this object is destroyed.
class Child {
public:
  explicit Child(pid_t process) : process_(process) { count_memory_of_child(process); }
  ~Child() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for its end and returns its status.
  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) == -1 && errno == EINTR) {
    }
    process_ = 0;
    count_memory_of_child(0);
    return status;
  }

private:
  pid_t process_;
};

/// The reading end of a pipe.
class Pipe_end {
public:
  explicit Pipe_end(int descriptor) : descriptor_(descriptor) {}
  ~Pipe_end() { ::close(descriptor_); }
  Pipe_end(const Pipe_end&) = delete;
  Pipe_end& operator=(const Pipe_end&) = delete;

  int operator()() const { return descriptor_; }

private:
  const int descriptor_;
};

/// Reads from the pipe until the child closes it; returns false at the deadline. Calls the progress observer twenty
/// times a second.
bool read_until_closed(int pipe, Clock::time_point deadline, std::string& text) {
  std::array<char, 4096> buffer;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    Progress_observer::step();
    pollfd request = {pipe, POLLIN, 0};
    if (::poll(&request, 1, int(std::min<long long>(left, 50))) <= 0) continue;
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count > 0) text.append(buffer.data(), std::size_t(count));
    else if (errno != EINTR) return true;
  }
}

[[noreturn]] void throw_too_slow(const Child_limits& limits) {
  throw Child_failure("took longer than " + std::to_string(std::llround(limits.seconds)) + " s",
                      "the file may be damaged, or the disk too slow: try a copy on a faster disk");
}

[[noreturn]] void throw_answer(const std::string& answer, int status, const Child_limits& limits) {
  if (answer.empty() && WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGXCPU) throw_too_slow(limits);
    throw Child_failure("crashed (" + std::string(::strsignal(WTERMSIG(status))) + ")");
  }
  const std::string text = answer.empty() ? answer : answer.substr(1);
  if (answer.starts_with(no_memory)) throw std::bad_alloc();
  if (answer.starts_with(input_error)) {
    const std::size_t end = text.find('\0');
    throw Input_error(text.substr(0, end), text.substr(end + 1));
  }
  throw Child_failure("failed" + (text.empty() ? "" : " (" + text + ")"));
}

} // namespace

void allow_memory(double bytes) {
  if (!is_child) return;
  allow_scratch_memory(bytes);
  struct rlimit limit;
  const double used = address_space();
  if (used > 0 && ::getrlimit(RLIMIT_AS, &limit) == 0 && used + bytes > double(limit.rlim_cur)) limit_memory(bytes);
}

void run_in_child(const std::function<void()>& task, const Child_limits& limits) {
  std::array<int, 2> pipe;
  const bool has_pipe = ::pipe(pipe.data()) == 0;
  const pid_t child = has_pipe ? ::fork() : -1;
  if (child == -1) {
    const std::string reason = std::generic_category().message(errno);
    if (has_pipe)
      for (const int end : pipe) ::close(end);
    throw Input_error("cannot start a process to read the file (" + reason +
                      "); close other programs or raise the limit of processes");
  }
  if (child == 0) {
    ::close(pipe[0]);
    run_child(task, limits, pipe[1]);
  }
  ::close(pipe[1]);
  Child process(child);
  const Pipe_end end(pipe[0]);
  std::string answer;
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(2 * limits.seconds));
  if (!read_until_closed(end(), Clock::now() + patience, answer)) throw_too_slow(limits);
  const int status = process.wait();
  if (answer != std::string{done}) throw_answer(answer, status, limits);
}

} // namespace equiaffine
