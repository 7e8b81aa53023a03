// The simulation as the signals of a run see it (signals/live_signals.hpp).
// Frame: W.   Units: SI; ticks.   Threads: one.
#pragma once

#include <vector>

#include "signals/live_signals.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class SimulatedWorld final : public signals::LiveWorld {
 public:
  /// @param simulation  must outlive this.
  explicit SimulatedWorld(const Simulation& simulation) : simulation_(simulation) {}

  Tick tick() const override { return simulation_.tick(); }
  Uav uav(UavIndex i) const override {
    const UavView& view = simulation_.uav(i);
    return {view.state, view.battery ? view.battery->charge : 1.0, view.alive};
  }
  double clearance(UavIndex i) const override { return simulation_.clearance(i); }
  bool is_open(Node from, Node to) const override { return simulation_.open_links().at(from, to) != 0; }
  const std::vector<Fault>& faults() const override { return simulation_.faults().faults; }
  std::vector<UavIndex> captures() const override {
    std::vector<UavIndex> uavs;
    for (const CaptureEvent& event : simulation_.events().captures) {
      if (event.report) uavs.push_back(event.uav);
    }
    return uavs;
  }

 private:
  const Simulation& simulation_;
};

}  // namespace skein::sim
