// The arithmetic of `skein bench`: computes figures from results of runs. Pure; a value that a result lacks counts as 0
// or null, never as an error.
#pragma once

#include <string>
#include <vector>

#include "results/result.hpp"

namespace skein::cli {

/// The median; for an even number of values, the mean of the middle two; 0 for none.
double median(std::vector<double> values);

/// {median, min, max, values} of one figure over repeated runs.
Json figure(const std::vector<double>& values);

/// Where the CPU time of one run went, from its first step on. One entry for each kind of work: physics, lidar, camera,
/// line_of_sight, recording, agents (planners and on-board software), exchange (the rest: DDS, codec, lock-step,
/// router, station). Each has cpu_s, share (of all CPU time; they sum to 1) and ms_per_sim_s. `exchange` also says how
/// much of it each kind of program took.
Json work_of(const Json& result);

/// "one process, 2 threads"
std::string text_of_threads(int threads);

/// One scenario flown several times; all results are of the same scenario.
/// @param lidar  bench_lidar's report, or null
/// @param threads  of the one process; 0: the fleet flew as processes
Json speed_entry(const std::vector<Json>& results, const Json& lidar, int threads = 0);

/// A fleet that only exchanges messages, compared with the floor (the same messages over bare DDS): one pair of results
/// for each repeat.
struct RoundsPair {
  Json fleet;  ///< result.json
  Json floor;  ///< bench_floor_*'s report
};
Json rounds_entry(const std::string& vendor, std::size_t uavs, const std::vector<RoundsPair>& pairs);

/// One size of fleet. @param threads  as for speed_entry()
Json scale_entry(std::size_t uavs, const std::vector<Json>& results, int threads = 0);

/// The time of an exchange of one fleet, the median over its runs [ms]: `round_ms` is wall time, `cpu_ms` the CPU time
/// of all its processes.
Json step_entry(const std::vector<Json>& results);

/// One vendor's radio latency through the router and through a bare relay; `reports` are bench_relay's.
Json relay_entry(const std::string& vendor, const std::vector<Json>& reports);

/// A fleet in which all nodes send to all others in every exchange, in real time. `lost`: number of messages that had
/// line of sight and did not arrive; should be 0.
Json load_entry(std::size_t uavs, const std::vector<Json>& results);

/// Memory at the end of a short run and of a long one of the same fleet; `growth` is their ratio.
Json memory_entry(const Json& short_run, const Json& long_run);

/// CPU time of all processes of a run, from the first step on.
double fleet_cpu_s(const Json& result);

/// Whether a run went to its end and lost no program.
bool ran_to_the_end(const Json& result);

}  // namespace skein::cli
