#include "uav_agent/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/text/suggestion.hpp"
#include "idl/conversions.hpp"

namespace skein::agent {
namespace {

constexpr std::uint8_t kOk = 0, kWarning = 1;
constexpr double kPercent = 100.0;  ///< format
constexpr double kLowCharge = 0.2;  ///< below, the battery is a warning; chosen

using Values = std::vector<std::pair<std::string, std::string>>;

msg::DiagnosticStatus status(const DiagnosticFacts& facts, const char* part, bool fine, const std::string& message,
                             const Values& values) {
  msg::DiagnosticStatus status;
  status.level(fine ? kOk : kWarning);
  status.name(facts.uav + ": " + part);
  status.message(message);
  status.hardware_id(facts.uav);
  for (const auto& [key, value] : values) {
    msg::KeyValue entry;
    entry.key(key);
    entry.value(value);
    status.values().push_back(entry);
  }
  return status;
}

msg::DiagnosticStatus radio(const DiagnosticFacts& facts) {
  const bool station = std::ranges::find(facts.linked, "gcs") != facts.linked.end();
  return status(facts, "radio", station, station ? "linked to the station" : "no link to the station",
                {{"linked", joined(facts.linked, " ")}});
}

msg::DiagnosticStatus captures(const DiagnosticFacts& facts) {
  return status(facts, "captures", true, fmt::format("{} not delivered", facts.undelivered),
                {{"undelivered", std::to_string(facts.undelivered)}});
}

msg::DiagnosticStatus flight(const DiagnosticFacts& facts) {
  if (facts.filter == nullptr) {
    return status(facts, "flight", true, "the planner flies without the flight core: no safety filter", {});
  }
  const bool breached = facts.filter->broken > facts.breaches_told;
  const bool fine = !breached && facts.no_way.empty();
  const std::string message = !facts.no_way.empty() ? "no way: " + facts.no_way
                              : breached            ? "not within proved space, as on the ground"
                                                    : "within proved space";
  return status(facts, "flight", fine, message,
                {{"safety_filter_steps", std::to_string(facts.filter->exchanges)},
                 {"safety_filter_slowed", std::to_string(facts.filter->slowed)},
                 {"safety_filter_breaches", std::to_string(facts.filter->broken)}});
}

msg::DiagnosticStatus program(const DiagnosticFacts& facts) {
  const bool fine = facts.unreadable == 0 && facts.unsent == 0;
  Values values = {{"step", std::to_string(facts.k)},
                   {"unreadable_samples", std::to_string(facts.unreadable)},
                   {"unsent_samples", std::to_string(facts.unsent)},
                   {"planner_cpu_s", fmt::format("{:.3f}", facts.planner_cpu_s)}};
  if (facts.mission_remaining_s) {
    values.emplace_back("mission_remaining_s", fmt::format("{:.2f}", *facts.mission_remaining_s));
  }
  return status(facts, "program", fine, fine ? "in step" : "samples were lost", values);
}

}  // namespace

msg::DiagnosticArray diagnostics_of(const DiagnosticFacts& facts) {
  msg::DiagnosticArray array;
  array.header(to_header(facts.tick));
  array.status({radio(facts), captures(facts), flight(facts), program(facts)});
  if (const auto& battery = facts.battery) {
    const bool fine = battery->charge > kLowCharge;
    array.status().push_back(status(facts, "battery", fine, fmt::format("{:.0f} % charged", kPercent * battery->charge),
                                    {{"charge", fmt::format("{:.4f}", battery->charge)},
                                     {"voltage_v", fmt::format("{:.2f}", battery->voltage_v)}}));
  }
  return array;
}

}  // namespace skein::agent
