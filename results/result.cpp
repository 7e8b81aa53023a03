#include "results/result.hpp"

#include <algorithm>
#include <sstream>

#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "results/from_nodes.hpp"
#include "results/run_folder.hpp"
#include "results/work.hpp"

namespace skein::results {
namespace {

RunStatus status_of(const RunFacts& facts, const SimServerReport& sim) {
  if (facts.interrupted && sim.status == RunStatus::aborted) return RunStatus::interrupted;  // the user asked for it
  return sim.status.value_or(facts.interrupted ? RunStatus::interrupted : RunStatus::aborted);
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// One entry per UAV, in fleet order, even if reports are missing.
Json uav_entries(const Scenario& scenario, const SimServerReport& sim, const Reports& reports) {
  Json entries = Json::array();
  const std::vector<std::optional<WorkTime>> works = work_times(scenario, reports);
  for (const UavIndex i : scenario.uavs()) {
    const UavConfig& uav = scenario.fleet[i];
    UavReport flown;
    for (const UavReport& report : sim.uavs) {
      if (report.name == uav.name) flown = report;
    }
    const auto found = reports.agents.find(uav.name);
    const AgentReport agent = found == reports.agents.end() ? AgentReport{} : found->second.value_or(AgentReport{});
    const bool lost = std::any_of(sim.lost_members.begin(), sim.lost_members.end(), [&](const LostMember& member) {
      return member.member == uav.name && !member.back_at_s;
    });
    entries.push_back({{"name", uav.name},
                       {"role", name_of(uav.vehicle.role)},
                       {"alive", or_null(flown.alive)},
                       {"distance_m", or_null(flown.distance_m)},
                       {"max_speed_mps", or_null(flown.max_speed_mps)},
                       {"captures", or_null(flown.captures)},
                       {"idle_s", or_null(flown.idle_s)},
                       {"frozen_s", works[i] ? Json(works[i]->frozen_s) : Json()},
                       {"excused_s", works[i] ? Json(works[i]->excused_s) : Json()},
                       {"without_work_s", works[i] ? Json(works[i]->longest_s) : Json()},
                       {"commands_rejected", or_null(flown.commands_rejected)},
                       {"first_rejected_s", or_null(flown.first_rejected_s)},
                       {"commands_unheard", or_null(flown.commands_unheard)},
                       {"program_lost", lost},
                       {"waited_s", or_null(agent.waited_s)},
                       {"no_way", agent.no_way.value_or(Texts())},
                       {"planner_cpu_s", or_null(agent.planner_cpu_s)},
                       {"planner_cpu_p99_ms", or_null(agent.planner_cpu_p99_ms)},
                       {"planner_cpu_max_ms", or_null(agent.planner_cpu_max_ms)},
                       {"planner_exchanges_over_50ms", or_null(agent.planner_exchanges_over_50ms)}});
    if (agent.from_nodes) entries.back()["from_nodes"] = json_of(*agent.from_nodes);
    if (agent.planner_parts) entries.back()["planner_parts"] = json_of(*agent.planner_parts);
    if (agent.safety_filter) entries.back()["safety_filter"] = json_of(*agent.safety_filter);
    if (flown.battery) entries.back()["battery"] = json_of(*flown.battery);
  }
  return entries;
}

/// Sum over all UAVs for which it is known; null if it is known for none.
Json frozen_in_all(const Json& uavs) {
  Json sum;
  for (const Json& uav : uavs) {
    const Json& frozen_s = uav["frozen_s"];
    if (frozen_s.is_number()) sum = sum.is_null() ? frozen_s : Json(sum.get<double>() + frozen_s.get<double>());
  }
  return sum;
}

Json score_by_uav(const Scenario& scenario, const StationReport& station) {
  Json scores = Json::object();
  for (const UavConfig& uav : scenario.fleet) scores[uav.name] = 0.0;
  for (const auto& [uav, score] : station.score_by_uav) {
    if (scores.contains(uav)) scores[uav] = score;
  }
  return scores;
}

void add_processes(const RunFacts& facts, Json& result) {
  double memory_mb = 0.0;
  Json processes = Json::object();
  for (const auto& [name, use] : facts.processes) {
    memory_mb += use.peak_memory_mb;
    processes[name] = {
        {"cpu_s", use.cpu_s}, {"peak_memory_mb", use.peak_memory_mb}, {"memory_share_mb", use.memory_share_mb}};
  }
  result["memory_mb"] = memory_mb;
  result["processes"] = std::move(processes);
}

/// Calls `look` with each report that is not missing.
void for_each_report(const Reports& reports, const auto& look) {
  if (reports.sim_server) look(*reports.sim_server);
  if (reports.station) look(*reports.station);
  if (reports.comm_router) look(*reports.comm_router);
  for (const auto& [uav, report] : reports.agents) {
    if (report) look(*report);
  }
}

/// Numbers of samples, over all topics of all programs.
struct SampleCounts {
  std::uint64_t malformed = 0;  ///< received, but not a valid message of the topic's type
  std::uint64_t unsent = 0;     ///< could not be sent
};

SampleCounts sample_counts(const Reports& reports) {
  SampleCounts sum;
  for_each_report(reports, [&](const auto& report) {
    sum.malformed += report.malformed.value_or(0);
    sum.unsent += report.unsent.value_or(0);
  });
  return sum;
}

Json radio_counts(const RouterReport& router) {
  const RadioCounts& total = router.total;
  return {{"sent", total.sent.value_or(0)},
          {"delivered", total.delivered.value_or(0)},
          {"dropped_no_los", total.dropped_no_los.value_or(0)},
          {"dropped_fault", total.dropped_fault.value_or(0)},
          {"dropped_overflow", total.dropped_overflow.value_or(0)},
          {"duplicated", total.duplicated.value_or(0)},
          {"corrupted", total.corrupted.value_or(0)},
          {"sent_bytes", total.sent_bytes.value_or(0)},
          {"delivered_bytes", total.delivered_bytes.value_or(0)},
          {"unheard", router.unheard.value_or(0)},
          {"per_link", json_of(router.per_link)}};
}

/// Begin and end of each fault that a viewer added by hand, in order of steps.
Json interventions(const std::vector<FaultReport>& faults, double period_s) {
  std::vector<Json> all;
  const auto add = [&](const FaultReport& fault, const Count& step, const char* what) {
    if (!fault.by_hand.value_or(false) || !step) return;
    all.push_back({{"time_s", static_cast<double>(*step) * period_s},
                   {"step", *step},
                   {"what", what},
                   {"kind", fault.kind.value_or("")},
                   {"target", fault.target.value_or("")}});
  };
  for (const FaultReport& fault : faults) {
    add(fault, fault.began_step, "begin");
    add(fault, fault.ended_step, "end");
  }
  std::ranges::stable_sort(all, {}, [](const Json& one) { return one["step"].get<std::uint64_t>(); });
  return all;
}

/// Warns of each program that left no report, and says what is therefore unknown.
void warn_of_missing(const RunFacts& facts, const Reports& reports, Texts& warnings) {
  const auto missing = [&](const auto& report, const std::string& program, const std::string& consequence) {
    const bool expected = facts.out_by_fault.contains(program);  // `faults` already explains it
    if (!report && !expected) warnings.push_back(program + " left no report: " + consequence);
  };
  missing(reports.sim_server, programs::kSimServer, "times are the last that it reported");
  missing(reports.station, programs::kStation, "the score is the last that it reported");
  missing(reports.comm_router, programs::kCommRouter, "radio counts are unknown");
  for (const UavPlanner& planner : facts.planners) {
    const auto report = reports.agents.find(planner.uav);
    const bool silent = is_command(planner.spec) || planner.spec == kRecorded;
    if (silent || report == reports.agents.end()) continue;
    missing(report->second, programs::agent_program(planner.uav), "its planner's CPU time is unknown");
  }
}

/// The programs' sentences about files that they could not write, joined by "; "; empty: none.
std::string unwritten_files(const Reports& reports) {
  std::string files;
  for_each_report(reports, [&](const auto& report) {
    const std::optional<Texts> unwritten = report.unwritten;
    for (const std::string& file : unwritten.value_or(Texts())) files += (files.empty() ? "" : "; ") + file;
  });
  return files;
}

Texts warnings_of(const RunFacts& facts, const SimServerReport& sim, const RouterReport& router,
                  const Reports& reports) {
  Texts warnings = sim.warnings;
  for (const Texts& more : {router.warnings, facts.warnings}) warnings.insert(warnings.end(), more.begin(), more.end());
  if (facts.native) warnings.push_back("--native: the digest may differ on another CPU model");
  warn_of_missing(facts, reports, warnings);
  const std::string unwritten = unwritten_files(reports);
  if (!unwritten.empty()) warnings.push_back("files are missing or cut short: " + unwritten);
  const SampleCounts samples = sample_counts(reports);
  if (samples.malformed > 0) {
    warnings.push_back(std::to_string(samples.malformed) +
                       " malformed samples were received and dropped; the logs name topics");
  }
  if (samples.unsent > 0) {
    warnings.push_back(std::to_string(samples.unsent) + " samples could not be sent; the logs name topics and reasons");
  }
  return warnings;
}

/// The part of the result that describes the run's setup: scenario, planners, vendors, clock.
Json description(const RunFacts& facts, const Scenario& scenario) {
  Json result;
  result["skein_version"] = SKEIN_VERSION;
  if (!facts.command.empty()) result["command"] = facts.command;
  result["scenario"] = facts.scenario;
  result["seed"] = facts.seed;
  result["scene_seed"] = scenario.scene.scene_seed;
  for (const UavPlanner& planner : facts.planners) result["planner"][planner.uav] = written(planner);
  if (facts.ground_program) result["planner"]["gcs"] = written(*facts.ground_program);
  if (facts.agent) result["agent"] = facts.agent->string();
  for (const auto& [process, vendor] : facts.dds) result["dds"][process] = vendor;
  result["clock"] = facts.clock;
  result["math"] = facts.native ? "native" : "baseline";
  result["exchange_period_s"] = scenario.exchange_period_s;
  const Vector3d& station = scenario.station_position;
  result["station"] = {{"position", {station.x(), station.y(), station.z()}}};
  return result;
}

/// Adds simulated and wall time, and the processes' use of CPU and memory.
void add_times(const RunFacts& facts, const SimServerReport& sim, Json& result) {
  const double sim_time_s = sim.sim_time_s.value_or(facts.sim_time_s);
  const double wall_time_s = sim.wall_time_s.value_or(facts.wall_time_s);
  result["sim_time_s"] = sim_time_s;
  result["mission_time_s"] = sim.mission_time_s.value_or(facts.mission_time_s);
  result["wall_time_s"] = wall_time_s;
  result["real_time_factor"] = wall_time_s > 0.0 ? sim_time_s / wall_time_s : 0.0;
  result["startup_s"] = facts.startup_s;
  add_processes(facts, result);
  result["timing"] = json_of(sim.timing);
}

constexpr const char* kFailed = " failed: ";

}  // namespace

std::string failure_text(const std::string& program, const std::string& how) { return program + kFailed + how; }

bool is_failure(const std::string& warning) { return warning.find(kFailed) != std::string::npos; }

Reports read_reports(const std::filesystem::path& dir, const Scenario& scenario,
                     const std::map<std::string, Json>& handed_in) {
  const auto read = [&]<class Report>(const std::string& program, std::optional<Report>& report) {
    const auto found = handed_in.find(program);
    const Json json = found != handed_in.end() ? found->second : read_json(dir / run_folder::report_file(program));
    if (!json.is_null()) report = struct_of<Report>(json);
  };
  Reports reports;
  read(programs::kSimServer, reports.sim_server);
  read(programs::kStation, reports.station);
  read(programs::kCommRouter, reports.comm_router);
  for (const UavConfig& uav : scenario.fleet) read(programs::agent_program(uav.name), reports.agents[uav.name]);
  return reports;
}

Json merge_result(const RunFacts& facts, const Scenario& scenario, const Reports& reports) {
  const SimServerReport sim = reports.sim_server.value_or(SimServerReport{});
  const StationReport station = reports.station.value_or(StationReport{});
  const RouterReport router = reports.comm_router.value_or(RouterReport{});
  Json result = description(facts, scenario);
  result["rules"] = sim.rules.value_or(scenario.rules.preset);
  result["rule_switches"] = Json::object();
  for (const auto& [name, value] : own_switches(scenario.rules)) {
    std::visit([&](const auto setting) { result["rule_switches"][name] = setting; }, value);
  }
  if (sim.conditions) result["conditions"] = *sim.conditions;
  result["status"] = name_of(status_of(facts, sim));
  result["deterministic"] = sim.deterministic.value_or(false);
  result["digest"] = or_null(sim.digest);
  add_times(facts, sim, result);
  result["points_total"] = or_null(sim.points_total);
  result["points_detected"] = station.points_detected.value_or(facts.points_detected);
  result["score"] = station.score.value_or(facts.score);
  result["score_earned"] = station.score_earned.value_or(facts.score_earned);
  // The caller fills these two in after it has run the oracle.
  result["attainable"] = {{"points", nullptr}, {"score", nullptr}};
  result["losses"] = nullptr;
  result["score_by_uav"] = score_by_uav(scenario, station);
  result["collisions"] = json_of(sim.collisions);
  result["flight_check"] = sim.flight_check ? json_of(*sim.flight_check) : Json();
  result["uavs"] = uav_entries(scenario, sim, reports);
  result["frozen_s"] = frozen_in_all(result["uavs"]);
  result["radio"] = radio_counts(router);
  const SampleCounts samples = sample_counts(reports);
  result["radio"]["malformed"] = samples.malformed;
  result["radio"]["unsent"] = samples.unsent;
  result["faults"] = json_of(sim.faults);
  for (Json& fault : result["faults"])
    fault.erase("by_hand");  // a rerun takes them from a file, and has the same entries
  result["interventions"] = interventions(sim.faults, scenario.exchange_period_s);
  if (sim.hand) result["hand"] = json_of(*sim.hand);
  if (!facts.planner_files.empty()) result["planner_files"] = facts.planner_files;
  if (sim.differences) {
    result["differences"] = *sim.differences;
    for (const std::string& text : router.differences.value_or(Texts())) result["differences"].push_back(text);
  }
  result["lost_members"] = json_of(sim.lost_members);
  for (Json& lost : result["lost_members"]) {
    const auto crash = facts.crashes.find(text_in(lost, "member"));
    if (crash != facts.crashes.end()) {
      lost["reason"] = text_in(lost, "reason") + ": " + crash->second;
    }
  }
  result["warnings"] = warnings_of(facts, sim, router, reports);
  for (std::string& text : warnings_of_free_nodes(result["uavs"])) result["warnings"].push_back(std::move(text));
  return result;
}

bool anyone_lost(const Json& result) {
  const Json lost = value_or(result, "lost_members", Json::array());
  return std::ranges::any_of(lost, [](const Json& one) { return !value_or(one, "back_at_s", Json()).is_number(); });
}

bool write_score_csv(const std::filesystem::path& dir, const std::optional<StationReport>& station) {
  const Json scene = read_json(dir / run_folder::kScene);
  if (!scene.is_object()) return false;
  std::map<std::uint64_t, double> scores;
  if (station && station->points) {
    for (const ScoredPointReport& point : *station->points) scores[point.index.value_or(0)] = point.score.value_or(0.0);
  }
  std::ostringstream csv;
  csv << "x,y,z,nx,ny,nz,score,index\n";
  std::uint64_t index = 0;
  for (const Json& point : value_or(scene, "points", Json::array())) {
    for (const Json& number : point) csv << number.dump() << ',';
    const auto found = scores.find(index);
    csv << Json(found == scores.end() ? 0.0 : found->second).dump() << ',' << index << '\n';
    ++index;
  }
  write_file_atomically(dir / run_folder::kScore, csv.str());
  return true;
}

}  // namespace skein::results
