#include "cli/bench/profile.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "cli/bench/flown.hpp"
#include "cli/bench/report.hpp"
#include "cli/bench/sizes.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/memory.hpp"
#include "process/program.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

const std::vector<std::string> kProfiledPlanners = {"patrol", "kios", "xxh", "star", "flock"};
const std::vector<std::size_t> kSizes = {1, 5, 20, 100, 300, 1000}, kQuickSizes = {1, 5, 20};
constexpr std::size_t kSmallFleet = 20, kMiddleFleet = 100;  ///< larger fleets get shorter missions
constexpr double kMission_s = 30.0, kMissionOfMiddle_s = 20.0, kMissionOfLarge_s = 10.0, kQuickMission_s = 10.0;
constexpr double kFar = 1000.0;  ///< UAVs, for which the growth is evaluated

double steps_of(const Json& result) { return number_in(value_or(result, "timing", Json::object()), "steps"); }

/// The median over results of a measured quantity per exchange.
double per_exchange(const std::vector<Json>& results, auto measure) {
  std::vector<double> values;
  for (const Json& result : results) {
    if (const double steps = steps_of(result); steps > 0.0) values.push_back(measure(result) / steps);
  }
  return median(std::move(values));
}

/// CPU time of the parts of all UAVs' on-board software [s].
std::map<std::string, double> parts_of(const Json& result) {
  std::map<std::string, double> parts;
  for (const Json& uav : value_or(result, "uavs", Json::array())) {
    for (const Json& part : value_or(uav, "planner_parts", Json::array())) {
      parts[value_or(part, "part", "").get<std::string>()] += number_in(part, "cpu_s");
    }
  }
  return parts;
}

/// A cost of a fleet in an exchange, and each UAV's share of it.
Json cost(double cpu_s, std::size_t uavs) {
  return {{"ms", 1e3 * cpu_s}, {"us_a_uav", uavs == 0 ? 0.0 : 1e6 * cpu_s / static_cast<double>(uavs)}};
}

/// A figure of a stage or part of an entry; 0 if the entry does not have it.
double cost_in(const Json& entry, const char* group, const std::string& name, const char* figure) {
  return number_in(value_or(value_or(entry, group, Json::object()), name.c_str(), Json::object()), figure);
}

/// Names of the stages or parts of all entries, each once.
std::vector<std::string> names_in(const std::vector<Json>& entries, const char* group) {
  std::vector<std::string> names;
  for (const Json& entry : entries) {
    const Json all = value_or(entry, group, Json::object());
    for (const auto& [name, unused] : all.items()) {
      if (std::ranges::count(names, name) == 0) names.push_back(name);
    }
  }
  return names;
}

/// The growth of each stage or part: `exponent` and `ms_at_1000`.
Json growth_in(const std::vector<Json>& entries, const char* group) {
  Json growth = Json::object();
  for (const std::string& name : names_in(entries, group)) {
    std::vector<std::pair<double, double>> cost_by_uavs;
    for (const Json& entry : entries) {
      cost_by_uavs.emplace_back(number_in(entry, "uavs"), cost_in(entry, group, name, "ms"));
    }
    const std::optional<Growth> fit = growth_of(cost_by_uavs);
    if (fit) growth[name] = {{"exponent", fit->exponent}, {"ms_at_1000", fit->at(kFar)}};
  }
  return growth;
}

/// "n^1.20", or "-" if the growth is not known.
std::string exponent_of(const Json& growth, const std::string& name) {
  const Json fit = value_or(growth, name.c_str(), Json::object());
  return fit.empty() ? "-" : fmt::format("n^{:.2f}", number_in(fit, "exponent"));
}

