// Starts programs, watches them and ends them. A program never outlives the launcher, nor do the children of one that
// is minded (cli/run/minder.hpp), its death is noticed at once
// (pidfd, not SIGCHLD), and the terminal's Ctrl-C reaches the launcher alone: what to do about it is decided there.
// Threads: everything from one thread, which must live as long as the programs (PR_SET_PDEATHSIG goes by thread).
#pragma once

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace skein::cli {

/// File descriptors under which a program finds its end of the two pipes: JSON lines to us, text lines from us.
inline constexpr int kStatusFd = 3;
inline constexpr int kControlFd = 4;

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
  std::optional<UserId> user{};                ///< as whom it runs, in no other group; only root can choose
  bool minded = false;                         ///< it may have children, which end with it wherever they went
};

struct ExitStatus {
  int code = 0;
  int signal = 0;               ///< 0 unless a signal ended it
  double peak_memory_mb = 0.0;  ///< largest resident set, shared pages included
  double cpu_s = 0.0;           ///< of all its threads, from its start to its end
  bool ok() const { return code == 0 && signal == 0; }
  /// "exit code 3" or "signal 11 (Segmentation fault)".
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

/// From construction to destruction SIGINT, SIGTERM and SIGHUP (unless nohup had it ignored) become Event::interrupt,
/// and SIGPIPE is ignored.
class Supervisor {
 public:
  Supervisor();
  /// Kills whatever still runs.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Starts a program in a process group of its own, stdin closed, both pipes open.
  /// @throws std::system_error when the log cannot be written or the binary cannot be started.
  void start(const ProgramSpec& spec);

  /// Waits until something happens, at most `limit`. @returns what happened, in order; empty after `limit`. What any
  /// program wrote before another one ended comes before that end.
  std::vector<Event> wait(std::chrono::milliseconds limit);

  /// Writes one line to a program's control pipe; nothing happens when the program is gone or does not read.
  void send(const std::string& program, const std::string& line);

  /// Sends a signal to a program and its children; nothing happens when it is gone.
  void signal(const std::string& program, int signal);
  /// Whether a program has been stopped (SIGSTOP) since this was last true for it.
  bool has_stopped(const std::string& program);

  /// SIGTERM to all, SIGKILL to what is left after `grace` or at once when the user interrupts again.
  /// @returns all events until the last program ended.
  std::vector<Event> end_all(std::chrono::milliseconds grace);

  bool running(const std::string& program) const { return children_.contains(program); }
  /// CPU time of a running program so far, all threads [s]; 0 when it does not run.
  double cpu_s(const std::string& program) const;
  /// Its share of the memory that it uses now [MB]: pages that several programs share count in parts (PSS).
  double memory_share_mb(const std::string& program) const;
  /// Names of the programs that run, in the order of their names.
  std::vector<std::string> running() const;

 private:
  struct Child;
  /// At most `most` bytes: a program that writes without end must not keep the launcher from all else.
  void read_status(Child& child, std::size_t most, std::vector<Event>& events);
  void reap(Child& child, std::vector<Event>& events);
  static void signal_child(const Child& child, int signal);
  void signal_all(int signal);

  std::map<std::string, std::unique_ptr<Child>> children_;
  int signal_fd_ = -1;
  sigset_t former_mask_{};
  struct sigaction former_pipe_action_ {};
};

/// The last lines of a text file, newest last, without what is long ago in a huge one; empty when there is no such
/// file.
std::vector<std::string> last_lines(const std::filesystem::path& file, std::size_t count);

}  // namespace skein::cli
