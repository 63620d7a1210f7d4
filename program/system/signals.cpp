// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/signals.h"

#include "system/Temporary_folder.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_scheduler_observer.h>
#endif

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <iostream>
#include <pthread.h>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace equiaffine {

namespace {

constexpr std::array requests_to_end = {SIGHUP,  SIGINT,  SIGTERM,   SIGQUIT, SIGALRM,
                                        SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU};
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP};
constexpr int wake = SIGUSR1; ///< what a crash sends to the thread that removes the temporary folders
constexpr std::array errors_of_writing = {SIGPIPE, SIGXFSZ};

/// The signal of the first crash, or zero, and whether the temporary folders have been removed after it.
std::atomic<int> crash = 0;
std::atomic<bool> is_clean = false;

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// Waits for a request to end, removes the temporary folders and ends the process. After a crash, which wakes it by a
/// request, the thread that crashed ends the process.
void end_at(const sigset_t& signals) {
  int signal = 0;
  ::sigwait(&signals, &signal);
  remove_all_temporary_folders();
  if (crash != 0) {
    is_clean = true;
    while (true) ::pause();
  }
  if (::isatty(STDERR_FILENO)) std::cerr << std::endl; // the line that shows the progress ends here
  ::_exit(128 + signal);
}

/// Handles a crash by what is allowed in a handler: another thread removes the temporary folders, if it still can.
extern "C" void report_crash(int signal) {
  constexpr std::string_view report =
      "equiaffine: internal error: the program crashed, which is a defect of it; please "
      "report it with the command line and the input\n";
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

/// Gives the thread a second stack, for a crash whose reason is that the other one is full.
void use_second_stack() {
  constexpr std::size_t size = 1 << 16;
  thread_local std::array<std::byte, size> stack;
  stack_t alternative = {};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
}

#ifdef CGAL_LINKED_WITH_TBB
/// Gives every thread of TBB a second stack as soon as it works for this one.
class Second_stacks : public tbb::task_scheduler_observer {
public:
  Second_stacks() { observe(true); }
  void on_scheduler_entry(bool) override { use_second_stack(); }
};
#endif

void handle_crashes() {
  use_second_stack();
#ifdef CGAL_LINKED_WITH_TBB
  // It is never destroyed, since the threads may outlive the objects of main().
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
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr); // in all threads to come, so that one of them can wait for these
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

} // namespace equiaffine
