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

/// Of the sanitizers, where the program is built with one: they end the process without any signal.
extern "C" void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

namespace skein::one_process {
namespace {

// A signal handler can reach nothing but globals.
thread_local std::atomic<const DeathNotice*> in_turn = nullptr;
std::atomic<int> status_fd = -1;
/// Two threads may crash at once; the process dies of the first.
std::atomic<bool> told = false;

/// The line before it may be torn: a pipe takes what fits.
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

/// Ends the process at once: what exit() would destroy, other threads still fly with.
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

/// exit() destroys what is its thread's own before anything of the process. What is registered then runs first of all,
/// however late a static object was made.
class ExitWatch {
 public:
  ExitWatch() = default;
  ~ExitWatch() {
    if (in_turn.load() != nullptr) ::on_exit(tell_of_exit, nullptr);
  }
  ExitWatch(const ExitWatch&) = delete;
  ExitWatch& operator=(const ExitWatch&) = delete;
  /// Makes it, in this thread.
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
  after_crash_notes(tell_of_death);  // whose log the launcher then quotes has all of them
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(on_sanitizer_death);
}

void DeathNotice::give_up(const std::string& why) const {
  const std::string line = std::string(programs::kOneProcess) + ": " + why + "\n";
  static_cast<void>(!::write(log_ < 0 ? STDERR_FILENO : log_, line.data(), line.size()));
  in_turn = this;  // the one that does not end is another thread's
  tell_of_death(SIGABRT);
  ::_exit(kExitProcessFailed);
}

void DeathNotice::give_up_at_once() {
  constexpr std::string_view kWhy = "this program did not end its turn, and with it stands the fleet\n";
  static_cast<void>(!::write(STDERR_FILENO, kWhy.data(), kWhy.size()));
  tell_of_death(SIGABRT);
  ::_exit(kExitProcessFailed);
}

void DeathNotice::stand_down() { in_turn = nullptr; }

}  // namespace skein::one_process
