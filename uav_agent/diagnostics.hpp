// The state of a UAV's on-board software as diagnostic_msgs/msg/DiagnosticArray for ROS 2 tools, with the statuses
// radio, captures, flight and program, and battery if the UAV has one.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/messages/uav_status.hpp"
#include "idl/diagnostic_types.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

struct DiagnosticFacts {
  std::string uav;      ///< name
  std::uint64_t k = 0;  ///< number of the step
  Tick tick = 0;
  std::optional<double> mission_remaining_s = {};  ///< nullopt before the first take-off
  std::vector<std::string> linked = {};            ///< nodes in line of sight
  std::size_t undelivered = 0;                     ///< captures that the station has not acknowledged
  std::uint64_t unreadable = 0, unsent = 0;        ///< samples that could not be read, or not be sent, so far
  double planner_cpu_s = 0.0;                      ///< so far
  const SafetyFilter::Counts* filter = nullptr;    ///< nullptr: no flight core flies the UAV
  std::uint64_t breaches_told = 0;                 ///< filter->broken at the last message
  std::string no_way = {};                         ///< why no path was found in this exchange; empty: no search failed
  std::optional<BatteryStatus> battery = {};
};

msg::DiagnosticArray diagnostics_of(const DiagnosticFacts& facts);

}  // namespace skein::agent