void print_stages(std::ostream& out, const std::string& planner, const std::vector<Json>& entries, const Json& grows) {
  const std::vector<std::string> stages = names_in(entries, "stages");
  const Json growth = value_or(grows, "stages", Json::object());
  const auto print_block = [&](const std::string& title, const char* figure, int digits) {
    out << fmt::format("\n{}: {}, by the size of the fleet\n  {:<8}", planner, title, "UAVs");
    for (const std::string& stage : stages) out << fmt::format("{:>14}", stage);
    out << fmt::format("{:>14}\n", "all");
    for (const Json& entry : entries) {
      double all = 0.0;
      out << fmt::format("  {:<8}", number_in(entry, "uavs"));
      for (const std::string& stage : stages) {
        const double value = cost_in(entry, "stages", stage, figure);
        all += value;
        out << fmt::format("{:>14.{}f}", value, digits);
      }
      out << fmt::format("{:>14.{}f}\n", all, digits);
    }
  };
  print_block("CPU time of an exchange for each UAV [us]", "us_a_uav", 0);
  print_block("CPU time of an exchange [ms]", "ms", 3);
  out << fmt::format("  {:<8}", "grows");
  for (const std::string& stage : stages) out << fmt::format("{:>14}", exponent_of(growth, stage));
  out << fmt::format("\n  {:<8}", "at 1000");
  for (const std::string& stage : stages) {
    out << fmt::format("{:>14.0f}", number_in(value_or(growth, stage.c_str(), Json::object()), "ms_at_1000"));
  }
  const Json limit = value_or(grows, "first_limit", nullptr);
  if (limit.is_string())
    out << "\n  the first limit: " << limit.get<std::string>() << ", which costs most at 1000 UAVs";
  out << '\n';
}

/// The parts of the stage `agents`, and what none of them contains.
void print_parts(std::ostream& out, const std::string& planner, const std::vector<Json>& entries, const Json& grows) {
  std::vector<std::string> parts = names_in(entries, "parts");
  if (parts.empty()) return;
  std::ranges::sort(parts);
  const Json growth = value_or(grows, "parts", Json::object());
  out << fmt::format("\n{}: planner's own time by part, CPU time of an exchange for each UAV [us]\n  {:<28}", planner,
                     "UAVs");
  for (const Json& entry : entries) out << fmt::format("{:>9}", number_in(entry, "uavs"));
  out << fmt::format("{:>9}\n", "grows");
  const auto print_row = [&](const std::string& name, const auto& value, const std::string& grows_as) {
    out << fmt::format("  {:<28}", name);
    for (const Json& entry : entries) out << fmt::format("{:>9.1f}", value(entry));
    out << fmt::format("{:>9}\n", grows_as);
  };
  for (const std::string& part : parts) {
    print_row(
        part, [&](const Json& entry) { return cost_in(entry, "parts", part, "us_a_uav"); }, exponent_of(growth, part));
  }
  const auto whole = [](const Json& entry) { return cost_in(entry, "stages", "agents", "us_a_uav"); };
  const auto rest = [&](const Json& entry) {
    double us = whole(entry);
    for (const std::string& part : parts) us -= cost_in(entry, "parts", part, "us_a_uav");
    return std::max(0.0, us);
  };
  print_row("not in any part", rest, "");
  print_row("all (agents)", whole, exponent_of(value_or(grows, "stages", Json::object()), "agents"));
}

RunOptions profile_run(const std::string& planner, std::size_t uavs, double mission_s) {
  RunOptions run;
  run.scenario = kDistrict;  // it grows with the fleet, so a UAV has as much to do in each size
  run.uavs = uavs;
  run.duration_s = mission_s;
  run.planner = planner;
  run.force = run.one_process = run.time_parts = true;
  run.threads = 1;
  run.attainable = run.report = false;
  return run;
}

double mission_of(std::size_t uavs, const BenchOptions& options) {
  if (options.duration_s || options.quick) return options.duration_s.value_or(kQuickMission_s);
  return uavs <= kSmallFleet ? kMission_s : uavs <= kMiddleFleet ? kMissionOfMiddle_s : kMissionOfLarge_s;
}

/// Flies fleets of one size, with results in `out`. @returns their entry; null if Skein refuses such a fleet, for
/// example because the planner is not made for so many UAVs: then a line on `err` has the reason.
Json measure(const std::string& planner, std::size_t uavs, const BenchOptions& options,
             const std::filesystem::path& out, std::ostream& err, bool& failed) try {
  RunOptions run = profile_run(planner, uavs, mission_of(uavs, options));
  run.out = out;
  std::vector<Json> results;
  const int repeats = options.repeats.value_or(1);
  for (int i = 0; i < repeats; ++i) {
    const std::string what = fmt::format("{}, {} UAVs, run {} of {}", planner, uavs, i + 1, repeats);
    err << "bench: " << what << std::endl;
    results.push_back(fly(run, what, err, failed));
  }
  return profile_entry(planner, uavs, results);
} catch (const InputError& error) {
  err << fmt::format("bench: {}, {} UAVs: not measured: {}", planner, uavs, error.what()) << std::endl;
  return nullptr;
}

}  // namespace

