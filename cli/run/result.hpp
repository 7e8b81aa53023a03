// result.json: what the launcher knows and what the programs reported, put together. The keys are a contract
// (docs/result.schema.json, docs/results.md); what nobody reported is null, or 0 where the schema wants a number.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/planner_spec.hpp"
#include "core/scenario.hpp"

namespace skein::cli {

using Json = nlohmann::ordered_json;

/// What a program took of the machine.
struct ProcessUse {
  double cpu_s = 0.0;  ///< of all threads, from the first step to the last (all of it when the run never got there)
  double peak_memory_mb = 0.0;
  double memory_share_mb = 0.0;  ///< at the end, shared pages in parts (PSS)
};

/// What the launcher itself knows of a run.
struct RunFacts {
  std::string scenario;  ///< as the user named it
  std::uint64_t seed = 0;
  std::vector<UavPlanner> planners;  ///< fleet order
  std::optional<std::string> ground_program = {};
  std::optional<std::filesystem::path> agent = {};  ///< that flew in the place of uav_agent
  std::map<std::string, std::string> dds;           ///< vendor by process
  std::string clock;
  bool native = false;
  bool interrupted = false;  ///< the user pressed Ctrl-C
  std::vector<std::string> warnings;
  /// Last words of the status lines: they stand in where a program left no report.
  double sim_time_s = 0.0, mission_time_s = 0.0, wall_time_s = 0.0;
  int points_detected = 0;
  double score = 0.0, score_earned = 0.0;
  std::set<std::string> out_by_fault;  ///< programs that a fault kept out of the run at its end
  double startup_s = 0.0;              ///< of wall time, from the first program's start to the first step
  std::map<std::string, ProcessUse> processes;
};

/// What the programs left behind; null where a report is missing or cut short.
struct Reports {
  Json sim_server, station, comm_router;
  std::map<std::string, Json> agents;  ///< by UAV
};

/// @param handed_in  by program, what came through the status pipes; a file counts where nothing came.
Reports read_reports(const std::filesystem::path& dir, const Scenario& scenario,
                     const std::map<std::string, Json>& handed_in = {});

/// Never throws for what a report contains or lacks: a wrong type counts as missing.
Json merge_result(const RunFacts& facts, const Scenario& scenario, const Reports& reports);

/// score.csv (x,y,z,nx,ny,nz,score,index) from scene.json and the station's report.
/// @returns false when there is no scene.json.
bool write_score_csv(const std::filesystem::path& dir, const Json& station_report);

/// The value under `key` when it is there and of the same kind as `fallback`, else `fallback`. A null `fallback` takes
/// any kind. Never throws.
Json value_or(const Json& object, const char* key, Json fallback);
/// 0 where there is none.
inline double number(const Json& object, const char* key) { return value_or(object, key, 0.0).get<double>(); }

/// Parses what a program wrote. @returns null when it is not JSON. What is nested deeper than anything of ours is left
/// out: copying it would take the stack.
Json parse_json(const std::string& text);

/// Parses a JSON file. @returns null when it is not there, not a plain file of a sensible size, or not JSON.
Json read_json(const std::filesystem::path& file);

}  // namespace skein::cli
