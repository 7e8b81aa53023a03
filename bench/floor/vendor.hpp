// Interface of a DDS vendor for the baseline (floor.hpp): endpoints that transport bytes. Each vendor's file implements
// it directly with the vendor's own API and listeners; from Skein it uses only the settings (QoS, loopback, leases).
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "bench/floor/round.hpp"

namespace skein::bench {

/// Counts samples and bytes that arrive on the vendor's threads. One thread may wait for them.
class Arrivals {
 public:
  void add(std::uint64_t samples, std::uint64_t bytes);
  /// Waits until `samples` have arrived in total. @returns false if they have not within `limit`.
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
  /// Number of remote endpoints that this endpoint has matched.
  virtual std::size_t matched() const = 0;
  /// Writers only: sends the flow's payload.
  virtual void write() {}
};

/// One process's entities of a vendor. Joins a domain when the first endpoint in it is opened.
class Vendor {
 public:
  virtual ~Vendor() = default;
  virtual std::unique_ptr<Endpoint> open_writer(const Flow& flow) = 0;
  virtual std::unique_ptr<Endpoint> open_reader(const Flow& flow, Arrivals& arrivals) = 0;
};

/// Each program is linked with one vendor's implementation.
std::unique_ptr<Vendor> make_vendor();

}  // namespace skein::bench
