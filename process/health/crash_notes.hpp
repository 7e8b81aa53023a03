// Where a program was when it crashed, as addresses in its log; cli/debug/crash_trace.hpp gives them names. Linux.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace skein {

namespace crash_notes {
/// The lines: "[skein] crashed: ...", then one for each frame, innermost first: "  at FILE +0x1a2b".
inline constexpr std::string_view kHead = "[skein] crashed:";
inline constexpr std::string_view kFrame = "  at ";
}  // namespace crash_notes

/// From here on SIGSEGV, SIGABRT, SIGFPE, SIGBUS and SIGILL write that to stderr before the process dies of them. Does
/// nothing about signals that somebody else, a sanitizer, handles already. Once, before there are threads.
/// @param folder  where the process then dies, and leaves its core if it may leave one
void note_crashes(const std::filesystem::path& folder);
/// Is called in the handler, when the notes are written: nothing that a signal handler may not do. nullptr: nobody.
void after_crash_notes(void (*call)(int signal));

/// For a thread that may overflow its stack, as long as it lives: another one for the handler. The first thread has
/// one by note_crashes().
class CrashStack {
 public:
  CrashStack();
  ~CrashStack();
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  std::vector<char> memory_;
};
/// From here on the calling thread's notes go to this descriptor. Usual: stderr's.
void note_crashes_in(int fd);

}  // namespace skein
