// Parameters of the planner `hand`, manual flight (hand.cpp): --planner jurong=hand:safe=false.
// Units: SI unless the name says otherwise.
#pragma once

#include <filesystem>

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

struct HandConfig {
  /// File of recorded commands to fly again (core/planners/hand_file.hpp); empty: a user gives commands during the run
  std::filesystem::path file;
  bool safe = true;          ///< the safety filter may override the commands
  FlightConfig flight = {};  ///< approach_mps and climb_mps limit the commanded velocity

  void describe(auto& r) {
    r.field("file", file);
    r.field("safe", safe);
    flight.describe_by_time(r);
  }
};

}  // namespace skein::agent
