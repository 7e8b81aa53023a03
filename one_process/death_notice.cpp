#include "one_process/death_notice.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "process/program.hpp"
#include "process/run_folder.hpp"
#include "process/shared_lines.hpp"

/// Of the sanitizers, where the program is built with one: they end the process without any signal.
extern "C" void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

namespace skein::one_process {
namespace {

// A signal handler can reach nothing but globals.
std::atomic<const DeathNotice*> in_turn = nullptr;
std::atomic<int> status_fd = -1;
std::array<struct sigaction, 5> former_actions{};

/// The line before it may be torn: a pipe takes what fits.
std::string line_of(const std::string& program, int code, int signal) {
  return "\n" + shared_lines::news_json(shared_lines::Ended{program, code, signal, true}).dump() + "\n";
}

void write_news(const std::string& line) {
  [[maybe_unused]] const ssize_t written = ::write(status_fd.load(), line.data(), line.size());
}

/// A planner that has overflowed the stack has none left to handle that on.
void use_own_signal_stack() {
  stack_t stack{};
  if (::sigaltstack(nullptr, &stack) != 0 || (stack.ss_flags & SS_DISABLE) == 0) return;  // a sanitizer has
  static std::vector<char> memory(std::size_t{64} << 10);
  stack = {.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
  ::sigaltstack(&stack, nullptr);
}

}  // namespace

const std::array<int, 5> DeathNotice::kSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

void tell_of_death(int signal) {
  const DeathNotice* notice = in_turn.exchange(nullptr);
  const auto* const found = std::find(DeathNotice::kSignals.begin(), DeathNotice::kSignals.end(), signal);
  if (notice != nullptr) write_news(notice->lines_[static_cast<std::size_t>(found - DeathNotice::kSignals.begin())]);
}

namespace {

// Dies of it then, as it would have without us.
extern "C" void on_deadly_signal(int signal) {
  tell_of_death(signal);
  const auto* const found = std::find(DeathNotice::kSignals.begin(), DeathNotice::kSignals.end(), signal);
  ::sigaction(signal, &former_actions[static_cast<std::size_t>(found - DeathNotice::kSignals.begin())], nullptr);
  ::raise(signal);
}

extern "C" void on_sanitizer_death() { tell_of_death(SIGABRT); }

}  // namespace

DeathNotice::DeathNotice(const std::string& program) : program_(program) {
  for (std::size_t i = 0; i < kSignals.size(); ++i) lines_[i] = line_of(program, 0, kSignals[i]);
}

DeathNotice::~DeathNotice() {
  const DeathNotice* self = this;
  in_turn.compare_exchange_strong(self, nullptr);
}

void DeathNotice::enter() const { in_turn = this; }

void DeathNotice::watch(int fd) {
  status_fd = fd;
  use_own_signal_stack();
  struct sigaction action {};
  action.sa_handler = on_deadly_signal;
  action.sa_flags = SA_ONSTACK;
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &former_actions[i]);
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(on_sanitizer_death);
  ::on_exit(
      [](int code, void*) {
        const DeathNotice* notice = in_turn.exchange(nullptr);
        if (notice == nullptr) return;
        std::cerr << notice->program_ << ": called exit(" << code << "), which ends the whole fleet here" << std::endl;
        write_news(line_of(notice->program_, code == 0 ? kExitProcessFailed : code, 0));
      },
      nullptr);
}

void DeathNotice::give_up(const std::string& why) {
  std::cerr << programs::kOneProcess << ": " << why << std::endl;
  tell_of_death(SIGABRT);
  ::_exit(kExitProcessFailed);
}

void DeathNotice::stand_down() { in_turn = nullptr; }

}  // namespace skein::one_process
