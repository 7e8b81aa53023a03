// Queue of the launcher's orders, from the thread that reads them to the thread that executes them.
#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "process/status/shared_lines.hpp"

namespace skein::one_process {

/// Any thread.
class OrderQueue {
 public:
  void add(const std::string& line) {
    const auto order = shared_lines::read_order(line);
    if (!order) return spdlog::warn("unknown order: {}", line);
    const std::scoped_lock lock(mutex_);
    orders_.push_back(*order);
    changed_.notify_one();
  }
  /// Call it when there will be no more orders.
  void end() {
    const std::scoped_lock lock(mutex_);
    over_ = true;
    changed_.notify_one();
  }

  std::vector<shared_lines::Order> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(orders_, {});
  }
  /// Whether end() was called and all orders are taken.
  bool over() {
    const std::scoped_lock lock(mutex_);
    return over_ && orders_.empty();
  }
  /// Waits until there is an order or end() was called, but at most `longest`.
  void wait(std::chrono::microseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return over_ || !orders_.empty(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<shared_lines::Order> orders_;
  bool over_ = false;
};

}  // namespace skein::one_process
