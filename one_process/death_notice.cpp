#include "one_process/death_notice.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "process/health/crash_notes.hpp"
#include "process/program.hpp"
#include "process/status/shared_lines.hpp"
#include "results/run_folder.hpp"

/// Exists only in builds with a sanitizer: sanitizers end the process without a signal.
extern "C" void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

namespace skein::one_process {
namespace {

// A signal handler can access only globals.
thread_local std::atomic<const DeathNotice*> in_turn = nullptr;
std::atomic<int> status_fd = -1;
/// Whether the cause has been reported: two threads may crash at once, and only the first one is the cause.
std::atomic<bool> told = false;

/// Begins with a line end, because the line before it may be incomplete: a pipe takes only what fits.
std::string line_of(const std::string& program, int code, int signal) {
  return "\n" + shared_lines::news_json(shared_lines::Ended{program, code, signal, true}).dump() + "\n";
}

void write_news(const std::string& line) {
  [[maybe_unused]] const ssize_t written = ::write(status_fd.load(), line.data(), line.size());
}

}  // namespace

const std::array<int, 5> DeathNotice::kSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

void tell_of_death(int signal) {
  const DeathNotice* notice = in_turn.exchange(nullptr);
  const auto* const found = std::find(DeathNotice::kSignals.begin(), DeathNotice::kSignals.end(), signal);
  if (notice != nullptr && !told.exchange(true))
    write_news(notice->lines_[static_cast<std::size_t>(found - DeathNotice::kSignals.begin())]);
}

namespace {

extern "C" void on_sanitizer_death() { tell_of_death(SIGABRT); }

/// Called by exit(). Ends the process at once, because other threads still use the objects that exit() would destroy.
void tell_of_exit(int code, void*) {
  const DeathNotice* notice = in_turn.exchange(nullptr);
  if (notice == nullptr) return;
  if (!told.exchange(true)) {
    std::cerr << notice->program() << ": called exit(" << code << "), which ends the whole fleet here" << std::endl;
    write_news(line_of(notice->program(), code == 0 ? kExitProcessFailed : code, 0));
  }
  std::fflush(stdout);
  ::_exit(code);
}

/// Makes tell_of_exit() run before any static object is destroyed. exit() first destroys the thread_local objects of
/// its thread, and calls the functions that these register before all others.
class ExitWatch {
 public:
  ExitWatch() = default;
  ~ExitWatch() {
    if (in_turn.load() != nullptr) ::on_exit(tell_of_exit, nullptr);
  }
  ExitWatch(const ExitWatch&) = delete;
  ExitWatch& operator=(const ExitWatch&) = delete;
  /// Constructs the thread_local object in this thread.
  void begin() const {}
};

thread_local const ExitWatch exit_watch;

}  // namespace

DeathNotice::DeathNotice(const std::string& program, int log) : program_(program), log_(log) {
  for (std::size_t i = 0; i < kSignals.size(); ++i) lines_[i] = line_of(program, 0, kSignals[i]);
}

DeathNotice::~DeathNotice() {
  const DeathNotice* self = this;
  in_turn.compare_exchange_strong(self, nullptr);
}

void DeathNotice::enter() const {
  exit_watch.begin();
  in_turn = this;
}

const DeathNotice* DeathNotice::here() { return in_turn; }

void DeathNotice::watch(int fd) {
  status_fd = fd;
  after_crash_notes(tell_of_death);  // after them: the launcher quotes the log, which must have the notes by then
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(on_sanitizer_death);
}

void DeathNotice::give_up(const std::string& why) const {
  const std::string line = std::string(programs::kOneProcess) + ": " + why + "\n";
  static_cast<void>(!::write(log_ < 0 ? STDERR_FILENO : log_, line.data(), line.size()));
  in_turn = this;  // the turn that does not end is in another thread
  tell_of_death(SIGABRT);
  ::_exit(kExitProcessFailed);
}

void DeathNotice::give_up_at_once() {
  constexpr std::string_view kWhy = "this program did not end its turn, and the whole fleet waits for it\n";
  static_cast<void>(!::write(STDERR_FILENO, kWhy.data(), kWhy.size()));
  tell_of_death(SIGABRT);
  ::_exit(kExitProcessFailed);
}

void DeathNotice::stand_down() { in_turn = nullptr; }

}  // namespace skein::one_process
