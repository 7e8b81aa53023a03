#include "cli/bench/profile.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "cli/bench/flown.hpp"
#include "cli/bench/report.hpp"
#include "cli/bench/scenario.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

const std::vector<std::string> kProfiledPlanners = {"patrol", "kios", "xxh", "star", "flock"};
const std::vector<std::size_t> kSizes = {1, 2, 5, 10, 20, 50}, kQuickSizes = {1, 5, 20};
constexpr double kMission_s = 30.0, kQuickMission_s = 10.0, kExchange_s = 0.05;
constexpr double kFar = 1000.0;  ///< UAVs, to which the growth is extrapolated

double steps_of(const Json& result) { return number_in(value_or(result, "timing", Json::object()), "steps"); }

/// The median over results of a measured quantity per exchange.
double per_exchange(const std::vector<Json>& results, auto measure) {
  std::vector<double> values;
  for (const Json& result : results) {
    if (const double steps = steps_of(result); steps > 0.0) values.push_back(measure(result) / steps);
  }
  return median(std::move(values));
}

}  // namespace

Json profile_entry(const std::string& planner, std::size_t uavs, const std::vector<Json>& results) {
  Json stages = Json::object();
  const Json names = results.empty() ? Json::object() : work_of(results.front());
  for (const auto& [stage, work] : names.items()) {
    const double cpu_s =
        per_exchange(results, [&](const Json& result) { return number_in(work_of(result)[stage], "cpu_s"); });
    stages[stage] = {{"ms", 1e3 * cpu_s}, {"us_a_uav", uavs == 0 ? 0.0 : 1e6 * cpu_s / static_cast<double>(uavs)}};
  }
  const auto count = [&](const char* part, const char* key) {
    return per_exchange(results,
                        [&](const Json& result) { return number_in(value_or(result, part, Json::object()), key); });
  };
  return {{"planner", planner},
          {"uavs", uavs},
          {"stages", stages},
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
  Json growth = {{"stages", Json::object()}, {"first_limit", nullptr}};
  double most_ms = 0.0;
  const Json stages = entries.empty() ? Json::object() : value_or(entries.front(), "stages", Json::object());
  for (const auto& [stage, unused] : stages.items()) {
    std::vector<std::pair<double, double>> cost_by_uavs;
    for (const Json& entry : entries) {
      const Json all = value_or(entry, "stages", Json::object());
      cost_by_uavs.emplace_back(number_in(entry, "uavs"),
                                number_in(value_or(all, stage.c_str(), Json::object()), "ms"));
    }
    const std::optional<Growth> fit = growth_of(cost_by_uavs);
    if (!fit) continue;
    const double far_ms = fit->at(kFar);
    growth["stages"][stage] = {{"exponent", fit->exponent}, {"ms_at_1000", far_ms}};
    if (far_ms <= most_ms) continue;
    most_ms = far_ms;
    growth["first_limit"] = stage;
  }
  return growth;
}

void print_profile(std::ostream& out, const Json& report) {
  const Json entries = value_or(report, "profile", Json::array()), growth = value_or(report, "growth", Json::object());
  for (const auto& [planner, grows] : growth.items()) {
    const Json stages = value_or(grows, "stages", Json::object());
    out << fmt::format("\n{}: CPU time of an exchange [ms] by the size of the fleet\n  {:<6}", planner, "UAVs");
    for (const auto& [stage, unused] : stages.items()) out << fmt::format("{:>15}", stage);
    out << fmt::format("{:>15}\n", "a UAV [us]");
    for (const Json& entry : entries) {
      if (value_or(entry, "planner", "") != planner) continue;
      const Json all = value_or(entry, "stages", Json::object());
      double us_a_uav = 0.0;
      for (const Json& stage : all) us_a_uav += number_in(stage, "us_a_uav");
      out << fmt::format("  {:<6}", number_in(entry, "uavs"));
      for (const auto& [stage, unused] : stages.items()) {
        out << fmt::format("{:>15.3f}", number_in(value_or(all, stage.c_str(), Json::object()), "ms"));
      }
      out << fmt::format("{:>15.0f}\n", us_a_uav);
    }
    out << fmt::format("  {:<6}", "grows");
    for (const auto& [stage, fit] : stages.items())
      out << fmt::format("{:>15}", fmt::format("n^{:.2f}", number_in(fit, "exponent")));
    out << fmt::format("\n  {:<6}", "1000");
    for (const auto& [stage, fit] : stages.items()) out << fmt::format("{:>15.0f}", number_in(fit, "ms_at_1000"));
    const Json limit = value_or(grows, "first_limit", nullptr);
    if (limit.is_string()) out << "   if it goes on so: mostly " << limit.get<std::string>();
    out << '\n';
  }
}

int bench_profile(const BenchOptions& options, const Console& console) {
  const ScratchDir scratch;
  const int repeats = options.repeats.value_or(1);
  const std::vector<std::size_t> sizes = !options.sizes.empty() ? options.sizes : options.quick ? kQuickSizes : kSizes;
  const double mission_s = options.duration_s.value_or(options.quick ? kQuickMission_s : kMission_s);
  Json report = {{"profile", Json::array()}, {"growth", Json::object()}, {"mission_s", mission_s}};
  bool failed = false;
  for (const std::string& planner : kProfiledPlanners) {
    std::vector<Json> entries;
    for (const std::size_t uavs : sizes) {
      const std::filesystem::path file = scratch.path() / ("profile" + std::to_string(uavs) + ".yaml");
      write_file_atomically(file, bench_scenario({uavs, mission_s, kExchange_s}));
      RunOptions run;
      run.scenario = file;
      run.planner = planner;
      run.out = scratch.path() / "run";
      run.force = run.one_process = true;
      run.threads = 1;
      run.attainable = run.report = false;
      std::vector<Json> results;
      for (int i = 0; i < repeats; ++i) {
        const std::string what = fmt::format("{}, {} UAVs, run {} of {}", planner, uavs, i + 1, repeats);
        console.err << "bench: " << what << std::endl;
        results.push_back(fly(run, what, console.err, failed));
      }
      entries.push_back(profile_entry(planner, uavs, results));
      report["profile"].push_back(entries.back());
    }
    report["growth"][planner] = profile_growth(entries);
  }
  print_profile(console.out, report);
  if (options.json) replace_or_overwrite(*options.json, report.dump(2) + "\n");
  return failed ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
