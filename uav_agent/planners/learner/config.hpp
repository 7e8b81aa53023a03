// Parameters of the planner learner (learner.cpp). skein.Fleet writes them (docs/how-to-python.md).
// Units: SI unless the name says otherwise.
#pragma once

#include <array>
#include <cstdint>

#include "core/config/config_reader.hpp"
#include "uav_agent/planners/hand/config.hpp"

namespace skein::agent {

/// Kind of motion that the orders contain.
enum class Flies { velocity, way };
constexpr std::array<EnumName<Flies>, 2> enum_names(Flies) {
  return {{{"velocity", Flies::velocity}, {"way", Flies::way}}};
}

struct LearnerConfig {
  Flies flies = Flies::velocity;
  bool safe = true;      ///< the safety filter may override the orders
  int detections = 256;  ///< most detections in an observation: the newest; chosen
  /// Cells of the map window in the observation; 0: no map. Chosen.
  int map_x = 16, map_y = 16, map_z = 8;
  double map_cell_m = 1.0;   ///< edge of a cell; chosen
  bool scans = false;        ///< the observation has the latest scan of the UAV's own LiDAR
  FlightConfig flight = {};  ///< approach_mps and climb_mps limit an ordered velocity

  HandConfig by_velocity() const { return {.file = {}, .safe = safe, .flight = flight}; }

  void describe(auto& r) {
    r.field("flies", flies);
    r.field("safe", safe);
    r.field("detections", detections, within(0, 100000));
    r.field("map_x", map_x, within(0, 256));
    r.field("map_y", map_y, within(0, 256));
    r.field("map_z", map_z, within(0, 256));
    r.field("map_cell_m", map_cell_m, within(0.5, 16.0));
    r.field("scans", scans);
    flight.describe_by_time(r);
  }
};

}  // namespace skein::agent
