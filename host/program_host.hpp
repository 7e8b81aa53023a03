// Interface through which the launcher runs the programs of a fleet: each program as a process of its own
// (supervisor.hpp), or all as objects of one process (shared_process.hpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

/// File descriptors at which a program finds its two pipes: on the status pipe it writes JSON lines to the launcher, on
/// the control pipe it reads lines of text from the launcher.
inline constexpr int kStatusFd = 3;
inline constexpr int kControlFd = 4;
/// File descriptor of a listening socket for browsers, if the program has one (ProgramSpec::listener).
inline constexpr int kViewFd = 5;

struct UserId {
  uid_t uid = 0;
  gid_t gid = 0;
};

struct ProgramSpec {
  std::string name;                            ///< unique; the log file is named after it, too
  std::vector<std::string> argv;               ///< argv[0] is the path of the binary
  std::vector<std::string> env;                ///< the whole environment, NAME=VALUE
  std::filesystem::path log;                   ///< for stdout and stderr; empty: the launcher's
  bool append_log = false;                     ///< false: the log is overwritten
  std::uint64_t most_status_bytes = 64 << 20;  ///< in all; beyond it, the launcher closes the status pipe
  std::uint64_t most_log_bytes = 64 << 20;     ///< beyond it, only its first half and newest lines stay
  std::optional<UserId> user{};                ///< user to run as, without other groups; needs root
  bool here = false;                           ///< it has the launcher's stdin, stdout and stderr
  int listener = -1;                           ///< the launcher's socket to pass as kViewFd; -1: none
  bool minded = false;                         ///< it runs under a minder, which ends all its children
};

struct ExitStatus {
  int code = 0;
  int signal = 0;               ///< the signal that ended it; 0: none
  double peak_memory_mb = 0.0;  ///< largest resident set, shared pages included
  double cpu_s = 0.0;           ///< CPU time of all its threads, from start to end [s]
  pid_t pid = 0;                ///< its process id
  bool shared = false;          ///< it was an object in a shared process, whose own exit has memory and CPU time
  bool dragged = false;         ///< no failure of its own: it ended together with a shared process
  std::string lost_host = {};   ///< why the launcher lost contact with the host that ran it; empty: it ended
  bool ok() const { return code == 0 && signal == 0 && lost_host.empty(); }
  /// "exit code 3", "signal 11 (Segmentation fault)", or `lost_host`.
  std::string text() const;
};

struct Event {
  enum class Kind {
    status_line,  ///< `program` wrote `line`
    cut_off,      ///< `program` wrote too much on its status pipe (`line` says what), so the pipe is closed
    exited,       ///< `program` ended with `exit`; its last status lines came before
    interrupt     ///< the user or the system asked the launcher to end (SIGINT, SIGTERM, SIGHUP)
  };
  Kind kind = Kind::status_line;
  std::string program;
  std::string line;
  ExitStatus exit;
};

/// Threads: everything from one thread, which must live as long as the programs.
class ProgramHost {
 public:
  virtual ~ProgramHost() = default;

  /// Starts a program. @throws std::system_error when the log cannot be written or the binary cannot be started.
  virtual void start(const ProgramSpec& spec) = 0;
  /// Waits for events, at most `limit` (negative: without limit). @returns the events in order; none: `limit` has
  /// passed. Everything that any program wrote before another program ended comes before the event of that end.
  virtual std::vector<Event> wait(std::chrono::milliseconds limit) = 0;
  /// Writes one line to a program's control pipe. Does nothing if the program is gone or does not read.
  virtual void send(const std::string& program, const std::string& line) = 0;
  /// Sends a signal to a program and its process group. Does nothing if the program is gone.
  virtual void signal(const std::string& program, int signal) = 0;
  /// Whether a program has been stopped (SIGSTOP, say) since the last call that returned true for it.
  virtual bool has_stopped(const std::string& program) = 0;
  /// If Ctrl-Z has stopped a program that has the terminal, the launcher stops itself, too, so that the shell sees one
  /// stopped job. When the shell continues the launcher, the launcher continues the program.
  virtual void follow_job_control() {}
  /// Sends SIGTERM to all programs, and SIGKILL to those left after `grace`, or at once when the user interrupts.
  /// @returns all events until the last program, and the last process, ended.
  virtual std::vector<Event> end_all(std::chrono::milliseconds grace) = 0;
  /// Copies files that programs wrote elsewhere (on other hosts) to the results folder; call it when no program runs.
  /// @returns one sentence about each thing that could not be copied.
  virtual std::vector<std::string> collect(const std::filesystem::path&) { return {}; }
  /// Names of the running programs, sorted.
  virtual std::vector<std::string> running() const = 0;
  virtual bool running(const std::string& program) const = 0;

  /// Names of the running processes: those of the programs, or that of the shared process.
  virtual std::vector<std::string> processes() const = 0;
  /// CPU time so far of all threads of a process [s]; 0: it does not run.
  virtual double cpu_s(const std::string& process) const = 0;
  /// Proportional set size (PSS) of a process now [MB]: each shared page is divided among the processes that share it.
  virtual double memory_share_mb(const std::string& process) const = 0;
};

}  // namespace skein::cli
