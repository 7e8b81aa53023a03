#include "run/break_event.hpp"

#include <algorithm>

#include "core/types.hpp"
#include "results/result_file.hpp"

namespace skein::cli {
namespace {

void keep_first(std::optional<double>& first, const Json& time_s) {
  if (time_s.is_number()) first = std::min(first.value_or(time_s.get<double>()), time_s.get<double>());
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

Json result_of_same_flight(const std::filesystem::path& run, const FleetPlan& plan) {
  const Json result = results::read_result_file(run);
  const std::string why = "--break-from " + run.string() + ": ";
  const auto require = [&](bool same, const std::string& what) {
    if (!same) throw InputError(why + "it was flown with another " + what);
  };
  require(value_or(result, "scenario", "") == plan.options.scenario, "scenario");
  require(value_or(result, "seed", Json()) == Json(plan.options.seed), "seed");
  const Json flown = value_or(result, "planner", Json::object());
  for (const UavPlanner& planner : plan.planners) {
    require(value_or(flown, planner.uav.c_str(), "") == written(planner), "planner of " + planner.uav);
  }
  return result;
}

}  // namespace skein::cli
