// The arithmetic of a study: from the results of its flights to figures, medians, totals and ranks. Pure; any thread.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/options.hpp"
#include "cli/study/flight_tables.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// One UAV of a flight.
struct UavFigures {
  std::string name, role;
  double score = 0.0, distance_m = 0.0;
  std::optional<double> idle_s, captures;
};

/// What is compared of one flight. Empty where nobody could tell.
struct FlightFigures {
  double score = 0.0;
  int points_detected = 0, points_total = 0;
  std::optional<double> attainable_percent;                      ///< of the score that full knowledge could get
  std::optional<double> attainable;                              ///< that score
  std::optional<double> mean_quality;                            ///< score by detected point
  std::optional<double> greatest_share;                          ///< of one UAV in the score [%]
  int collisions = 0, collisions_by_battery = 0;                 ///< the latter: it fell, since that was empty
  std::optional<int> frozen_uavs, waiting_uavs;                  ///< without work; excused since they waited
  std::optional<double> frozen_s, waited_s, without_work_s;      ///< of all; of all; the longest of any
  std::optional<double> idle_explorers_s, idle_photographers_s;  ///< a UAV of that role on average
  double distance_m = 0.0;                                       ///< of all UAVs
  std::optional<double> planner_cpu_ms;                          ///< a simulated second and UAV; of UAVs that tell
  double real_time_factor = 0.0, mission_time_s = 0.0;
  std::string status, digest;                             ///< digest: empty where it would not repeat
  std::vector<UavFigures> uavs = {};                      ///< fleet order
  std::optional<double> memory_mb = {}, processors = {};  ///< of all its programs; how many of them were busy
  std::optional<double> braking_hits = {}, braking_meets = {}, ways_meet = {};  ///< of the flight check
  std::optional<double> least_clearance_m = {}, least_separation_m = {};        ///< between surfaces
};

FlightFigures figures_of(const Json& result);

/// Five numbers of a sample. Quartiles between two values are interpolated linearly (Hyndman and Fan's definition 7).
struct Spread {
  std::size_t count = 0;
  double min = 0.0, q1 = 0.0, median = 0.0, q3 = 0.0, max = 0.0;
};
/// Zeros of an empty sample.
Spread spread_of(std::vector<double> values);

struct FlightEntry {
  std::size_t planner = 0, scenario = 0;
  std::uint64_t seed = 0;
  std::filesystem::path dir;
  std::optional<FlightFigures> figures;  ///< none: no result that counts
  std::string problem;                   ///< empty: none
  std::string page = {};                 ///< its own report, from the study's folder; empty: there is none
  std::optional<FlightTables> tables = {};
  std::string command = {};  ///< that repeats it
  std::string folder = {};   ///< of its results, from the study's folder
};

/// Flights in the order in which they were planned, found by what they are: of 100 000 nobody may look at all for each
/// figure. Planner, scenario and seed of what is in it stay as they are.
class FlightList {
 public:
  FlightList() = default;
  FlightList(std::initializer_list<FlightEntry> flights);

  FlightEntry& push_back(FlightEntry flight);
  void reserve(std::size_t count) { flights_.reserve(count); }
  std::size_t size() const { return flights_.size(); }
  FlightEntry& operator[](std::size_t i) { return flights_[i]; }
  const FlightEntry& operator[](std::size_t i) const { return flights_[i]; }
  FlightEntry& back() { return flights_.back(); }
  auto begin() const { return flights_.begin(); }
  auto end() const { return flights_.end(); }

  /// Of a planner in a scenario, and of a planner with a seed in any: where they are in the list, ascending.
  const std::vector<std::size_t>& in_scenario(std::size_t planner, std::size_t scenario) const;
  const std::vector<std::size_t>& with_seed(std::size_t planner, std::uint64_t seed) const;

 private:
  using Places = std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::size_t>>;
  static const std::vector<std::size_t>& places_in(const Places& all, std::size_t planner, std::uint64_t other);

  std::vector<FlightEntry> flights_;
  Places by_scenario_, by_seed_;  ///< of a planner and one of these
};

/// All that tables and pages show.
struct Study {
  bool contest = false;
  Rank rank = Rank::maximum;
  std::vector<std::string> planners, scenarios;
  std::vector<std::uint64_t> seeds;
  FlightList flights;
  std::string command_line, version, programs, medium;
  int jobs = 1;
  std::string conditions = {};                     ///< other than the scenarios' own: "missions of 120 s"; empty: none
  std::vector<std::string> scene_conditions = {};  ///< by scenario, as --conditions has them; empty: not told apart
  std::string machine = {};                        ///< on which this was written; empty: nobody asked

  /// The flights of a planner in a scenario that count, by seed.
  std::vector<const FlightEntry*> cell(std::size_t planner, std::size_t scenario) const;
  /// The one with the highest score, the first of equals; null without any.
  const FlightEntry* best(std::size_t planner, std::size_t scenario) const;
  bool any_problem() const;
};

/// What of all scenes together counts for a planner with a seed: the sum over its flights, if all of them count and
/// have a value. @param value  of a flight that counts.
std::optional<double> total_of(const Study& study, std::size_t planner, std::uint64_t seed,
                               const std::function<std::optional<double>(const FlightEntry&)>& value);

/// One planner in the ranking.
struct Standing {
  std::size_t planner = 0;
  std::vector<std::optional<double>> totals;  ///< by test (seed); none: a flight of the test does not count
  std::optional<double> decides;              ///< by Study::rank; none without a complete test
  int place = 0;                              ///< from 1; equals share the better one
};
/// Best first; equals in the order in which they were named; those without a complete test last.
std::vector<Standing> standings(const Study& study);

/// The totals of complete tests.
std::vector<double> complete_totals(const Standing& standing);

/// "max", "median" or "worst".
std::string rank_name(Rank rank);

}  // namespace skein::cli
