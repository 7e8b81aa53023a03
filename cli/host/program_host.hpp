// Whoever runs the programs of a fleet for the launcher: each as a process of its own (supervisor.hpp), or all as
// objects of one process (shared_process.hpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

/// File descriptors under which a process finds its end of the two pipes: JSON lines to us, text lines from us.
inline constexpr int kStatusFd = 3;
inline constexpr int kControlFd = 4;
/// And a socket that browsers connect to, where it gets one.
inline constexpr int kViewFd = 5;

struct UserId {
  uid_t uid = 0;
  gid_t gid = 0;
};

struct ProgramSpec {
  std::string name;                            ///< unique; names the log file too
  std::vector<std::string> argv;               ///< argv[0] is the path of the binary
  std::vector<std::string> env;                ///< the whole environment, NAME=VALUE
  std::filesystem::path log;                   ///< takes stdout and stderr; empty: they go where the launcher's go
  bool append_log = false;                     ///< or overwritten
  std::uint64_t most_status_bytes = 64 << 20;  ///< on the status pipe in all; who writes more is cut off
  std::uint64_t most_log_bytes = 64 << 20;     ///< beyond it the log keeps its first half and its newest lines
  std::optional<UserId> user{};                ///< as whom it runs, in no other group; only root can choose
  bool here = false;                           ///< it has the launcher's terminal, or whatever is in its place
  int listener = -1;                           ///< it has this socket of the launcher's as kViewFd
  bool minded = false;                         ///< it may have children, which end with it wherever they went
};

struct ExitStatus {
  int code = 0;
  int signal = 0;               ///< 0 unless a signal ended it
  double peak_memory_mb = 0.0;  ///< largest resident set, shared pages included
  double cpu_s = 0.0;           ///< of all its threads, from its start to its end
  pid_t pid = 0;                ///< of the process that it was
  bool shared = false;          ///< it was no process of its own: memory and time are told of that process
  bool dragged = false;         ///< it ended for no other reason than that its process did
  std::string lost_host = {};   ///< it ran on a host of which nothing is known any more, and why; empty: it ended
  bool ok() const { return code == 0 && signal == 0 && lost_host.empty(); }
  /// "exit code 3", "signal 11 (Segmentation fault)", or what became of its host.
  std::string text() const;
};

struct Event {
  enum class Kind {
    status_line,  ///< `program` wrote `line`
    cut_off,      ///< `program` wrote too much on its status pipe, as `line` says: it is not listened to any more
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
  /// Waits until something happens, at most `limit`. @returns what happened, in order; empty after `limit`. What any
  /// program wrote before another one ended comes before that end.
  virtual std::vector<Event> wait(std::chrono::milliseconds limit) = 0;
  /// Writes one line to a program's control pipe; nothing happens when the program is gone or does not read.
  virtual void send(const std::string& program, const std::string& line) = 0;
  /// Sends a signal to a program and its children; nothing happens when it is gone.
  virtual void signal(const std::string& program, int signal) = 0;
  /// Whether a program has been stopped (SIGSTOP) since this was last true for it.
  virtual bool has_stopped(const std::string& program) = 0;
  /// A program that has the terminal may have been stopped there with Ctrl-Z: then we stop, too, as one job with it,
  /// and both go on together.
  virtual void follow_job_control() {}
  /// SIGTERM to all, SIGKILL to what is left after `grace` or at once when the user interrupts again.
  /// @returns all events until the last program, and the last process, ended.
  virtual std::vector<Event> end_all(std::chrono::milliseconds grace) = 0;
  /// Once no program is left: brings what programs wrote elsewhere to the results folder.
  /// @returns what was left behind, a sentence each.
  virtual std::vector<std::string> collect(const std::filesystem::path&) { return {}; }
  /// Names of the programs that run, in the order of their names.
  virtual std::vector<std::string> running() const = 0;
  virtual bool running(const std::string& program) const = 0;

  /// Names of the processes that run.
  virtual std::vector<std::string> processes() const = 0;
  /// CPU time of a running process so far, all threads [s]; 0 when it does not run.
  virtual double cpu_s(const std::string& process) const = 0;
  /// Its share of the memory that it uses now [MB]: pages that several processes share count in parts (PSS).
  virtual double memory_share_mb(const std::string& process) const = 0;
};

}  // namespace skein::cli
