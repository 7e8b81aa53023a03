// What the floor asks of a DDS vendor: endpoints that carry bytes. Each vendor's file implements it straight on the
// vendor's own API, with listeners, and with nothing of Skein's but its settings (QoS, loopback, leases).
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "bench/floor/round.hpp"

namespace skein::bench {

/// Counts what arrives on the vendor's threads, for the one thread that waits for it.
class Arrivals {
 public:
  void add(std::uint64_t samples, std::uint64_t bytes);
  /// @returns false when `samples` in all have not arrived within `limit`.
  bool wait_for(std::uint64_t samples, std::chrono::milliseconds limit);
  std::uint64_t bytes() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t samples_ = 0, bytes_ = 0, wanted_ = 0;
};

class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Endpoints at the other side that have been found.
  virtual std::size_t matched() const = 0;
  /// Writers only: sends the flow's payload.
  virtual void write() {}
};

/// One process's share of a vendor; joins a domain with its first endpoint there.
class Vendor {
 public:
  virtual ~Vendor() = default;
  virtual std::unique_ptr<Endpoint> open_writer(const Flow& flow) = 0;
  virtual std::unique_ptr<Endpoint> open_reader(const Flow& flow, Arrivals& arrivals) = 0;
};

/// Implemented once in each program, by the vendor that it is linked with.
std::unique_ptr<Vendor> make_vendor();

}  // namespace skein::bench
