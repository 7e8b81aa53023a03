#include "cli/bench/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "core/text/suggestion.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

using Measure = std::function<double(const Json&)>;

Json figure_of(const std::vector<Json>& results, const Measure& measure) {
  std::vector<double> values;
  for (const Json& result : results) values.push_back(measure(result));
  return figure(values);
}

double real_time_factor(const Json& result) { return number_in(result, "real_time_factor"); }
double resident_mb(const Json& result) { return number_in(result, "memory_mb"); }
double memory_mb(const Json& result) {
  double sum_mb = 0.0;
  const Json processes = value_or(result, "processes", Json::object());
  for (const Json& use : processes) sum_mb += number_in(use, "memory_share_mb");
  return sum_mb;
}
double startup_s(const Json& result) { return number_in(result, "startup_s"); }

double steps(const Json& result) { return number_in(value_or(result, "timing", Json::object()), "steps"); }
double rounds_per_s(const Json& result) { return ratio(steps(result), number_in(result, "wall_time_s")); }

double cpu_of(const Json& result, const std::function<bool(const std::string&)>& which) {
  double cpu_s = 0.0;
  const Json processes = value_or(result, "processes", Json::object());
  for (const auto& [name, use] : processes.items()) {
    if (which(name)) cpu_s += number_in(use, "cpu_s");
  }
  return cpu_s;
}

constexpr const char* kInOneProcess = "one process";

bool in_one_process(const Json& result) {
  return value_or(result, "processes", Json::object()).contains(programs::kOneProcess);
}

/// How the programs communicated: "one process", the name of the only DDS vendor, or "mixed" if there were several.
std::string medium_of(const Json& result) {
  if (in_one_process(result)) return kInOneProcess;
  std::set<std::string> vendors;
  for (const Json& vendor : value_or(result, "dds", Json::object())) {
    if (vendor.is_string()) vendors.insert(vendor.get<std::string>());
  }
  return vendors.size() == 1 ? *vendors.begin() : "mixed";
}

double planner_cpu_s(const Json& result) {
  double cpu_s = 0.0;
  for (const Json& uav : value_or(result, "uavs", Json::array())) cpu_s += number_in(uav, "planner_cpu_s");
  return cpu_s;
}

/// CPU time of all processes during the flight [s]. The launcher begins to measure it when the server reports the first
/// step. By then, a fleet that flies for only some milliseconds has done much of its work. So use the sum of the times
/// that server and agents have measured themselves if it is larger.
double all_cpu_s(const Json& result) {
  const double counted_s = number_in(value_or(result, "timing", Json::object()), "cpu_s") + planner_cpu_s(result);
  return std::max(counted_s, fleet_cpu_s(result));
}

/// CPU time of the simulation itself in the server [s].
double simulation_cpu_s(const Json& result) {
  const Json timing = value_or(result, "timing", Json::object());
  return number_in(timing, "physics_s") + number_in(timing, "lidar_s") + number_in(timing, "camera_s") +
         number_in(timing, "links_s");
}

/// The result whose real-time factor is nearest to the median. All parts of a breakdown come from this one run, because
/// medians of the parts would not add up to the whole.
const Json& typical(const std::vector<Json>& results) {
  std::vector<double> factors;
  for (const Json& result : results) factors.push_back(real_time_factor(result));
  const double middle = median(factors);
  return *std::ranges::min_element(results, {},
                                   [&](const Json& result) { return std::abs(real_time_factor(result) - middle); });
}

