// The options of one run, as plain structs. The launcher fills them from its command line, from a study's plan, or from
// the result of an earlier run.   Units: s (simulated, unless a comment says otherwise).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"

namespace skein::cli {

/// A recorded run that is flown again (recording/replay.hpp).
struct ReplayOf {
  std::filesystem::path recording;
  std::optional<double> until_s;   ///< from this time on, the programs' own messages count instead of the recorded ones
  std::vector<std::string> only;   ///< UAVs whose programs run, or "gcs"; empty: all
  std::vector<std::string> other;  ///< UAVs that fly other software now: Skein does not compare their messages
};

/// The longest lease that DDS accepts: Cyclone DDS's limit [s].
inline constexpr int kLongestLease_s = 3600;

/// The events that --break-on accepts.
inline constexpr std::array kBreakEvents = {"collision", "rejected", "lost", "fault"};

/// Options of the page that shows a run in browsers.
struct ViewOptions {
  std::optional<std::string> at;     ///< endpoint, as view::read_endpoint() reads it; none: no page is served
  std::optional<std::string> speed;  ///< pace of a watched flight, as view::read_speed() reads it
  std::optional<double> pause_at_s;  ///< simulated time at which the flight pauses until a viewer resumes it
  bool close = false;                ///< no longer serve the page when the run ends, instead of serving its replay
  bool browser = true;               ///< open the user's browser, if there is one
};

/// `skein run --place`: programs on other hosts (cli/place/).
struct PlaceOptions {
  std::optional<std::string> at;               ///< UAV=HOST,... or "slurm"; none: all programs run on this host
  std::string ssh = "ssh";                     ///< the command that logs in, with options of its own if any
  std::optional<std::filesystem::path> skein;  ///< path of skein on those hosts; none: the same path as on this host
  bool print = false;                          ///< do not fly: print the commands with which a user starts the programs
};

struct RunOptions {
  std::string scenario = "towers";  ///< a name under config/scenarios/ or a YAML file
  std::string planner = kDefaultPlanner;
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::size_t> uavs;  ///< size of the fleet, instead of the scenario's
  std::optional<std::filesystem::path> assets;
  std::optional<double> duration_s;
  std::optional<std::string> rules;                 ///< a preset, instead of the scenario's
  std::optional<std::string> conditions;            ///< presets, instead of the scenario's
  std::optional<std::filesystem::path> faults;      ///< fault file
  std::string dds = "cyclonedds";                   ///< a vendor or "mixed"
  std::string clock = "lockstep";                   ///< "lockstep", "realtime" or "realtime:FACTOR"
  std::optional<std::filesystem::path> agent;       ///< program that flies in place of uav_agent
  std::vector<std::string> debug;                   ///< UAV[=TOOL], see debug/debuggee.hpp
  std::optional<double> break_at_s;                 ///< debugged programs stop before this simulated time
  std::optional<std::string> break_on;              ///< likewise, before this event first happens to debug[0]
  std::optional<std::filesystem::path> break_from;  ///< results folder of the same flight: has the event's time
  std::vector<std::string> log;                     ///< UAV=LEVEL
  bool cores = false;                               ///< programs that crash leave a core dump
  bool one_process = false;                         ///< all programs in one process, without DDS
  std::optional<int> threads;                       ///< number of threads of that process
  bool stepped = false;  ///< with one_process: another program steps the fleet and commands the learners
  bool native = false;
  bool secure = false;  ///< with DDS Security; each agent runs under a user id of its own if possible
  std::optional<int> domain;
  std::optional<std::string> ros_env;  ///< do not fly: print the environment for a shell of this UAV's ROS 2 nodes
  std::optional<std::string> network;  ///< the network for other hosts: an interface, "all", or a YAML file
  PlaceOptions place;
  std::optional<double> stop_at_s;
  std::optional<int> lease_s;             ///< silence after which DDS considers a program gone
  std::optional<double> agent_timeout_s;  ///< wall time to wait for a program's answer, instead of a minute
  std::optional<std::filesystem::path> out;
  /// Results folder if `out` is not given; Skein appends a number to its name if it exists and is not empty. none: the
  /// folder that default_results_dir() of run/results_dir.hpp returns.
  std::optional<std::filesystem::path> usual_out;
  bool force = false;
  std::string record = "run";         ///< how much goes into the recording: none, messages, run, all or clouds
  std::optional<double> keep_maps_s;  ///< period of snapshots of UAVs' maps, in simulated seconds; none: no snapshots
  bool time_parts = false;            ///< agents time the parts of their work, for `skein bench --profile`
  std::optional<ReplayOf> replay;
  ViewOptions view;
  bool check = true;       ///< before the flight, ask the programs whether they can fly this run
  bool attainable = true;  ///< after the run, ask the oracle for the attainable score
  bool report = true;      ///< make report.html of the run
  double patience = 1.0;   ///< for tests: scales how long the launcher waits for programs to leave
  std::string command;     ///< command line as the user typed it; empty: there was none
};

/// The options that one flight of a study, a hunt or a fault test may have, by their names on the command line.
/// process/json_fields.hpp reads and writes them, and the command line that repeats the flight has them. There, an
/// option that is true by default is --no-NAME.
void describe(auto& f, RunOptions& run) {
  f.field("scenario", run.scenario);
  f.field("planner", run.planner);
  f.field("seed", run.seed);
  f.field("one-process", run.one_process);
  if (!run.one_process) f.field("dds", run.dds);
  f.field("clock", run.clock);
  f.field("record", run.record);
  f.field("agent", run.agent);
  f.field("scene-seed", run.scene_seed);
  f.field("uavs", run.uavs);
  f.field("assets", run.assets);
  f.field("duration", run.duration_s);
  f.field("rules", run.rules);
  f.field("conditions", run.conditions);
  f.field("network", run.network);
  f.field("faults", run.faults);
  f.field("break-at", run.break_at_s);
  f.field("break-on", run.break_on);
  f.field("break-from", run.break_from);
  f.field("log", run.log);
  f.field("debug", run.debug);
  f.field("domain", run.domain);
  f.field("stop-at", run.stop_at_s);
  f.field("lease", run.lease_s);
  f.field("agent-timeout", run.agent_timeout_s);
  f.field("keep-maps", run.keep_maps_s);
  f.field("out", run.out);
  f.field("native", run.native);
  f.field("cores", run.cores);
  f.field("secure", run.secure);
  f.field("force", run.force);
  f.field("check", run.check);
  f.field("oracle", run.attainable);
  f.field("report", run.report);
}

}  // namespace skein::cli
