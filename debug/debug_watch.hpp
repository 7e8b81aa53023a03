// Watches a program under --debug. The user or the debugger starts it, so it is not the launcher's child: the kernel
// does not report its end to the launcher, and the debugger may outlive it. DebugWatch finds its process by its command
// line (a user's command: by its environment) and watches it by pidfd.   Threads: one.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "debug/debuggee.hpp"

namespace skein::cli {

class DebugWatch {
 public:
  /// How often to look for the process: nothing announces its start.
  static constexpr std::chrono::milliseconds kPeriod{200};

  /// @param out  the results folder, as in the program's command line. @param file  the program's binary
  DebugWatch(Debuggee debuggee, std::filesystem::path out, std::filesystem::path file);
  ~DebugWatch();
  DebugWatch(const DebugWatch&) = delete;
  DebugWatch& operator=(const DebugWatch&) = delete;

  /// @returns true once for each debugged process that was seen and has ended; the user may then start another one.
  bool ended();
  /// @returns true once for each debugged process that has appeared.
  bool appeared();
  /// Waits at most `timeout` for the end of the present process; returns at once if there is none.
  void await_end(std::chrono::milliseconds timeout) const;
  /// Process id of the last one seen; 0: none yet.
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
  int fd_ = -1;  ///< pidfd of the present process; -1: none
};

}  // namespace skein::cli
