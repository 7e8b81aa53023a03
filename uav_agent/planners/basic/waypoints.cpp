// Flies each UAV along a fixed path: a list of stops from a file. Use it for demonstrations, and to measure sensors and
// scoring along a known path. Example:
//
//   repeat: true
//   paths:
//     jurong:
//       - {position: [0, 5, 10], speed_mps: 3}
//       - {position: [20, 5, 10], speed_mps: 2, look_at: [20, 15, 10], stay_s: 2}
//
// A UAV without a path stays on the ground. Positions are in frame W.   Units: SI, and degrees where the name says so.
#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class WaypointsPlanner final : public Planner {
 public:
  struct Stop {
    Vector3d position = Vector3d::Zero();
    double speed_mps = 2.0;           ///< highest speed on the leg that ends at this stop; chosen
    double stay_s = 0.0;              ///< how long the UAV rests at this stop
    std::optional<double> yaw_deg;    ///< body yaw in W, from the start of this leg on; without it, as before
    std::optional<Vector3d> look_at;  ///< target of the camera, from the start of this leg on; without it, as before

    void describe(auto& r) {
      r.required("position", position);
      r.field("speed_mps", speed_mps, within(0.1, 20.0));
      r.field("stay_s", stay_s, within(0.0, 3600.0));
      r.field("yaw_deg", yaw_deg, within(-360.0, 360.0));
      r.field("look_at", look_at);
      r.check(position.z() > 0.0, "position", "must lie above the ground");
    }
  };

  struct Config {
    bool repeat = false;             ///< begin again after the last stop
    Named<std::vector<Stop>> paths;  ///< by name of the UAV

    void describe(auto& r) {
      r.field("repeat", repeat);
      r.required("paths", paths);
    }
  };

  WaypointsPlanner(const Config& config, const AgentConfig& agent) : config_(config) {
    for (const auto& [name, stops] : config.paths) {
      const bool known = std::any_of(agent.fleet.begin(), agent.fleet.end(),
                                     [&name = name](const FleetMember& member) { return member.name == name; });
      if (!known) throw InputError("planner waypoints: paths: there is no UAV '" + name + "' in this fleet");
      if (name == agent.me().name) stops_ = stops;
    }
  }

  PlannerOutput plan(const PlannerInput& input) override {
    if (stops_.empty()) return {};
    if (started_ && !(input.tracking.done && arrived(input))) return {};
    if (started_ && ++next_ == stops_.size()) {
      next_ = 0;
      finished_ = !config_.repeat;
    }
    if (finished_) {
      stops_.clear();
      return {};
    }
    started_ = true;
    arrived_at_.reset();
    const Stop& stop = stops_[next_];
    PlannerOutput output{.motion = Path{{{stop.position, stop.speed_mps}}}};
    if (stop.yaw_deg) output.yaw = *stop.yaw_deg * kRadPerDeg;
    if (stop.look_at) output.gimbal = *stop.look_at;
    return output;
  }

 private:
  /// Whether the UAV has rested at the current stop for stay_s. Call it only at rest: the first call starts the time.
  bool arrived(const PlannerInput& input) {
    if (!arrived_at_) arrived_at_ = input.tick;
    return input.tick - *arrived_at_ >= ticks(stops_[next_].stay_s);
  }

  const Config config_;
  std::vector<Stop> stops_;  ///< of this UAV
  std::size_t next_ = 0;
  std::optional<Tick> arrived_at_;
  bool started_ = false, finished_ = false;
};

SKEIN_REGISTER_PLANNER("waypoints", WaypointsPlanner);

}  // namespace skein::agent
