// One UAV's share of the strips: which to fly next, and how often each has been flown. What cannot be flown now, since
// nobody has proved the space before it, comes again later.
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

  /// Of those that were flown least often, the one that begins nearest; nullopt: none can be tried now.
  std::optional<std::size_t> next(Tick now, const Vector3d& p_WB) const;
  const Strip& strip(std::size_t number) const { return records_[number].strip; }
  int looks(std::size_t number) const { return records_[number].flown; }
  /// Whether its end is nearer than its beginning.
  bool begins_at_end(std::size_t number, const Vector3d& p_WB) const;

  void flown(std::size_t number) { ++records_[number].flown; }
  /// It could not be flown: something else first.
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
