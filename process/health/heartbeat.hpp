// A file that is touched as long as a program takes its turns, for whoever asks whether it hangs, such as the health
// check of a container.   Threads: one.
#pragma once

#include <chrono>
#include <filesystem>

namespace skein {

class Heartbeat {
 public:
  /// @param file  empty: nobody asks. A file that cannot be written is as good as none.
  explicit Heartbeat(std::filesystem::path file) : file_(std::move(file)) {}

  /// To be called again and again; touches the file every other second at most.
  void beat();

 private:
  using Clock = std::chrono::steady_clock;

  const std::filesystem::path file_;
  Clock::time_point next_{};
};

}  // namespace skein
