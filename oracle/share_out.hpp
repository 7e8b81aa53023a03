// Distributes independent pieces of work over a few threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace skein::sim {

/// Calls `work(i)` once for each i < `count`, in any order and on any thread: the calls must not depend on each other,
/// and must not throw. Returns when all are done.
/// @param threads  number of threads, including the caller's; 0 counts as 1.
void share_out(std::size_t count, unsigned threads, const auto& work) {
  std::atomic<std::size_t> next = 0;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(take);
  take();
}

}  // namespace skein::sim
