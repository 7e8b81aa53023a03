// A file whose modification time a running program updates, so that others, such as the health check of a container,
// can detect that the program hangs.   Threads: one.
#pragma once

#include <chrono>
#include <filesystem>

namespace skein {

class Heartbeat {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param file  empty: no heartbeat. If the file cannot be written, there is no error message.
  explicit Heartbeat(std::filesystem::path file) : file_(std::move(file)) {}

  /// Call it in each turn; touches the file at most every two seconds.
  void beat(Clock::time_point now = Clock::now());

 private:
  const std::filesystem::path file_;
  Clock::time_point next_{};
};

}  // namespace skein