Json profile_entry(const std::string& planner, std::size_t uavs, const std::vector<Json>& results) {
  Json stages = Json::object();
  const Json names = results.empty() ? Json::object() : work_of(results.front());
  for (const auto& [stage, work] : names.items()) {
    const double cpu_s =
        per_exchange(results, [&](const Json& result) { return number_in(work_of(result)[stage], "cpu_s"); });
    stages[stage] = cost(cpu_s, uavs);
  }
  Json parts = Json::object();
  for (const auto& [part, unused] : results.empty() ? std::map<std::string, double>() : parts_of(results.front())) {
    const auto of_part = [&, &part = part](const Json& result) { return parts_of(result)[part]; };
    parts[part] = cost(per_exchange(results, of_part), uavs);
  }
  const auto count = [&](const char* part, const char* key) {
    return per_exchange(results,
                        [&](const Json& result) { return number_in(value_or(result, part, Json::object()), key); });
  };
  return {{"planner", planner},
          {"uavs", uavs},
          {"stages", stages},
          {"parts", parts},
          {"counts",
           {{"scans", count("timing", "scans")},
            {"exposures", count("timing", "exposures")},
            {"radio", count("radio", "delivered")}}}};
}

double Growth::at(double uavs) const { return factor * std::pow(uavs, exponent); }

std::optional<Growth> growth_of(const std::vector<std::pair<double, double>>& cost_by_uavs) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [uavs, cost] : cost_by_uavs) {
    if (uavs <= 0.0 || cost <= 0.0) continue;
    const double log_uavs = std::log(uavs), log_cost = std::log(cost);
    n += 1.0;
    x += log_uavs;
    y += log_cost;
    xx += log_uavs * log_uavs;
    xy += log_uavs * log_cost;
  }
  const double spread = n * xx - x * x;
  if (n < 2.0 || spread <= 1e-9 * n * n) return std::nullopt;
  const double exponent = (n * xy - x * y) / spread;
  return Growth{exponent, std::exp((y - exponent * x) / n)};
}

Json profile_growth(const std::vector<Json>& entries) {
  Json growth = {
      {"stages", growth_in(entries, "stages")}, {"parts", growth_in(entries, "parts")}, {"first_limit", nullptr}};
  double most_ms = 0.0;
  for (const auto& [stage, fit] : growth["stages"].items()) {
    const double far_ms = number_in(fit, "ms_at_1000");
    if (far_ms <= most_ms) continue;
    most_ms = far_ms;
    growth["first_limit"] = stage;
  }
  return growth;
}

void print_profile(std::ostream& out, const Json& report) {
  const Json growth = value_or(report, "growth", Json::object());
  for (const auto& [planner, grows] : growth.items()) {
    std::vector<Json> entries;
    for (const Json& entry : value_or(report, "profile", Json::array())) {
      if (value_or(entry, "planner", "") == planner) entries.push_back(entry);
    }
    print_stages(out, planner, entries, grows);
    print_parts(out, planner, entries, grows);
  }
}

int bench_profile(const BenchOptions& options, const Console& console) {
  const ScratchDir scratch;
  const std::vector<std::size_t> asked = !options.sizes.empty() ? options.sizes : options.quick ? kQuickSizes : kSizes;
  const BenchSizes sizes = sizes_that_fit(asked, memory_left(), false);
  for (const std::string& line : sizes.said) console.err << "bench: " << line << std::endl;
  Json report = {{"profile", Json::array()}, {"growth", Json::object()}};
  bool failed = false;
  for (const std::string& planner : kProfiledPlanners) {
    std::vector<Json> entries;
    for (const BenchSize& fleet : sizes.fleets) {
      Json entry = measure(planner, fleet.uavs, options, scratch.path() / "run", console.err, failed);
      if (entry.is_null()) continue;
      report["profile"].push_back(entry);
      entries.push_back(std::move(entry));
    }
    if (!entries.empty()) report["growth"][planner] = profile_growth(entries);
  }
  if (report["profile"].empty()) throw InputError("bench --profile: no fleet could be measured, as said above");
  print_profile(console.out, report);
  if (options.json) replace_or_overwrite(*options.json, report.dump(2) + "\n");
  return failed ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
