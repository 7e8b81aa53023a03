// Computes the figures of a run's report from the run's full data, which is never thinned. Simulated seconds.
// Pure; any thread.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/causes.hpp"
#include "results/run_record.hpp"

namespace skein::report {

/// Result of the interest points in one box, outside all boxes, or in total.
struct BoxFigures {
  std::string name;
  std::size_t points = 0, attainable = 0, scored = 0;
  double estimate = 0.0, score = 0.0;
  std::array<double, results::kCauses.size()> losses{};  ///< by cause

  /// Mean quality of the points that scored; 0 if none did.
  double mean_q() const { return scored > 0 ? score / static_cast<double>(scored) : 0.0; }
};

/// One entry per box, in the order of scene.json; a point in several boxes counts in the first. Then an entry for the
/// points outside all boxes, if there are any. The last entry is the total.
std::vector<BoxFigures> box_figures(const results::RunRecord& run);

struct Span {
  double from_s = 0.0, until_s = 0.0;
};
using Spans = std::vector<Span>;
double length_of(const Spans& spans);

/// Number of a UAV's captures that the station had not acknowledged, from `time_s` until the next entry.
struct Waiting {
  double time_s = 0.0;
  int captures = 0;
};

/// What one UAV did over time.
struct Lane {
  Spans taking_part;               ///< its program took part in the run
  Spans still;                     ///< slower than 0.1 m/s, and no capture in the last 5 s that improved a point
  Spans direct, relayed;           ///< linked to the station directly; only through other UAVs
  std::vector<double> captures_s;  ///< times of captures that improved a point, ascending
  std::vector<Waiting> undelivered;
  std::optional<double> collided_s;
};
/// In fleet order.
std::vector<Lane> lanes_of(const results::RunRecord& run);

/// The points that were never in a picture, and their loss. A point is `near` if a UAV came within the range in which
/// its camera's resolution is sufficient; the others are `far`.
struct NeverInPicture {
  std::size_t points_near = 0, points_far = 0;
  double loss_near = 0.0, loss_far = 0.0;
};
/// nullopt: there are no such points, or no camera is known.
std::optional<NeverInPicture> never_in_picture(const results::RunRecord& run);

/// What a UAV uses its time for, as its program reports it.
enum class TimeUse { takes_off, waits, flies, rests, shows, recovers, stands, homing, other };
inline constexpr std::size_t kTimeUses = 9;
/// Time by TimeUse [s]. Only times in which the program takes part in the run count.
using TimeBudget = std::array<double, kTimeUses>;
/// In fleet order; nullopt: the UAV's program reported nothing. @param lanes  those of `run`.
std::vector<std::optional<TimeBudget>> time_budgets(const results::RunRecord& run, const std::vector<Lane>& lanes);

/// Share of the run's time in which a directed link was open, by names of sender and receiver.
using LinkShares = std::map<std::pair<std::string, std::string>, double>;
LinkShares link_shares(const results::RunRecord& run);

/// Delay between exposure and delivery, over all captures that improved a point.
struct Latency {
  std::vector<double> delays_s;  ///< of delivered captures, ascending
  std::size_t never = 0;         ///< number of captures that were not delivered

  /// The smallest delay that at least `share` of the delivered captures do not exceed [s]; 0 if none was delivered.
  double quantile(double share) const;
};
Latency latency_of(const results::RunRecord& run);
/// The same for each UAV, in fleet order.
std::vector<Latency> latency_by_uav(const results::RunRecord& run);
/// The captures of all parts together.
Latency merged(const std::vector<Latency>& parts);

/// The final map of one UAV, in figures.
struct MapFigures {
  double occupied_m3 = 0.0, free_m3 = 0.0;
  /// Known share of the boxes' volume, counted in cubes of at most 2 m (more if boxes are huge); nullopt without boxes.
  std::optional<double> known_share;
};
/// In fleet order; nullopt: the UAV left no map.
std::vector<std::optional<MapFigures>> map_figures(const results::RunRecord& run);

/// Mean number of processors that the programs kept busy; nullopt if the result has no CPU or wall time.
std::optional<double> processors_of(const Json& result);

}  // namespace skein::report
