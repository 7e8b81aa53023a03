// Parameters of the planner patrol (patrol.cpp): --planner patrol:overlap=0.3,approach_mps=3.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planning/standoff.hpp"

namespace skein::agent {

struct PatrolConfig {
  bool top = true, bottom = true;                     ///< also photograph the boxes' top and bottom faces
  double standoff_ratio = StandoffConfig().ratio;     ///< distance to the surface in units of d*
  double blind_ratio = StandoffConfig().blind_ratio;  ///< distance to a box's face where no surface is mapped
  double overlap = StripConfig().overlap;             ///< of neighbouring strips, as a share of their width
  double speed_gain = StandoffConfig().speed_gain;    ///< in units of the greatest speed without blur
  FlightConfig flight = {};

  void describe(auto& r) {
    r.field("top", top);
    r.field("bottom", bottom);
    r.field("standoff_ratio", standoff_ratio, within(0.3, 1.5));
    r.field("blind_ratio", blind_ratio, within(0.2, 1.5));
    r.field("overlap", overlap, within(0.0, 0.8));
    r.field("speed_gain", speed_gain, within(0.2, 5.0));
    flight.describe_by_time(r);
  }
};

}  // namespace skein::agent
