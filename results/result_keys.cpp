#include "results/result_keys.hpp"

#include <string_view>

namespace skein::results {
namespace {

struct KeyKind {
  std::string_view path;  ///< keys separated by dots; `*`: each element of an array, or each value of an object
  std::string_view kind;
};

constexpr std::string_view kText = "a text", kNumber = "a number", kFlag = "true or false", kObject = "an object",
                           kArray = "an array";

/// Outer keys come before the keys in them.
constexpr KeyKind kKeys[] = {
    {"status", kText},
    {"skein_version", kText},
    {"command", kText},
    {"repeat_command", kText},
    {"scenario", kText},
    {"agent", kText},
    {"clock", kText},
    {"math", kText},
    {"conditions", kText},
    {"digest", kText},
    {"deterministic", kFlag},
    {"seed", kNumber},
    {"scene_seed", kNumber},
    {"exchange_period_s", kNumber},
    {"sim_time_s", kNumber},
    {"mission_time_s", kNumber},
    {"wall_time_s", kNumber},
    {"real_time_factor", kNumber},
    {"startup_s", kNumber},
    {"memory_mb", kNumber},
    {"frozen_s", kNumber},
    {"points_total", kNumber},
    {"points_detected", kNumber},
    {"score", kNumber},
    {"score_earned", kNumber},
    {"planner", kObject},
    {"planner.*", kText},
    {"dds", kObject},
    {"dds.*", kText},
    {"station", kObject},
    {"station.position", kArray},
    {"station.position.*", kNumber},
    {"rule_switches", kObject},
    {"timing", kObject},
    {"timing.*", kNumber},
    {"processes", kObject},
    {"processes.*", kObject},
    {"processes.*.cpu_s", kNumber},
    {"processes.*.peak_memory_mb", kNumber},
    {"attainable", kObject},
    {"attainable.points", kNumber},
    {"attainable.score", kNumber},
    {"losses", kObject},
    {"losses.*", kObject},
    {"losses.*.points", kNumber},
    {"losses.*.score", kNumber},
    {"losses.*.by_part", kObject},
    {"losses.*.by_part.*", kObject},
    {"losses.*.by_part.*.points", kNumber},
    {"losses.*.by_part.*.score", kNumber},
    {"score_by_uav", kObject},
    {"score_by_uav.*", kNumber},
    {"flight_check", kObject},
    {"flight_check.braking_hits", kNumber},
    {"flight_check.braking_meets", kNumber},
    {"radio", kObject},
    {"radio.sent", kNumber},
    {"radio.delivered", kNumber},
    {"radio.per_link", kArray},
    {"radio.per_link.*", kObject},
    {"radio.per_link.*.sent", kNumber},
    {"radio.per_link.*.delivered", kNumber},
    {"collisions", kArray},
    {"collisions.*", kObject},
    {"collisions.*.time_s", kNumber},
    {"collisions.*.uav", kText},
    {"collisions.*.position", kArray},
    {"faults", kArray},
    {"faults.*", kObject},
    {"faults.*.began_step", kNumber},
    {"faults.*.ended_step", kNumber},
    {"interventions", kArray},
    {"interventions.*", kObject},
    {"lost_members", kArray},
    {"lost_members.*", kObject},
    {"lost_members.*.member", kText},
    {"lost_members.*.time_s", kNumber},
    {"planner_files", kArray},
    {"planner_files.*", kObject},
    {"hand", kArray},
    {"hand.*", kObject},
    {"differences", kArray},
    {"differences.*", kText},
    {"warnings", kArray},
    {"warnings.*", kText},
    {"uavs", kArray},
    {"uavs.*", kObject},
    {"uavs.*.name", kText},
    {"uavs.*.role", kText},
    {"uavs.*.alive", kFlag},
    {"uavs.*.program_lost", kFlag},
    {"uavs.*.distance_m", kNumber},
    {"uavs.*.max_speed_mps", kNumber},
    {"uavs.*.captures", kNumber},
    {"uavs.*.idle_s", kNumber},
    {"uavs.*.frozen_s", kNumber},
    {"uavs.*.excused_s", kNumber},
    {"uavs.*.without_work_s", kNumber},
    {"uavs.*.commands_rejected", kNumber},
    {"uavs.*.first_rejected_s", kNumber},
    {"uavs.*.commands_unheard", kNumber},
    {"uavs.*.waited_s", kNumber},
    {"uavs.*.planner_cpu_s", kNumber},
    {"uavs.*.planner_cpu_p99_ms", kNumber},
    {"uavs.*.planner_cpu_max_ms", kNumber},
    {"uavs.*.planner_exchanges_over_50ms", kNumber},
    {"uavs.*.planner_parts", kArray},
    {"uavs.*.planner_parts.*", kObject},
    {"uavs.*.planner_parts.*.part", kText},
    {"uavs.*.planner_parts.*.cpu_s", kNumber},
    {"uavs.*.no_way", kArray},
    {"uavs.*.safety_filter", kObject},
    {"uavs.*.safety_filter.steps", kNumber},
    {"uavs.*.safety_filter.slowed", kNumber},
    {"uavs.*.safety_filter.breaches", kNumber},
};

bool is_of_kind(const Json& value, std::string_view kind) {
  if (kind == kText) return value.is_string();
  if (kind == kNumber) return value.is_number();
  if (kind == kFlag) return value.is_boolean();
  return kind == kObject ? value.is_object() : value.is_array();
}

/// A value that fits in a line of a message.
std::string in_short(const Json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_structured()) return value.is_object() ? "an object" : "an array";
  const std::string text = json_text(value);
  return text.size() <= kLongest ? text : value.is_string() ? "a long text" : "a long number";
}

/// Looks at each value under `path` in `json`. @param where  name of `json` @returns as wrong_key()
std::string wrong_value(const Json& json, std::string_view path, std::string_view kind, const std::string& where) {
  if (path.empty()) {
    if (json.is_null() || is_of_kind(json, kind)) return {};
    return where + ": must be " + std::string(kind) + ", not " + in_short(json);
  }
  const std::size_t dot = path.find('.');
  const std::string_view key = path.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  const auto inner = [&](const std::string& name) { return where.empty() ? name : where + "." + name; };
  if (key != "*") {
    const auto found = json.is_object() ? json.find(std::string(key)) : json.end();
    return found == json.end() ? std::string() : wrong_value(*found, rest, kind, inner(std::string(key)));
  }
  std::size_t index = 0;
  for (const auto& [name, value] : json.items()) {
    std::string wrong =
        wrong_value(value, rest, kind, json.is_array() ? where + "[" + std::to_string(index++) + "]" : inner(name));
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace

std::string wrong_key(const Json& result) {
  if (value_or(result, "status", nullptr).is_null()) return "status: is missing, so it is not the result of a run";
  for (const auto& [path, kind] : kKeys) {
    std::string wrong = wrong_value(result, path, kind, {});
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace skein::results
