// One UAV's share of the strips: which to fly next, and how often each was flown. A strip that cannot be flown now,
// because the space in front of it is not proved free yet, is offered again later.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/planning/work_share.hpp"

namespace skein::agent {

class OwnStrips {
 public:
  OwnStrips() = default;
  explicit OwnStrips(const WorkShare& share);

  /// Of the strips that were flown least often, the one with the nearest end point; nullopt: all failed recently.
  std::optional<std::size_t> next(Tick now, const Vector3d& p_WB) const;
  const Strip& strip(std::size_t number) const { return records_[number].strip; }
  /// How often the strip was flown.
  int times_flown(std::size_t number) const { return records_[number].flown; }
  /// Whether the strip's end is nearer than its beginning, so that it should be flown in reverse.
  bool begins_at_end(std::size_t number, const Vector3d& p_WB) const;

  void flown(std::size_t number) { ++records_[number].flown; }
  /// The strip could not be flown: it is not offered again for 15 s.
  void failed(std::size_t number, Tick now);

 private:
  struct Record {
    Strip strip;
    int flown = 0;
    Tick not_before = 0;
  };
  std::vector<Record> records_;
};

}  // namespace skein::agent