Json statuses(const std::vector<Json>& results) {
  Json all = Json::array();
  for (const Json& result : results) all.push_back(value_or(result, "status", "none"));
  return all;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Json figure(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax_element(values);
  return {{"median", median(values)},
          {"min", values.empty() ? 0.0 : *least},
          {"max", values.empty() ? 0.0 : *most},
          {"values", values}};
}

Json work_of(const Json& result) {
  const Json timing = value_or(result, "timing", Json::object());
  const double total_s = all_cpu_s(result), sim_s = number_in(result, "sim_time_s");
  Json work = Json::object();
  double named_s = 0.0;
  const auto add = [&](const char* kind, double cpu_s) {
    work[kind] = {{"cpu_s", cpu_s}, {"share", ratio(cpu_s, total_s)}, {"ms_per_sim_s", 1e3 * ratio(cpu_s, sim_s)}};
    named_s += cpu_s;
  };
  add("physics", number_in(timing, "physics_s"));
  add("lidar", number_in(timing, "lidar_s"));
  add("camera", number_in(timing, "camera_s"));
  add("line_of_sight", number_in(timing, "links_s"));
  add("recording", number_in(timing, "recording_s"));
  const bool shared = in_one_process(result);
  const double server_s = (shared ? number_in(timing, "cpu_s")
                                  : cpu_of(result, [](const auto& name) { return name == programs::kSimServer; })) -
                          named_s;
  add("agents", planner_cpu_s(result));
  add("exchange", std::max(0.0, total_s - named_s));
  if (shared) {
    const double exchange_s = number_in(work["exchange"], "cpu_s"), of_server_s = std::clamp(server_s, 0.0, exchange_s);
    work["exchange"]["by_program"] = {{programs::kSimServer, of_server_s}, {"all others", exchange_s - of_server_s}};
    return work;
  }
  work["exchange"]["by_program"] = {
      {programs::kSimServer, server_s},
      {programs::kCommRouter, cpu_of(result, [](const auto& name) { return name == programs::kCommRouter; })},
      {programs::kStation, cpu_of(result, [](const auto& name) { return name == programs::kStation; })},
      {"uav_agents", cpu_of(result, programs::is_agent) - planner_cpu_s(result)}};
  return work;
}

std::string text_of_threads(int threads) {
  return fmt::format("{}, {}", kInOneProcess, counted(static_cast<std::size_t>(threads), "thread"));
}

Json speed_entry(const std::vector<Json>& results, const Json& lidar, int threads) {
  const Json& run = typical(results);
  const Json timing = value_or(run, "timing", Json::object());
  return {{"scenario", value_or(run, "scenario", "")},
          {"medium", medium_of(run)},
          {"threads", threads},
          {"uavs", value_or(run, "uavs", Json::array()).size()},
          {"status", statuses(results)},
          {"sim_time_s", number_in(run, "sim_time_s")},
          {"real_time_factor", figure_of(results, real_time_factor)},
          {"rounds_per_s", figure_of(results, rounds_per_s)},
          {"cores_busy",
           figure_of(results, [](const Json& r) { return ratio(all_cpu_s(r), number_in(r, "wall_time_s")); })},
          {"memory_mb", figure_of(results, memory_mb)},
          {"resident_mb", figure_of(results, resident_mb)},
          {"startup_s", figure_of(results, startup_s)},
          {"cpu_s", all_cpu_s(run)},
          {"work", work_of(run)},
          {"lidar",
           {{"scans_computed", value_or(timing, "scans", 0)},
            {"ms_per_computed_scan", value_or(timing, "lidar_ms_per_scan", nullptr)},
            {"every_scan", lidar}}}};
}

Json rounds_entry(const std::string& vendor, std::size_t uavs, const std::vector<RoundsPair>& pairs) {
  std::vector<Json> fleets, floors;
  std::vector<double> wall_ratios, cpu_ratios;
  const auto floor_rate = [](const Json& floor) {
    return ratio(number_in(floor, "rounds"), number_in(floor, "wall_s"));
  };
  const auto floor_cpu_ms = [](const Json& floor) {
    return 1e3 * ratio(number_in(floor, "cpu_s"), number_in(floor, "rounds"));
  };
  const auto fleet_cpu_ms = [](const Json& fleet) { return 1e3 * ratio(all_cpu_s(fleet), steps(fleet)); };
  for (const RoundsPair& pair : pairs) {
    fleets.push_back(pair.fleet);
    floors.push_back(pair.floor);
    wall_ratios.push_back(ratio(floor_rate(pair.floor), rounds_per_s(pair.fleet)));
    cpu_ratios.push_back(ratio(fleet_cpu_ms(pair.fleet), floor_cpu_ms(pair.floor)));
  }
  const Json first_floor = floors.empty() ? Json::object() : floors.front();
  return {{"vendor", vendor},
          {"uavs", uavs},
          {"messages_per_round", value_or(first_floor, "messages", 0)},
          {"bytes_per_round", value_or(first_floor, "bytes", 0)},
          {"fleet_rounds_per_s", figure_of(fleets, rounds_per_s)},
          {"floor_rounds_per_s", figure_of(floors, floor_rate)},
          {"times_floor", figure(wall_ratios)},
          {"fleet_cpu_ms_per_round", figure_of(fleets, fleet_cpu_ms)},
          {"floor_cpu_ms_per_round", figure_of(floors, floor_cpu_ms)},
          {"times_floor_cpu", figure(cpu_ratios)},
          {"simulation_cpu_ms_per_round",
           figure_of(fleets, [](const Json& r) { return 1e3 * ratio(simulation_cpu_s(r), steps(r)); })}};
}

Json scale_entry(std::size_t uavs, const std::vector<Json>& results, int threads) {
  const Json& run = typical(results);
  double largest_mb = 0.0, agents_mb = 0.0, agents = 0.0;
  const Json processes = value_or(run, "processes", Json::object());
  for (const auto& [name, use] : processes.items()) {
    largest_mb = std::max(largest_mb, number_in(use, "memory_share_mb"));
    agents += programs::is_agent(name) ? 1.0 : 0.0;
    agents_mb += programs::is_agent(name) ? number_in(use, "memory_share_mb") : 0.0;
  }
  return {{"uavs", uavs},
          {"medium", medium_of(run)},
          {"threads", threads},
          {"status", statuses(results)},
          {"to_the_end", std::ranges::all_of(results, ran_to_the_end)},
          {"sim_time_s", number_in(run, "sim_time_s")},
          {"real_time_factor", figure_of(results, real_time_factor)},
          {"rounds_per_s", figure_of(results, rounds_per_s)},
          {"memory_mb", figure_of(results, memory_mb)},
          {"resident_mb", figure_of(results, resident_mb)},
          {"largest_process_mb", largest_mb},
          {"mean_agent_mb", ratio(agents_mb, agents)},
          {"startup_s", figure_of(results, startup_s)},
          {"work", work_of(run)}};
}

Json step_entry(const std::vector<Json>& results) {
  std::vector<double> round_ms, cpu_ms;
  for (const Json& result : results) {
    round_ms.push_back(1e3 * ratio(number_in(result, "wall_time_s"), steps(result)));
    cpu_ms.push_back(1e3 * ratio(all_cpu_s(result), steps(result)));
  }
  return {{"round_ms", median(round_ms)}, {"cpu_ms", median(cpu_ms)}};
}

Json relay_entry(const std::string& vendor, const std::vector<Json>& reports) {
  const auto median_in = [](const char* key) {
    return [key](const Json& report) { return number_in(value_or(report, key, Json::object()), "median"); };
  };
  return {{"vendor", vendor},
          {"bytes", reports.empty() ? Json() : value_or(reports.front(), "bytes", nullptr)},
          {"router_us", figure_of(reports, median_in("router_us"))},
          {"relay_us", figure_of(reports, median_in("relay_us"))},
          {"times_relay", figure_of(reports, [](const Json& report) { return number_in(report, "times_relay"); })}};
}

Json load_entry(std::size_t uavs, const std::vector<Json>& results) {
  const auto radio = [](const Json& result, const char* key) {
    return number_in(value_or(result, "radio", Json::object()), key);
  };
  const auto in_sight = [=](const Json& r) { return radio(r, "sent") - radio(r, "dropped_no_los"); };
  return {{"uavs", uavs},
          {"to_the_end", std::ranges::all_of(results, ran_to_the_end)},
          {"messages_per_s",
           figure_of(results, [=](const Json& r) { return ratio(radio(r, "sent"), number_in(r, "sim_time_s")); })},
          {"lost", figure_of(results, [=](const Json& r) { return in_sight(r) - radio(r, "delivered"); })},
          {"arrived", figure_of(results, [=](const Json& r) { return ratio(radio(r, "delivered"), in_sight(r)); })},
          {"real_time_factor", figure_of(results, real_time_factor)}};
}

Json memory_entry(const Json& short_run, const Json& long_run) {
  return {{"short_s", number_in(short_run, "sim_time_s")},
          {"long_s", number_in(long_run, "sim_time_s")},
          {"short_mb", memory_mb(short_run)},
          {"long_mb", memory_mb(long_run)},
          {"growth", ratio(memory_mb(long_run), memory_mb(short_run))}};
}

double fleet_cpu_s(const Json& result) {
  return cpu_of(result, [](const std::string&) { return true; });
}

bool ran_to_the_end(const Json& result) {
  return value_or(result, "status", "") == "completed" && value_or(result, "lost_members", Json::array()).empty();
}

}  // namespace skein::cli
