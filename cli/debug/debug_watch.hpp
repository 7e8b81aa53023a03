// Under --debug a program is started by the user, or by its debugger: its end is no child's end that the kernel would
// tell us of, and the debugger may well live on. So its process is looked for by its command line, or for a user's
// command by its environment, and watched.   Threads: one.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "cli/debug/debuggee.hpp"

namespace skein::cli {

class DebugWatch {
 public:
  /// Nobody announces that it starts: how often to look.
  static constexpr std::chrono::milliseconds kPeriod{200};

  /// @param out  the results folder, as it stands in the program's command line. @param file  the program
  DebugWatch(Debuggee debuggee, std::filesystem::path out, std::filesystem::path file);
  ~DebugWatch();
  DebugWatch(const DebugWatch&) = delete;
  DebugWatch& operator=(const DebugWatch&) = delete;

  /// @returns true once for each debugged program that has been seen and has ended; the user may start another one.
  bool ended();
  /// @returns true once for each debugged program that is there.
  bool appeared();
  /// Waits at most so long for the end of the one that is there.
  void await_end(std::chrono::milliseconds timeout) const;
  /// Of the last one seen; 0: none yet.
  pid_t pid() const { return pid_; }
  const Debuggee& debuggee() const { return debuggee_; }

 private:
  bool is_agent_process(pid_t pid) const;
  bool is_command_process(pid_t pid) const;
  bool is_debugged(pid_t pid) const { return is_agent_process(pid) || is_command_process(pid); }
  void look();

  const Debuggee debuggee_;
  const std::string out_, file_;
  pid_t pid_ = 0;
  bool told_ = true;
  int fd_ = -1;  ///< its pidfd
};

}  // namespace skein::cli
