// Starts programs, watches them and ends them. No program outlives the launcher, nor do the children of a program under
// a minder (host/minder.hpp). The launcher notices a program's death at once (by pidfd, not SIGCHLD). The
// terminal's Ctrl-C reaches only the launcher, unless a program has the terminal; the launcher decides what follows.
// Threads: one for all calls; it must live as long as the programs (the kernel ties PR_SET_PDEATHSIG to the thread).
#pragma once

#include <poll.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/program_host.hpp"

namespace skein::cli {

/// From construction to destruction, SIGINT, SIGTERM and SIGHUP (unless it is ignored, as under nohup) become
/// Event::interrupt, and SIGPIPE is ignored.
class Supervisor final : public ProgramHost {
 public:
  Supervisor();
  /// Kills all programs that still run.
  ~Supervisor() override;
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Starts the program in a process group of its own, with status and control pipe. Its stdin is /dev/null, or the
  /// launcher's (ProgramSpec::here).
  void start(const ProgramSpec& spec) override;
  std::vector<Event> wait(std::chrono::milliseconds limit) override;
  /// From now on wait() also returns, perhaps without events, if one of these descriptors is readable. Negative
  /// descriptors have no effect.
  void watch_too(std::vector<int> descriptors) { also_watched_ = std::move(descriptors); }
  /// Also limits this log, to which a part of a program appends (ProgramSpec::most_log_bytes).
  void limit_log(const std::filesystem::path& log, std::uint64_t most_bytes) { also_limited_[log] = most_bytes; }
  void send(const std::string& program, const std::string& line) override;
  /// Closes the program's control pipe: the program reads end-of-file after the last line.
  void hang_up(const std::string& program);
  void signal(const std::string& program, int signal) override;
  bool has_stopped(const std::string& program) override;
  void follow_job_control() override;
  std::vector<Event> end_all(std::chrono::milliseconds grace) override;
  std::vector<std::string> running() const override;
  bool running(const std::string& program) const override { return children_.contains(program); }
  std::vector<std::string> processes() const override { return running(); }
  double cpu_s(const std::string& program) const override;
  double memory_share_mb(const std::string& program) const override;

 private:
  struct Child;
  /// Reads about `most` bytes at most: a program that writes without end must not keep the launcher busy.
  void read_status(Child& child, std::size_t most, std::vector<Event>& events);
  /// Trims the logs to their limits.
  void trim_logs() const;
  /// As poll(), but trims the logs while it waits.
  int poll_and_trim(std::vector<pollfd>& polled, std::chrono::milliseconds limit) const;
  void reap(Child& child, std::vector<Event>& events);
  static void take_terminal_back(const Child& child);
  void signal_all(int signal);

  std::map<std::string, std::unique_ptr<Child>> children_;
  std::vector<int> also_watched_;
  std::map<std::filesystem::path, std::uint64_t> also_limited_;
  int signal_fd_ = -1;
  sigset_t former_mask_{};
  struct sigaction former_pipe_action_ {};
};

/// The signals that end a command: SIGINT, SIGTERM, and SIGHUP unless it is ignored, as under nohup.
sigset_t interrupt_signals();

/// The last `count` lines of a text file, newest last. Reads only the end of a large file and may then return fewer.
/// Shortens very long lines. Empty if there is no such file.
std::vector<std::string> last_lines(const std::filesystem::path& file, std::size_t count);
/// The same as text to append to a message: each line on its own line, indented.
std::string last_lines_below(const std::filesystem::path& file, std::size_t count);

}  // namespace skein::cli
