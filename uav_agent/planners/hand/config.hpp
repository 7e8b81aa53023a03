// Parameters of the planner hand (hand.cpp): --planner jurong=hand:safe=false.
// Units: SI unless the name says otherwise.
#pragma once

#include <filesystem>

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

struct HandConfig {
  /// Commands that are flown again (core/planners/hand_file.hpp); empty: somebody gives them now
  std::filesystem::path file;
  bool safe = true;          ///< the safety filter has the last word
  FlightConfig flight = {};  ///< approach_mps and climb_mps bound what is asked for

  template <class R>
  void describe(R& r) {
    r.field("file", file);
    r.field("safe", safe);
    flight.describe(r);
  }
};

}  // namespace skein::agent
