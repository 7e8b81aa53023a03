// How the launcher and its programs talk besides the bus: one line of text each, over inherited file
// descriptors. A program reports with StatusPipe (--status-fd) and takes orders with ControlPipe
// (--control-fd). Without a launcher both do nothing.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>

namespace skein {

/// Writes JSON objects, one a line. Any thread.
class StatusPipe {
 public:
  /// @param fd open for writing; negative: nothing is sent. Not closed by this. SIGPIPE is ignored from here on.
  explicit StatusPipe(int fd);
  /// One of several programs in this process, which share a pipe: what it sends is wrapped
  /// (process/status/shared_lines.hpp).
  StatusPipe(const StatusPipe& shared, std::string program);
  bool is_open() const { return pipe_->fd >= 0; }

  /// Never waits: what does not fit because the reader is slow is dropped, always by whole lines. A reader that has
  /// gone is no error.
  void send(const nlohmann::json& message);
  /// For what must not be lost, such as a result: waits until the reader has taken it or is gone.
  void send_surely(const nlohmann::json& message);

 private:
  struct Pipe {
    /// Writes what it can of `unsent`; true when nothing is left.
    bool flush();

    const int fd;
    std::mutex mutex = {};
    std::string unsent = {};  ///< rest of a line that the pipe took only in part
  };

  std::string line_of(const nlohmann::json& message) const;

  const std::shared_ptr<Pipe> pipe_;
  const std::string program_;  ///< empty: alone
};

/// Reads lines in a thread of its own and hands each, without its end, to a callback there.
class ControlPipe {
 public:
  /// @param fd open for reading; negative: nothing ever comes. Not closed by this.
  /// @param on_line called for each line; may be called until the destructor returns.
  /// @param on_end called once when the other end closes: the launcher is gone.
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
