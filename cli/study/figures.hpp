// Computes a study's figures, medians, totals and ranks from the results of its flights. Pure; any thread.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/flight_tables.hpp"
#include "cli/study_options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// One UAV of a flight.
struct UavFigures {
  std::string name, role;
  double score = 0.0, distance_m = 0.0;
  std::optional<double> idle_s, captures;
};

/// The figures of one flight. nullopt: not known.
struct FlightFigures {
  double score = 0.0;
  int points_detected = 0, points_total = 0;
  std::optional<double> attainable_percent;                      ///< score as a share of `attainable` [%]
  std::optional<double> attainable;                              ///< score possible with full knowledge
  std::optional<double> mean_quality;                            ///< score per detected point
  std::optional<double> greatest_share;                          ///< greatest share of one UAV in the score [%]
  int collisions = 0, collisions_by_battery = 0;                 ///< the latter: falls with an empty battery
  std::optional<int> frozen_uavs, waiting_uavs;                  ///< UAVs that were ever frozen; that were ever excused
  std::optional<double> frozen_s, waited_s, without_work_s;      ///< sums over the fleet; the longest of any UAV
  std::optional<double> idle_explorers_s, idle_photographers_s;  ///< mean per UAV of that role
  double distance_m = 0.0;                                       ///< sum over the fleet
  std::optional<double> planner_cpu_ms;                          ///< per UAV and simulated second
  double real_time_factor = 0.0, mission_time_s = 0.0;
  std::map<std::string, double> losses;                   ///< lost score by cause (results/causes.hpp); empty: unknown
  std::map<std::string, double> poor_parts = {};          ///< of `below_threshold` in `losses`, by kPoorParts
  std::string status, digest;                             ///< digest: empty if the run has none
  std::vector<UavFigures> uavs = {};                      ///< fleet order
  std::optional<double> memory_mb = {}, processors = {};  ///< sum over its programs; their CPU time per wall time
  std::optional<double> braking_hits = {}, braking_meets = {}, ways_meet = {};  ///< exchanges, from the flight check
  std::optional<double> least_clearance_m = {}, least_separation_m = {};        ///< between surfaces
};

FlightFigures figures_of(const Json& result);

/// Five numbers of a sample. Quartiles between two values are interpolated linearly (Hyndman and Fan's definition 7).
struct Spread {
  std::size_t count = 0;
  double min = 0.0, q1 = 0.0, median = 0.0, q3 = 0.0, max = 0.0;
};
/// All zeros for an empty sample.
Spread spread_of(std::vector<double> values);

struct FlightEntry {
  std::size_t planner = 0, scenario = 0;
  std::uint64_t seed = 0;
  std::filesystem::path dir;
  std::optional<FlightFigures> figures;  ///< nullopt: no result that counts
  std::string problem;                   ///< empty: none
  std::string page = {};                 ///< its report, relative to the study's folder; empty: none
  std::optional<FlightTables> tables = {};
  std::string command = {};  ///< repeats the flight
  std::string folder = {};   ///< results folder, relative to the study's folder
};

/// Flights in the order of the plan, with indices by planner, scenario and seed, since a study may have 100 000 flights
/// and a search through all for each figure takes too long. Do not change planner, scenario or seed of an entry.
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

  /// Ascending positions in the list: flights of a planner in a scenario; flights of a planner with a seed.
  const std::vector<std::size_t>& in_scenario(std::size_t planner, std::size_t scenario) const;
  const std::vector<std::size_t>& with_seed(std::size_t planner, std::uint64_t seed) const;

 private:
  using Places = std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::size_t>>;
  static const std::vector<std::size_t>& places_in(const Places& all, std::size_t planner, std::uint64_t other);

  std::vector<FlightEntry> flights_;
  Places by_scenario_, by_seed_;  ///< keys: planner, and scenario or seed
};

/// Everything that the tables and pages of a study show.
struct Study {
  bool contest = false;
  Rank rank = Rank::maximum;
  std::vector<std::string> planners, scenarios;
  std::vector<std::uint64_t> seeds;
  FlightList flights;
  std::string command_line, version, programs, medium;
  int jobs = 1;
  std::string conditions = {};                     ///< set by options: "missions of 120 s"; empty: none
  std::vector<std::string> scene_conditions = {};  ///< by scenario, from --conditions; empty: no such option
  std::string machine = {};                        ///< on which the report was written; empty: not recorded

  /// The flights of a planner in a scenario that have figures, in the order of the plan.
  std::vector<const FlightEntry*> cell(std::size_t planner, std::size_t scenario) const;
  /// The flight of the cell with the highest score (of equals, the first); null: the cell is empty.
  const FlightEntry* best(std::size_t planner, std::size_t scenario) const;
  bool any_problem() const;
  /// Whether planners are compared over all scenes by their mean share of the attainable score, in which each scene
  /// counts the same: in comparisons of several scenes, if it is known of all flights. Else by sums of scores.
  bool compares_by_share() const;
};

/// The sum of `value` over a planner's flights with one seed in all scenes; nullopt if a flight lacks figures or value.
/// @param value  returns the value of a flight that has figures.
std::optional<double> total_of(const Study& study, std::size_t planner, std::uint64_t seed,
                               const std::function<std::optional<double>(const FlightEntry&)>& value);

/// One planner in the ranking.
struct Standing {
  std::size_t planner = 0;
  std::vector<std::optional<double>> totals;  ///< by test (seed); nullopt: a flight of the test has no figures
  std::optional<double> decides;              ///< the total that ranks it, by Study::rank; nullopt: no complete test
  int place = 0;                              ///< from 1; equal planners share the better place
};
/// Best first; equal planners in the order of the study; planners without a complete test last.
std::vector<Standing> standings(const Study& study);

/// The totals of complete tests.
std::vector<double> complete_totals(const Standing& standing);

/// "max", "median" or "worst".
std::string rank_name(Rank rank);

}  // namespace skein::cli
