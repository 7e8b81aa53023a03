#include "cli/bench/targets.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "cli/bench/report.hpp"

namespace skein::cli {
namespace {

constexpr std::array<double, 3> kRoundsTargets = {5.0, 20.0, 100.0};  ///< UAVs

const Json* find(const Json& report, const char* part, const std::function<bool(const Json&)>& wanted) {
  const auto entries = report.find(part);
  if (entries == report.end()) return nullptr;
  const auto found = std::find_if(entries->begin(), entries->end(), wanted);
  return found == entries->end() ? nullptr : &*found;
}

/// How a fleet flew.
struct Way {
  enum Kind { over_dds, one_thread, all_cores } kind = over_dds;
  std::string text;  ///< appended to the name of what was flown
};

Way way_of(const Json& entry) {
  const int threads = static_cast<int>(number_in(entry, "threads"));
  if (threads == 0) return {};
  return {threads == 1 ? Way::one_thread : Way::all_cores, ", " + text_of_threads(threads)};
}

/// For five UAVs: the required and the desired real-time factor, and the largest memory [MB].
struct SpeedTarget {
  double factor, aim, most_mb;
};
const std::map<Way::Kind, SpeedTarget> kSpeedTargets = {{Way::over_dds, {50.0, 60.0, 250.0}},
                                                        {Way::one_thread, {80.0, 100.0, 100.0}},
                                                        {Way::all_cores, {130.0, 170.0, 100.0}}};
/// Required real-time factor on two cores, by number of UAVs and way of flying.
const std::map<std::pair<double, Way::Kind>, double> kScaleTargets = {{{20.0, Way::over_dds}, 15.0},
                                                                      {{100.0, Way::over_dds}, 2.0},
                                                                      {{20.0, Way::all_cores}, 25.0},
                                                                      {{100.0, Way::all_cores}, 5.0}};

Json target(const std::string& name, bool at_least, double wanted, const Json& value, const std::string& unit) {
  Json entry = {{"name", name}, {"kind", at_least ? "at_least" : "at_most"}, {"target", wanted}, {"unit", unit}};
  entry["value"] = value;
  const bool known = value.is_number();
  const double reached = known ? value.get<double>() : 0.0;
  const double factor = at_least ? reached / wanted : reached > 0.0 ? wanted / reached : 0.0;
  entry["met"] = known ? Json(factor >= 1.0) : Json();
  entry["factor"] = known ? Json(factor) : Json();
  return entry;
}

Json value_in(const Json* entry, const char* figure_name, const char* key = "median") {
  return entry == nullptr ? Json() : value_or(value_or(*entry, figure_name, Json::object()), key, nullptr);
}

}  // namespace

Json targets_of(const Json& report) {
  Json targets = Json::array();
  for (const Json& speed : value_or(report, "speed", Json::array())) {
    const Way way = way_of(speed);
    const std::string of = fmt::format("{} UAVs, {}", number_in(speed, "uavs"), text_in(speed, "scenario")) + way.text;
    const auto& [factor, aim, most_mb] = kSpeedTargets.at(way.kind);
    targets.push_back(target("real-time factor, " + of, true, factor, value_in(&speed, "real_time_factor"),
                             fmt::format("x (aim {})", aim)));
    targets.push_back(target("memory, " + of, false, most_mb, value_in(&speed, "resident_mb"), "MB"));
    if (way.kind != Way::over_dds) continue;
    const Json lidar = value_or(value_or(speed, "lidar", Json::object()), "every_scan", Json::object());
    targets.push_back(target("LiDAR, every scan, " + of, false, 0.25, value_or(lidar, "mean_ms", nullptr), "ms"));
  }
  for (const Json& rounds : value_or(report, "rounds", Json::array())) {
    if (value_or(rounds, "vendor", "") != "cyclonedds") continue;
    const std::string uavs = std::to_string(static_cast<int>(number_in(rounds, "uavs")));
    if (!std::ranges::count(kRoundsTargets, number_in(rounds, "uavs"))) continue;
    targets.push_back(target("lock-step against bare DDS, " + uavs + " UAVs", false, 1.5,
                             value_in(&rounds, "times_floor"), "times the floor"));
  }
  const auto of_size = [&](double uavs, Way::Kind kind) {
    return find(report, "scale",
                [=](const Json& entry) { return number_in(entry, "uavs") == uavs && way_of(entry).kind == kind; });
  };
  for (const auto& [what, wanted] : kScaleTargets) {
    const auto& [uavs, kind] = what;
    targets.push_back(target(
        fmt::format("real-time factor, {} UAVs{}", uavs, kind == Way::all_cores ? ", one process, all cores" : ""),
        true, wanted, value_in(of_size(uavs, kind), "real_time_factor"), "x"));
  }
  const Json* hundred = of_size(100.0, Way::over_dds);
  const Json ended = hundred == nullptr ? Json() : Json(value_or(*hundred, "to_the_end", false) ? 1 : 0);
  targets.push_back(target("100 UAVs run to the end", true, 1.0, ended, "(1: yes)"));
  for (const Json& relay : value_or(report, "relay", Json::array())) {
    targets.push_back(target("router against a bare relay, " + text_in(relay, "vendor"), false, 1.3,
                             value_in(&relay, "times_relay"), "times its latency"));
  }
  const Json memory = value_or(report, "memory", Json::object());
  const Json measured_load = value_or(report, "load", Json::object());
  const Json load = number_in(measured_load, "uavs") == 20.0 ? measured_load : Json::object();
  targets.push_back(target("radio, 20 UAVs x 20 topics x 20 Hz: arrived", true, 1.0, value_in(&load, "arrived"), ""));
  targets.push_back(target("and in real time", true, 0.98, value_in(&load, "real_time_factor"), "x"));
  const Json growth = value_or(memory, "growth", nullptr);
  targets.push_back(target("memory after an hour", false, 1.1, growth, "times that of ten minutes"));
  return targets;
}

}  // namespace skein::cli
