// Publishes frames, markers and a map in the world domain for viewers, usually RViz 2 (docs/how-to-ros2.md), at no more
// than 10 Hz of simulated time. The server computes only what a program reads. No program of the fleet reads these
// topics and the lock-step does not count them, so no program waits for a viewer; a slow viewer loses samples.
// Frame: W.   Units: SI, radians.   Threads: one.
#pragma once

#include <memory>

#include "bus/bus.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/viz/seen_map.hpp"
#include "sim_server/viz/trails.hpp"

namespace skein::sim {

class VizNode {
 public:
  /// @param world  the server's participant in the world domain; it and the references must outlive this.
  VizNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world);

  /// Call it once per step.
  void publish();

 private:
  using Writer = std::unique_ptr<bus::Writer>;
  /// A latched topic. It is written when a program reads it and its content has changed since it was last written.
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
