// result.json: what the launcher knows and what the programs reported, put together. The keys are a contract
// (docs/result.schema.json, docs/results.md); what nobody reported is null, or 0 where the schema wants a number.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"
#include "core/scenario.hpp"
#include "process/json_text.hpp"
#include "process/reports/reports.hpp"

namespace skein::results {

/// What a program took of the machine.
struct ProcessUse {
  double cpu_s = 0.0;  ///< of all threads, from the first step to the last (all of it when the run never got there)
  double peak_memory_mb = 0.0;
  double memory_share_mb = 0.0;  ///< at the end, shared pages in parts (PSS)
};

/// What the launcher itself knows of a run.
struct RunFacts {
  std::string command = {};  ///< as the user typed it; empty: nobody did
  std::string scenario;      ///< as the user named it
  std::uint64_t seed = 0;
  std::vector<UavPlanner> planners;  ///< fleet order
  std::optional<UavPlanner> ground_program = {};
  std::optional<std::filesystem::path> agent = {};  ///< that flew in the place of uav_agent, if its planner names none
  std::map<std::string, std::string> dds;           ///< vendor by process
  std::string clock;
  bool native = false;
  bool interrupted = false;  ///< the user pressed Ctrl-C
  std::vector<std::string> warnings;
  /// Last words of the status lines: they stand in where a program left no report.
  double sim_time_s = 0.0, mission_time_s = 0.0, wall_time_s = 0.0;
  int points_detected = 0;
  double score = 0.0, score_earned = 0.0;
  std::set<std::string> out_by_fault;          ///< programs that a fault kept out of the run at its end
  std::map<std::string, std::string> crashes;  ///< by member, where its log tells of it
  double startup_s = 0.0;                      ///< of wall time, from the first program's start to the first step
  std::map<std::string, ProcessUse> processes;
  Json planner_files = Json::array();  ///< of planners in Python, as keep_python_files() has them
};

/// What the programs left behind; empty where a report is missing or cut short.
struct Reports {
  std::optional<SimServerReport> sim_server;
  std::optional<StationReport> station;
  std::optional<RouterReport> comm_router;
  std::map<std::string, std::optional<AgentReport>> agents;  ///< by UAV
};

/// @param handed_in  by program, what came through the status pipes; a file counts where nothing came.
Reports read_reports(const std::filesystem::path& dir, const Scenario& scenario,
                     const std::map<std::string, Json>& handed_in = {});

/// Among a run's warnings: a program failed, and how.
std::string failure_text(const std::string& program, const std::string& how);
bool is_failure(const std::string& warning);

/// Never throws for what a report contains or lacks: a wrong type counts as missing.
Json merge_result(const RunFacts& facts, const Scenario& scenario, const Reports& reports);

/// Whether a result names a process that died or hung and did not take part again.
bool anyone_lost(const Json& result);

/// score.csv (x,y,z,nx,ny,nz,score,index) from scene.json and the station's report.
/// @returns false when there is no scene.json.
bool write_score_csv(const std::filesystem::path& dir, const std::optional<StationReport>& station);

}  // namespace skein::results
