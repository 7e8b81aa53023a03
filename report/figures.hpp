// The arithmetic of a run's report: from its tables to what the page states. All of it from full data.
// Pure; any thread.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/causes.hpp"
#include "results/run_data.hpp"

namespace skein::report {

/// What became of the points of one box, or of those outside of all boxes.
struct BoxFigures {
  std::string name;
  std::size_t points = 0, attainable = 0, scored = 0;
  double estimate = 0.0, score = 0.0;
  std::array<double, results::kCauses.size()> losses{};  ///< by cause

  /// Of the points that scored.
  double mean_q() const { return scored > 0 ? score / static_cast<double>(scored) : 0.0; }
};

/// In the order of scene.json; a point in several counts in the first. Last, if there are any, those outside; then the
/// sum over all.
std::vector<BoxFigures> box_figures(const results::RunData& run);

/// The score of what had been photographed, delivered or not, whenever it rose; without UAVs that collided.
std::vector<results::RunScore> earned_over_time(const results::RunData& run);

struct Span {
  double from_s = 0.0, until_s = 0.0;
};
using Spans = std::vector<Span>;
double length_of(const Spans& spans);

/// How many of its captures the station had not acknowledged, from `time_s` on.
struct Waiting {
  double time_s = 0.0;
  int captures = 0;
};

/// One UAV's time.
struct Lane {
  Spans taking_part;               ///< of its program
  Spans still;                     ///< below 0.1 m/s, and no capture of the last 5 s that counted for something
  Spans direct, relayed;           ///< with a link to the station; by way of others only
  std::vector<double> captures_s;  ///< that counted for something
  std::vector<Waiting> undelivered;
  std::optional<double> collided_s;
};
/// By UAV.
std::vector<Lane> lanes_of(const results::RunData& run);

/// Share of the time in which a directed link was there, by sender and receiver.
using LinkShares = std::map<std::pair<std::string, std::string>, double>;
LinkShares link_shares(const results::RunData& run);

/// From a picture to its being counted, of each capture that counted for something.
struct Latency {
  std::vector<double> delays_s;  ///< ascending
  std::size_t never = 0;         ///< were not delivered

  /// The least that `share` of the delivered do not exceed; 0 of none.
  double quantile(double share) const;
};
Latency latency_of(const results::RunData& run);
/// The same of each UAV.
std::vector<Latency> latency_by_uav(const results::RunData& run);
/// Of all captures of several of them.
Latency merged(const std::vector<Latency>& parts);

/// What one UAV knew at its end.
struct MapFigures {
  double occupied_m3 = 0.0, free_m3 = 0.0;
  std::optional<double> known_share;  ///< of the boxes' volume, counted in cubes of 2 m at most; none without boxes
};
/// By UAV; nullopt: it left no map.
std::vector<std::optional<MapFigures>> map_figures(const results::RunData& run);

/// How many processors the programs kept busy on average; none where nobody measured them.
std::optional<double> processors_of(const Json& result);

}  // namespace skein::report
