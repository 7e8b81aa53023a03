// How long UAVs went without work, from what the referee wrote down of each second and from whom they said they waited
// for. Pure; any thread.
//
// Work is counted in least amounts (sim_server/work/work_log.hpp). Only open seconds count: those in which there was
// work within a UAV's reach. Of any 60 of them that follow each other, whatever lies between them, one least amount is
// asked; all seconds of 60 that hold less are without work. A second of waiting does not count, as if nothing had been
// open, while the mate that the UAV waits for works itself, for 45 s at most until the UAV works again.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace skein {

inline constexpr std::size_t kWorkWindow_s = 60;
inline constexpr std::size_t kMostExcused_s = 45;

/// What the referee wrote down of one UAV: a letter and a number for each whole second since the start of the run.
struct WorkTrack {
  static constexpr char kOpen = '1', kNothingOpen = '0';
  /// It is out, its program is away, or the mission is not on: all begins anew then.
  static constexpr char kAway = '-';

  std::string open;
  std::vector<double> done;  ///< in least amounts; as long as `open`
};

/// Simulated time in which a UAV said that it waited for a mate.
struct WaitSpan {
  double from_s = 0.0, until_s = 0.0;
  std::size_t mate = 0;  ///< index of the UAV
};

struct WorkSecond {
  bool excused = false;          ///< open, and it waited for a mate that worked
  bool frozen = false;           ///< one of 60 open seconds without the least amount of work
  std::size_t without_work = 0;  ///< open seconds since when it has not done a least amount of work
  std::optional<std::size_t> waits_for;
};

struct WorkTime {
  std::vector<WorkSecond> seconds;  ///< one for each of the track
  std::size_t frozen_s = 0, excused_s = 0;
  std::size_t longest_s = 0;  ///< the most that `without_work` came to
};

/// @param tracks  of all UAVs, in fleet order.
/// @param waits   by UAV; those without an entry, and spans of mates that there are not, waited for nobody.
std::vector<WorkTime> judge_work(std::span<const WorkTrack> tracks, std::span<const std::vector<WaitSpan>> waits);

}  // namespace skein
