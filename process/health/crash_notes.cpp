#include "process/health/crash_notes.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace skein {
namespace {

constexpr std::array kDeadly = {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL};
constexpr int kMostFrames = 64;
constexpr std::size_t kHandlerStack = std::size_t{64} << 10;
std::atomic<void (*)(int)> last_call = nullptr;
std::string& last_folder() {
  static std::string folder;
  return folder;
}

thread_local int notes_fd = STDERR_FILENO;

// The functions below run in a signal handler: they allocate no memory and write only with write(2).
void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(notes_fd, text.data(), text.size());
}

void say_number(std::uintptr_t number, unsigned base) {
  std::array<char, 20> digits{};
  std::size_t at = digits.size();
  do {
    digits[--at] = "0123456789abcdef"[number % base];
    number /= base;
  } while (number != 0);
  say({&digits[at], digits.size() - at});
}

/// Writes one frame: the address of the call, one byte before the return address; for the frame in which the signal
/// occurred, the address itself.
void say_frame(void* address, bool hit) {
  Dl_info info{};
  if (::dladdr(address, &info) == 0) return;
  say(crash_notes::kFrame);
  say(info.dli_fname);
  say(" +0x");
  say_number(
      reinterpret_cast<std::uintptr_t>(address) - reinterpret_cast<std::uintptr_t>(info.dli_fbase) - (hit ? 0 : 1), 16);
  say("\n");
}

extern "C" void on_crash(int signal, siginfo_t*, void* context) {
  std::array<void*, kMostFrames> frames{};
  const int count = ::backtrace(frames.data(), kMostFrames);
  void* hit = reinterpret_cast<void*>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
  say("\n");
  say(crash_notes::kHead);
  say(" signal ");
  say_number(static_cast<std::uintptr_t>(signal), 10);
  say("\n");
  const auto* const end = frames.data() + count;
  const auto* const first = std::find(frames.data(), frames.data() + count, hit);  // after the handler's own frames
  for (const auto* frame = first == end ? frames.data() : first; frame != end; ++frame)
    say_frame(*frame, *frame == hit);
  if (auto* const call = last_call.exchange(nullptr)) call(signal);
  [[maybe_unused]] const int changed = ::chdir(last_folder().c_str());
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

void note_crashes(const std::filesystem::path& folder) {
  last_folder() = std::filesystem::absolute(folder);
  std::array<void*, 1> any{};
  ::backtrace(any.data(), 1);                      // the first call loads a library
  static std::vector<char> memory(kHandlerStack);  // after an overflow, the normal stack has no space left
  const stack_t stack{.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
  struct sigaction action {
  }, former{};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (const int signal : kDeadly) {
    if (::sigaction(signal, nullptr, &former) != 0 || former.sa_handler != SIG_DFL) continue;
    if (signal == SIGSEGV) ::sigaltstack(&stack, nullptr);
    ::sigaction(signal, &action, nullptr);
  }
}

void after_crash_notes(void (*call)(int signal)) { last_call = call; }

CrashStack::CrashStack() : memory_(kHandlerStack) {
  const stack_t stack{.ss_sp = memory_.data(), .ss_flags = 0, .ss_size = memory_.size()};
  ::sigaltstack(&stack, nullptr);
}

CrashStack::~CrashStack() {
  const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
  ::sigaltstack(&none, nullptr);
}

void note_crashes_in(int fd) { notes_fd = fd; }

}  // namespace skein
