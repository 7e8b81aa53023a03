// Delivery of captures: on-board custody from the camera to the station's acknowledgement.
// The uplink holds every report until the station acknowledges it, and sends it while there is a *direct* link to the
// station: other UAVs do not relay reports. Units: bytes and exchanges.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/scoring/score_table.hpp"

namespace skein::agent {

/// A capture report that the camera handed out. The caller of the uplink keeps the report itself.
struct HandedOut {
  std::uint64_t capture = 0;  ///< number of the capture: 0, 1, ... for this UAV
  std::size_t bytes = 0;      ///< size of the serialised report
};

class Uplink {
 public:
  struct Config {
    std::size_t max_bytes_per_step = 200'000;         ///< the first report may exceed it; chosen
    std::uint64_t resend_after_steps = kResendSteps;  ///< exchanges without acknowledgement, then it is sent again
  };

  Uplink() : Uplink(Config()) {}
  explicit Uplink(const Config& config) : config_(config) {}

  /// Takes custody of reports. The camera may repeat reports: those that are held or acknowledged already are ignored.
  void take(const std::vector<HandedOut>& reports);
  /// Call it when the station has stored these captures: custody ends.
  void acknowledge(const std::vector<std::uint64_t>& captures);
  /// Captures whose reports are to be sent at exchange k, the oldest first; none without a link.
  std::vector<std::uint64_t> send(std::uint64_t k, bool station_linked);

  std::size_t undelivered() const { return held_.size(); }
  /// Whether a capture's report is in custody: taken, and not acknowledged.
  bool holds(std::uint64_t capture) const { return held_.contains(capture); }

 private:
  struct Held {
    std::size_t bytes = 0;  ///< of the report
    bool sent = false;
    std::uint64_t sent_at = 0;  ///< exchange of the last attempt
  };
  bool is_acknowledged(std::uint64_t capture) const;

  const Config config_;
  std::map<std::uint64_t, Held> held_;  ///< by capture number
  /// Acknowledged capture numbers as disjoint ranges, first -> last: stays small however long the mission.
  std::map<std::uint64_t, std::uint64_t> acknowledged_;
};

}  // namespace skein::agent
