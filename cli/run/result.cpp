#include "cli/run/result.hpp"

#include <algorithm>
#include <sstream>

#include "core/file_bytes.hpp"
#include "core/types.hpp"
#include "process/atomic_file.hpp"

#ifndef SKEIN_VERSION
#error "SKEIN_VERSION comes from CMake's project()"
#endif

namespace skein::cli {
namespace {

std::string status_of(const RunFacts& facts, const Json& sim) {
  const Json reported = value_or(sim, "status", nullptr);
  if (facts.interrupted && reported == "aborted") return "interrupted";  // as the user asked
  for (const char* known : {"completed", "no_takeoff", "interrupted", "aborted"}) {
    if (reported == known) return known;
  }
  return facts.interrupted ? "interrupted" : "aborted";
}

/// One entry a UAV, in fleet order, whatever the reports hold.
Json uav_entries(const Scenario& scenario, const Reports& reports) {
  Json entries = Json::array();
  const Json reported = value_or(reports.sim_server, "uavs", Json::array());
  const Json lost = value_or(reports.sim_server, "lost_members", Json::array());
  for (const UavConfig& uav : scenario.fleet) {
    Json source;
    for (const Json& entry : reported) {
      if (value_or(entry, "name", "") == uav.name) source = entry;
    }
    Json entry = {{"name", uav.name}, {"role", name_of(uav.vehicle.role)}};
    for (const char* key :
         {"alive", "distance_m", "max_speed_mps", "captures", "idle_s", "commands_rejected", "commands_unheard"}) {
      entry[key] = value_or(source, key, nullptr);
    }
    entry["program_lost"] = std::any_of(lost.begin(), lost.end(),
                                        [&](const Json& member) { return value_or(member, "member", "") == uav.name; });
    const auto agent = reports.agents.find(uav.name);
    for (const char* key :
         {"planner_cpu_s", "planner_cpu_p99_ms", "planner_cpu_max_ms", "planner_exchanges_over_50ms"}) {
      const Json told = agent == reports.agents.end() ? Json() : value_or(agent->second, key, nullptr);
      entry[key] = told.is_number() ? told : Json();
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

Json score_by_uav(const Scenario& scenario, const Json& station) {
  const Json reported = value_or(station, "score_by_uav", Json::object());
  Json scores = Json::object();
  for (const UavConfig& uav : scenario.fleet) scores[uav.name] = value_or(reported, uav.name.c_str(), 0.0);
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

/// Samples, on all topics of all programs, that were no messages of their topics' types.
std::uint64_t malformed_samples(const Reports& reports) {
  const auto count = [](const Json& report) { return value_or(report, "malformed", 0).get<std::uint64_t>(); };
  std::uint64_t sum = count(reports.sim_server) + count(reports.station) + count(reports.comm_router);
  for (const auto& [uav, report] : reports.agents) sum += count(report);
  return sum;
}

Json radio_counts(const Json& router) {
  Json radio = Json::object();
  for (const char* key : {"sent", "delivered", "dropped_no_los", "dropped_fault", "dropped_overflow", "duplicated",
                          "sent_bytes", "delivered_bytes"})
    radio[key] = value_or(router, key, 0);
  radio["unheard"] = value_or(router, "unheard", 0);
  radio["per_link"] = value_or(router, "per_link", Json::array());
  return radio;
}

Json warnings_of(const RunFacts& facts, const Reports& reports) {
  Json warnings = value_or(reports.sim_server, "warnings", Json::array());
  for (const Json& warning : value_or(reports.comm_router, "warnings", Json::array())) warnings.push_back(warning);
  for (const std::string& warning : facts.warnings) warnings.push_back(warning);
  if (facts.native) warnings.push_back("--native: the digest may differ on another CPU model");
  const auto missing = [&](const Json& report, const std::string& program, const std::string& consequence) {
    const bool expected = facts.out_by_fault.contains(program);  // and told by `faults`
    if (report.is_null() && !expected) warnings.push_back(program + " left no report: " + consequence);
  };
  missing(reports.sim_server, "sim_server", "times are the last that it told");
  missing(reports.station, "station", "the score is the last that it told");
  missing(reports.comm_router, "comm_router", "radio counts are unknown");
  for (const UavPlanner& planner : facts.planners) {
    const auto report = reports.agents.find(planner.uav);
    if (exec_command(planner.spec) || report == reports.agents.end()) continue;
    missing(report->second, "uav_agent-" + planner.uav, "its planner's CPU time is unknown");
  }
  std::string unwritten;
  const auto add_unwritten = [&](const Json& report) {
    for (const Json& file : value_or(report, "unwritten", Json::array())) {
      if (file.is_string()) unwritten += (unwritten.empty() ? "" : "; ") + file.get<std::string>();
    }
  };
  for (const Json* report : {&reports.sim_server, &reports.station, &reports.comm_router}) add_unwritten(*report);
  for (const auto& [uav, report] : reports.agents) add_unwritten(report);
  if (!unwritten.empty()) warnings.push_back("files are missing or cut short: " + unwritten);
  if (const std::uint64_t malformed = malformed_samples(reports); malformed > 0) {
    warnings.push_back(std::to_string(malformed) +
                       " malformed samples were received and dropped; the logs name topics");
  }
  return warnings;
}

}  // namespace

Json value_or(const Json& object, const char* key, Json fallback) {
  if (!object.is_object()) return fallback;
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  const bool same_type = found->is_number() ? fallback.is_number() : found->type() == fallback.type();
  return same_type || fallback.is_null() ? *found : fallback;
}

Reports read_reports(const std::filesystem::path& dir, const Scenario& scenario,
                     const std::map<std::string, Json>& handed_in) {
  const auto report_of = [&](const std::string& program) {
    const auto found = handed_in.find(program);
    return found != handed_in.end() ? found->second : read_json(dir / (program + ".report.json"));
  };
  Reports reports{report_of("sim_server"), report_of("station"), report_of("comm_router"), {}};
  for (const UavConfig& uav : scenario.fleet) reports.agents[uav.name] = report_of("uav_agent-" + uav.name);
  return reports;
}

Json merge_result(const RunFacts& facts, const Scenario& scenario, const Reports& reports) {
  const Json& sim = reports.sim_server;
  Json result;
  result["skein_version"] = SKEIN_VERSION;
  result["scenario"] = facts.scenario;
  result["seed"] = facts.seed;
  result["scene_seed"] = scenario.scene.scene_seed;
  for (const UavPlanner& planner : facts.planners) result["planner"][planner.uav] = planner.spec;
  if (facts.ground_program) result["planner"]["gcs"] = *facts.ground_program;
  if (facts.agent) result["agent"] = facts.agent->string();
  for (const auto& [process, vendor] : facts.dds) result["dds"][process] = vendor;
  result["clock"] = facts.clock;
  result["math"] = facts.native ? "native" : "baseline";
  result["exchange_period_s"] = scenario.exchange_period_s;
  result["rules"] = value_or(sim, "rules", nullptr);
  if (result["rules"].is_null()) result["rules"] = scenario.rules.preset;
  result["status"] = status_of(facts, sim);
  result["deterministic"] = value_or(sim, "deterministic", false);
  result["digest"] = value_or(sim, "digest", nullptr);

  const double sim_time_s = value_or(sim, "sim_time_s", facts.sim_time_s);
  const double wall_time_s = value_or(sim, "wall_time_s", facts.wall_time_s);
  result["sim_time_s"] = sim_time_s;
  result["mission_time_s"] = value_or(sim, "mission_time_s", facts.mission_time_s);
  result["wall_time_s"] = wall_time_s;
  result["real_time_factor"] = wall_time_s > 0.0 ? sim_time_s / wall_time_s : 0.0;
  result["startup_s"] = facts.startup_s;
  add_processes(facts, result);
  result["timing"] = value_or(sim, "timing", Json::object());

  result["points_total"] = value_or(sim, "points_total", nullptr);
  result["points_detected"] = value_or(reports.station, "points_detected", facts.points_detected);
  result["score"] = value_or(reports.station, "score", facts.score);
  result["score_earned"] = value_or(reports.station, "score_earned", facts.score_earned);
  // The oracle is asked afterwards.
  result["attainable"] = {{"points", nullptr}, {"score", nullptr}};
  result["losses"] = nullptr;
  result["score_by_uav"] = score_by_uav(scenario, reports.station);
  result["collisions"] = value_or(sim, "collisions", Json::array());
  result["uavs"] = uav_entries(scenario, reports);
  result["radio"] = radio_counts(reports.comm_router);
  result["radio"]["malformed"] = malformed_samples(reports);
  result["faults"] = value_or(sim, "faults", Json::array());
  result["lost_members"] = value_or(sim, "lost_members", Json::array());
  result["warnings"] = warnings_of(facts, reports);
  return result;
}

bool write_score_csv(const std::filesystem::path& dir, const Json& station_report) {
  const Json scene = read_json(dir / "scene.json");
  if (!scene.is_object()) return false;
  std::map<std::size_t, double> scores;
  for (const Json& point : value_or(station_report, "points", Json::array())) {
    scores[value_or(point, "index", 0).get<std::size_t>()] = value_or(point, "score", 0.0).get<double>();
  }
  std::ostringstream csv;
  csv << "x,y,z,nx,ny,nz,score,index\n";
  std::size_t index = 0;
  for (const Json& point : value_or(scene, "points", Json::array())) {
    for (const Json& number : point) csv << number.dump() << ',';
    const auto found = scores.find(index);
    csv << Json(found == scores.end() ? 0.0 : found->second).dump() << ',' << index << '\n';
    ++index;
  }
  write_file_atomically(dir / "score.csv", csv.str());
  return true;
}

Json parse_json(const std::string& text) {
  constexpr int kDeepest = 32;
  const auto shallow = [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; };
  Json json = Json::parse(text, shallow, false);
  return json.is_discarded() ? Json() : json;
}

Json read_json(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = 256 << 20;
  try {
    return parse_json(read_file_bytes(file, kMostBytes));
  } catch (const InputError&) {
    return nullptr;
  }
}

}  // namespace skein::cli
