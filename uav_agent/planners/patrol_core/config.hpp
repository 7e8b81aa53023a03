// Parameters of the planner patrol_core (patrol_core.cpp): --planner patrol_core:overlap=0.3,survey=false.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

struct PatrolCoreConfig {
  bool survey = true;              ///< explorers fly once around everything first
  bool top = true, bottom = true;  ///< look at these faces, too
  double survey_mps = 4.5;
  double survey_standoff_m = 10.0;
  double standoff_ratio = 0.92;  ///< distance to the surface in units of d*
  double blind_ratio = 0.55;     ///< distance to a box's face where no surface is mapped
  double overlap = 0.2;
  double speed_gain = 1.0;  ///< 1: no blur
  FlightConfig flight = {};

  template <class R>
  void describe(R& r) {
    r.field("survey", survey);
    r.field("top", top);
    r.field("bottom", bottom);
    r.field("survey_mps", survey_mps, within(0.5, 20.0));
    r.field("survey_standoff_m", survey_standoff_m, within(2.0, 50.0));
    r.field("standoff_ratio", standoff_ratio, within(0.3, 1.5));
    r.field("blind_ratio", blind_ratio, within(0.2, 1.5));
    r.field("overlap", overlap, within(0.0, 0.8));
    r.field("speed_gain", speed_gain, within(0.2, 5.0));
    flight.describe(r);
  }
};

}  // namespace skein::agent
