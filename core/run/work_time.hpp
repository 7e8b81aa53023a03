// Computes how long UAVs were without work. Inputs: the referee's record of each second, and the reports of UAVs that
// they waited for another UAV. Pure; any thread.
//
// The unit of work is the least amount (sim_server/work/work_log.hpp). Only open seconds count: those with work within
// the UAV's reach. In any 60 successive open seconds, even if other seconds lie between them, a UAV must do one least
// amount; otherwise all 60 are without work (frozen). An open second in which the UAV waits for another UAV that itself
// works is excused: it does not count. At most 45 s are excused until the UAV has done another least amount.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace skein {

inline constexpr std::size_t kWorkWindow_s = 60;
inline constexpr std::size_t kMostExcused_s = 45;

/// The referee's record of one UAV: a letter and an amount of work for each whole second since the start of the run.
struct WorkTrack {
  static constexpr char kOpen = '1', kNothingOpen = '0';
  /// The UAV is out of the run, its program is away, or the mission is not running. Afterwards all counts restart at 0.
  static constexpr char kAway = '-';

  std::string open;          ///< by second: kOpen, kNothingOpen or kAway
  std::vector<double> done;  ///< by second: work in least amounts; as long as `open`
};

/// A span of simulated time for which a UAV reported that it waited for another UAV.
struct WaitSpan {
  double from_s = 0.0, until_s = 0.0;
  std::size_t mate = 0;  ///< index of the other UAV
};

struct WorkSecond {
  bool excused = false;          ///< open, but the UAV waited for another UAV that worked
  bool frozen = false;           ///< one of 60 open seconds with less than one least amount of work
  std::size_t without_work = 0;  ///< number of latest open seconds that have less than one least amount of work
  std::optional<std::size_t> waits_for;
};

struct WorkTime {
  std::vector<WorkSecond> seconds;  ///< one for each second of the track
  std::size_t frozen_s = 0, excused_s = 0;
  std::size_t longest_s = 0;  ///< maximum of `without_work`
};

/// @param tracks  of all UAVs, in fleet order.
/// @param waits   by UAV; UAVs without an entry waited for no other. Spans with an unknown mate, or the UAV itself, are
///   ignored.
std::vector<WorkTime> judge_work(std::span<const WorkTrack> tracks, std::span<const std::vector<WaitSpan>> waits);

}  // namespace skein
