// Communication between the launcher and its programs besides the bus: lines of text over inherited file descriptors. A
// program reports with StatusPipe (--status-fd) and receives orders with ControlPipe (--control-fd). Without a launcher
// both do nothing.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>

namespace skein {

/// Writes JSON objects, one per line. Any thread.
class StatusPipe {
 public:
  /// @param fd  open for writing; negative: nothing is sent. The destructor does not close it. From now on, the process
  ///   ignores SIGPIPE. @throws std::runtime_error if `fd` is not open.
  explicit StatusPipe(int fd);
  /// For one of several programs of this process that share a pipe: its lines also contain its name
  /// (process/status/shared_lines.hpp).
  StatusPipe(const StatusPipe& shared, std::string program);
  bool is_open() const { return pipe_->fd >= 0; }

  /// Never waits: if the pipe is full because the reader is slow, the whole line is dropped. A closed reader is no
  /// error.
  void send(const nlohmann::json& message);
  /// For messages that must not be lost, such as a result: waits until the pipe has taken the line, or its reader is
  /// gone.
  void send_surely(const nlohmann::json& message);

 private:
  struct Pipe {
    /// Writes as much of `unsent` as the pipe takes. @returns true if nothing is left.
    bool flush();

    const int fd;
    std::mutex mutex = {};
    std::string unsent = {};  ///< rest of a line that was written only in part
  };

  std::string line_of(const nlohmann::json& message) const;

  const std::shared_ptr<Pipe> pipe_;
  const std::string program_;  ///< empty: the program does not share the pipe
};

/// Reads lines in a thread of its own and calls a callback in this thread with each line, without the end of line.
class ControlPipe {
 public:
  /// @param fd  open for reading; negative: there are no lines. The destructor does not close it.
  /// @param on_line  called for each line; may be called until the destructor returns.
  /// @param on_end  called once when the other end closes: the launcher is gone.
  ControlPipe(int fd, std::function<void(const std::string&)> on_line, std::function<void()> on_end = {});
  ~ControlPipe();
  ControlPipe(const ControlPipe&) = delete;
  ControlPipe& operator=(const ControlPipe&) = delete;

 private:
  void run();

  const int fd_;
  const std::function<void(const std::string&)> on_line_;
  const std::function<void()> on_end_;
  int stop_fd_ = -1;  ///< eventfd: the destructor wakes the thread
  std::thread thread_;
};

}  // namespace skein
