// What the server writes into the world's domain for who looks on, in RViz 2 as a rule (docs/ros2.md). Only what
// somebody reads is made, at 10 Hz of simulated time at most. Nobody in the fleet reads any of it and it is in no
// count, so that nobody waits for a viewer; what a slow one does not take is lost to it.
#pragma once

#include <memory>

#include "bus/bus.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/viz/seen_map.hpp"
#include "sim_server/viz/trails.hpp"

namespace skein::sim {

class VizNode {
 public:
  /// @param world  of the server; it and the references must outlive this.
  VizNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world);

  /// In each step.
  void publish();

 private:
  using Writer = std::unique_ptr<bus::Writer>;
  /// A latched topic, written when somebody reads it and it is not what was written last.
  struct Latched {
    Writer writer;
    bool stale = true;
  };

  void publish_static();
  void publish_moving();

  const Scenario& scenario_;
  const Simulation& simulation_;
  Latched structure_, boxes_, fixed_frames_, map_;
  Writer links_, frusta_, fleet_, paths_, frames_, clock_;
  viz::Trails trails_;
  viz::SeenMap seen_;
  Tick due_ = 0, map_due_ = 0;
  bool paths_stale_ = true;
};

}  // namespace skein::sim
