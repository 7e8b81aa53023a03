// Writes the call stack of a crashed program, as addresses, to its log; debug/crash_trace.hpp translates the
// addresses to names. Linux.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace skein {

namespace crash_notes {
/// Beginnings of the lines: "[skein] crashed: ...", then one for each frame, innermost first: "  at FILE +0x1a2b".
inline constexpr std::string_view kHead = "[skein] crashed:";
inline constexpr std::string_view kFrame = "  at ";
}  // namespace crash_notes

/// Installs handlers for SIGSEGV, SIGABRT, SIGFPE, SIGBUS and SIGILL that write these lines to stderr before the signal
/// kills the process. Keeps existing handlers, such as those of a sanitizer. Call it once, before threads are started.
/// @param folder  working directory in which the process then dies, and in which it may leave a core file
void note_crashes(const std::filesystem::path& folder);
/// Sets a function that the signal handler calls after writing the lines; it must be async-signal-safe. nullptr: none.
void after_crash_notes(void (*call)(int signal));

/// While an object of this class exists, signal handlers in its thread run on a separate stack, so that they work after
/// a stack overflow. For all threads but the first, which gets such a stack from note_crashes().
class CrashStack {
 public:
  CrashStack();
  ~CrashStack();
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  std::vector<char> memory_;
};
/// From now on the calling thread's crash notes go to this file descriptor. Default: stderr.
void note_crashes_in(int fd);

}  // namespace skein
