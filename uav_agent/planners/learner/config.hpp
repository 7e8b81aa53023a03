// Parameters of the planner learner (learner.cpp). skein.Fleet writes them (docs/how-to-python.md).
// Units: SI unless the name says otherwise.
#pragma once

#include <array>
#include <cstdint>

#include "core/config/config_reader.hpp"
#include "uav_agent/planners/hand/config.hpp"

namespace skein::agent {

/// What a learner is told.
enum class Flies { velocity, way };
constexpr std::array<EnumName<Flies>, 2> enum_names(Flies) {
  return {{{"velocity", Flies::velocity}, {"way", Flies::way}}};
}

struct LearnerConfig {
  Flies flies = Flies::velocity;
  bool safe = true;            ///< the safety filter has the last word
  int detections = 256;        ///< the newest that it shows
  int map_x = 16, map_y = 16;  ///< cells of the window of its map; 0: none
  int map_z = 8;
  double map_cell_m = 1.0;
  bool scans = false;        ///< it shows the latest scan of its own LiDAR
  FlightConfig flight = {};  ///< approach_mps and climb_mps bound what is asked for

  HandConfig by_velocity() const { return {.file = {}, .safe = safe, .flight = flight}; }

  template <class R>
  void describe(R& r) {
    r.field("flies", flies);
    r.field("safe", safe);
    r.field("detections", detections, within(0, 100000));
    r.field("map_x", map_x, within(0, 256));
    r.field("map_y", map_y, within(0, 256));
    r.field("map_z", map_z, within(0, 256));
    r.field("map_cell_m", map_cell_m, within(0.5, 16.0));
    r.field("scans", scans);
    flight.describe(r);
  }
};

}  // namespace skein::agent
