// Helpers that the bus contract tests share.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "tests/support/eventually.hpp"

namespace skein::test {

using Bytes = std::vector<std::uint8_t>;

/// A topic of a type that has no compiled support: a backend knows only its name.
inline bus::TopicSpec topic(const std::string& name, const bus::Qos& qos = {}) {
  return {"rt/" + name, "nobody_knows::msg::dds_::Thing_", qos};
}

/// A payload that begins with a number and is `size` bytes long, without its encapsulation header of 4 bytes.
inline Bytes numbered(std::uint64_t number, std::size_t size = 8) {
  Bytes payload(4 + size);
  payload[1] = 1;  // CDR_LE
  for (std::size_t i = 4; i < payload.size(); ++i) payload[i] = static_cast<std::uint8_t>((number + i) * 31);
  std::memcpy(payload.data() + 4, &number, sizeof number);
  return payload;
}

inline std::uint64_t number_of(std::span<const std::uint8_t> payload) {
  std::uint64_t number = 0;
  std::memcpy(&number, payload.data() + 4, sizeof number);
  return number;
}

/// Collects the samples of a reader.   Threads: any.
class Collector {
 public:
  bus::OnSample callback() {
    return [this](bus::Sample&& sample) {
      const std::scoped_lock lock(mutex_);
      samples_.push_back(std::move(sample));
      arrived_.notify_all();
    };
  }

  /// @returns all samples so far, once there are `count`, or after kPatience
  std::vector<bus::Sample> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, kPatience, [&] { return samples_.size() >= count; });
    return samples_;
  }

  std::vector<std::uint64_t> numbers(std::size_t count) {
    std::vector<std::uint64_t> numbers;
    for (const auto& sample : wait_for(count)) numbers.push_back(number_of(sample.payload));
    return numbers;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<bus::Sample> samples_;
};

/// The vendors at the two ends of a test.
struct Pair {
  std::string writer, reader;
};

inline std::string name_of(const Pair& pair) {
  return pair.writer == pair.reader ? pair.writer : pair.writer + "_to_" + pair.reader;
}

}  // namespace skein::test
