// Delivery of captures: on-board custody from the camera to the station's acknowledgement.
// Every report is kept until the station acknowledges it, and sent whenever there is a *direct* link to the
// station: nobody relays. Units: bytes and exchanges.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/scoring/score_table.hpp"

namespace skein::agent {

/// A capture report that the camera handed out. The report itself stays with whoever feeds the uplink.
struct HandedOut {
  std::uint64_t capture = 0;  ///< 0, 1, ... for this UAV
  std::size_t bytes = 0;      ///< of the report, serialised
};

class Uplink {
 public:
  struct Config {
    std::size_t max_bytes_per_step = 200'000;  ///< at least one report goes out, whatever its size
    std::uint64_t resend_after_steps = kResendSteps;
  };

  Uplink() : Uplink(Config()) {}
  explicit Uplink(const Config& config) : config_(config) {}

  /// Takes custody. A report that is held or was acknowledged before is ignored, so the camera may repeat itself.
  void take(const std::vector<HandedOut>& reports);
  /// The station has them for good.
  void acknowledge(const std::vector<std::uint64_t>& captures);
  /// Captures whose reports are to be sent at exchange k: the oldest first, none without a link.
  std::vector<std::uint64_t> send(std::uint64_t k, bool station_linked);

  std::size_t undelivered() const { return held_.size(); }
  /// Whether a capture's report may yet have to be sent.
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
