// Starts programs, watches them and ends them. A program never outlives the launcher, nor do the children of one that
// is minded (cli/host/minder.hpp), its death is noticed at once
// (pidfd, not SIGCHLD), and the terminal's Ctrl-C reaches the launcher alone: what to do about it is decided there.
// Threads: everything from one thread, which must live as long as the programs (PR_SET_PDEATHSIG goes by thread).
#pragma once

#include <poll.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/host/program_host.hpp"

namespace skein::cli {

/// From construction to destruction SIGINT, SIGTERM and SIGHUP (unless nohup had it ignored) become Event::interrupt,
/// and SIGPIPE is ignored.
class Supervisor final : public ProgramHost {
 public:
  Supervisor();
  /// Kills whatever still runs.
  ~Supervisor() override;
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// In a process group of its own, stdin closed, both pipes open.
  void start(const ProgramSpec& spec) override;
  std::vector<Event> wait(std::chrono::milliseconds limit) override;
  /// wait() returns, with events or without, as soon as one of these can be read. Negative ones are none.
  void watch_too(std::vector<int> descriptors) { also_watched_ = std::move(descriptors); }
  void send(const std::string& program, const std::string& line) override;
  /// There will be no more lines for it.
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
  /// At most `most` bytes: a program that writes without end must not keep the launcher from all else.
  void read_status(Child& child, std::size_t most, std::vector<Event>& events);
  /// poll(), in which logs are kept within their limits.
  int poll_and_trim(std::vector<pollfd>& polled, std::chrono::milliseconds limit) const;
  void reap(Child& child, std::vector<Event>& events);
  static void signal_child(const Child& child, int signal);
  static void take_terminal_back(const Child& child);
  void signal_all(int signal);

  std::map<std::string, std::unique_ptr<Child>> children_;
  std::vector<int> also_watched_;
  int signal_fd_ = -1;
  sigset_t former_mask_{};
  struct sigaction former_pipe_action_ {};
};

/// What ends a command: SIGINT, SIGTERM, and SIGHUP unless nohup had it ignored.
sigset_t interrupt_signals();

/// The last lines of a text file, newest last, without what is long ago in a huge one; empty when there is no such
/// file.
std::vector<std::string> last_lines(const std::filesystem::path& file, std::size_t count);
/// The same for the end of a message: each on a line of its own, indented.
std::string last_lines_below(const std::filesystem::path& file, std::size_t count);

}  // namespace skein::cli
