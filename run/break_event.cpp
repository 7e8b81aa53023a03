#include "run/break_event.hpp"

#include <algorithm>

#include "core/faults/fault_plan.hpp"
#include "core/scenario/conditions.hpp"
#include "core/types.hpp"
#include "results/result_file.hpp"

namespace skein::cli {
namespace {

void keep_first(std::optional<double>& first, const Json& time_s) {
  if (time_s.is_number()) first = std::min(first.value_or(time_s.get<double>()), time_s.get<double>());
}

/// Whether the faults of a result can be those of a plan. Only the run decides the times of faults with a condition.
bool same_faults(const Json& flown, const FaultPlan& plan) {
  return std::ranges::equal(flown, plan.faults, [](const Json& then, const Fault& now) {
    const bool same_times =
        now.when || (number_if_any(then, "at_s") == now.at_s && number_if_any(then, "until_s") == now.until_s);
    return same_times && text_in(then, "kind") == fault_kind(now) && text_in(then, "target") == fault_target(now) &&
           text_in(then, "when") == (now.when ? now.when->text : "");
  });
}

}  // namespace

std::optional<double> event_time_s(const Json& result, const std::string& member, const std::string& what) {
  std::optional<double> first;
  const auto entries = [&](const char* key) { return value_or(result, key, Json::array()); };
  const auto names = [&](const Json& entry, const char* key) { return value_or(entry, key, "") == member; };
  const auto time_of = [](const Json& entry, const char* key) { return value_or(entry, key, Json()); };
  const Json period_s = value_or(result, "exchange_period_s", Json());
  if (what == "collision") {
    for (const Json& entry : entries("collisions")) {
      if (names(entry, "uav") || names(entry, "with")) keep_first(first, time_of(entry, "time_s"));
    }
  } else if (what == "lost" || what == "rejected") {
    const bool lost = what == "lost";
    for (const Json& entry : entries(lost ? "lost_members" : "uavs")) {
      if (names(entry, lost ? "member" : "name"))
        keep_first(first, time_of(entry, lost ? "time_s" : "first_rejected_s"));
    }
    // The exchange at this time decides the event, so the returned time must be later.
    if (first && period_s.is_number()) *first += 0.5 * period_s.get<double>();
  } else {
    for (const Json& entry : entries("faults")) {
      const Json began = time_of(entry, "began_step");
      if (!names(entry, "target") || !began.is_number() || !period_s.is_number()) continue;
      keep_first(first, began.get<double>() * period_s.get<double>());
    }
  }
  return first;
}

std::string other_input(const Json& result, const FleetPlan& plan) {
  const Scenario& scenario = plan.scenario;
  const Json fleet = value_or(result, "uavs", Json::array()), flown = value_or(result, "planner", Json::object());
  const bool same_fleet = std::ranges::equal(
      fleet, scenario.fleet, {}, [](const Json& uav) { return text_in(uav, "name"); }, &UavConfig::name);
  if (text_in(result, "scenario") != plan.options.scenario) return "another scenario";
  if (value_or(result, "seed", Json()) != Json(plan.options.seed)) return "another seed";
  if (value_or(result, "scene_seed", Json()) != Json(scenario.scene.scene_seed)) return "another scene seed";
  if (!same_fleet) return "another fleet";
  for (const UavPlanner& planner : plan.planners) {
    if (text_in(flown, planner.uav.c_str()) != written(planner)) return "another planner of " + planner.uav;
  }
  if (text_in(result, "rules") != scenario.rules.preset) return "other rules";
  const std::string conditions = conditions_text(scenario.conditions);
  if (value_or(result, "conditions", "none") != conditions) return "other conditions";
  return same_faults(value_or(result, "faults", Json::array()), plan.faults) ? "" : "other faults";
}

Json result_of_same_flight(const std::filesystem::path& run, const FleetPlan& plan) {
  Json result = results::read_result_file(run);
  const std::string other = other_input(result, plan);
  if (!other.empty()) throw InputError("--break-from " + run.string() + ": it was flown with " + other);
  return result;
}

}  // namespace skein::cli
