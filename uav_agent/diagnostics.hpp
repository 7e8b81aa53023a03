// What a UAV's on-board software knows of itself, as diagnostic_msgs/msg/DiagnosticArray for ROS 2's tools: four parts,
// radio, captures, flight and program, and the battery where there is one.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/told_state.hpp"
#include "idl/diagnostic_types.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

struct DiagnosticFacts {
  std::string uav;
  std::uint64_t k = 0;  ///< of the lock-step
  Tick tick = 0;
  std::optional<double> mission_remaining_s = {};  ///< nullopt before the first take-off
  std::vector<std::string> linked = {};            ///< nodes in line of sight
  std::size_t undelivered = 0;                     ///< captures that the station has not acknowledged
  std::uint64_t unreadable = 0, unsent = 0;        ///< samples
  double planner_cpu_s = 0.0;                      ///< so far
  const SafetyFilter::Counts* filter = nullptr;    ///< none: no flight core flies the planner
  std::uint64_t breaches_told = 0;                 ///< of the filter, with the last message
  std::string no_way = {};                         ///< why its planner found none in this exchange
  std::optional<BatteryStatus> battery = {};
};

msg::DiagnosticArray diagnostics_of(const DiagnosticFacts& facts);

}  // namespace skein::agent
