// Builds result.json from the launcher's own facts and the reports of the programs. Its keys are a contract
// (docs/result.schema.json, docs/results.md). What no program reported is null, or 0 if the schema requires a number.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"
#include "core/scenario/scenario.hpp"
#include "process/json_text.hpp"
#include "process/reports/reports.hpp"

namespace skein::results {

/// CPU time and memory of a process.
struct ProcessUse {
  double cpu_s = 0.0;  ///< of all threads, from the first step to the last; all of it if there was no step
  double peak_memory_mb = 0.0;
  double memory_share_mb = 0.0;  ///< proportional set size (PSS) at the end
};

/// What the launcher itself knows of a run.
struct RunFacts {
  std::string command = {};  ///< as the user typed it; empty: not started by a user's command
  std::string scenario;      ///< as the user named it
  std::uint64_t seed = 0;
  std::vector<UavPlanner> planners;  ///< fleet order
  std::optional<UavPlanner> ground_program = {};
  std::optional<std::filesystem::path> agent = {};  ///< the fleet's agent program; nullopt: uav_agent
  std::map<std::string, std::string> dds;           ///< vendor by process
  std::string clock;
  bool native = false;
  bool interrupted = false;  ///< the user pressed Ctrl-C
  std::vector<std::string> warnings;
  /// The last values in status lines; used if a program left no report.
  double sim_time_s = 0.0, mission_time_s = 0.0, wall_time_s = 0.0;
  int points_detected = 0;
  double score = 0.0, score_earned = 0.0;
  std::set<std::string> out_by_fault;          ///< programs that a fault kept out of the run at its end
  std::map<std::string, std::string> crashes;  ///< by member: how it crashed, and where the details are
  double startup_s = 0.0;                      ///< wall time from the start of the programs to the first step
  std::map<std::string, ProcessUse> processes;
  Json planner_files = Json::array();  ///< of planners in Python: from keep_python_files()
};

/// The reports of the programs; nullopt: missing or incomplete.
struct Reports {
  std::optional<SimServerReport> sim_server;
  std::optional<StationReport> station;
  std::optional<RouterReport> comm_router;
  std::map<std::string, std::optional<AgentReport>> agents;  ///< by UAV
};

/// Reads the reports of a run. @param dir  its folder. @param handed_in  reports that came through the status pipes, by
///   program; they take precedence over files.
Reports read_reports(const std::filesystem::path& dir, const Scenario& scenario,
                     const std::map<std::string, Json>& handed_in = {});

/// The warning that a program failed, and whether a warning is one of these.
std::string failure_text(const std::string& program, const std::string& how);
bool is_failure(const std::string& warning);

/// Builds result.json. Never throws for the contents of a report: a value of a wrong type counts as missing.
Json merge_result(const RunFacts& facts, const Scenario& scenario, const Reports& reports);

/// Whether a result has a lost member that did not rejoin the run.
bool anyone_lost(const Json& result);

/// Writes score.csv (x,y,z [m, frame W],nx,ny,nz,score,index) from scene.json and the station's report.
/// @returns false if there is no scene.json.
bool write_score_csv(const std::filesystem::path& dir, const std::optional<StationReport>& station);

}  // namespace skein::results
