// Which radio links there are: line of sight between antennas, range, and what faults cut.
// Threads: one.   Frames: W.
#pragma once

#include <optional>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/for_each.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/conditions/path_loss.hpp"
#include "sim_server/sensors/sight_memory.hpp"

namespace skein::sim {

class LinkTracer {
 public:
  /// Where a UAV's body is, and whether it is on the air.
  struct Place {
    Vector3d p_WB = Vector3d::Zero();
    bool alive = true;
  };

  /// Both must outlive this. @param seed  draws the shadowing, if the scenario's conditions have any.
  LinkTracer(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed = 0);

  /// @param rays  with the bodies where they are. @param uavs  in fleet order.
  /// @returns 1 for a link; with path loss the place of its rate in kRadioRates, counted from 1.
  Links trace(Tick tick, const RayScene& rays, const std::vector<Place>& uavs,
              const ForEach& for_each = one_after_another);
  /// Those of the last trace() before faults limited their range.
  const Links& unfailed() const { return unfailed_; }
  /// Those that blackouts, outages and partitions leave.
  Links open(Tick tick, const Links& links) const;

 private:
  /// Whether an effect ends the link before this distance.
  bool ends_before(const LinkEffect& effect, Node from, Node to, double distance_m) const;
  bool in_range(Node from, Node to, double distance_m) const;
  bool fails(Tick tick, Node from, Node to, double distance_m) const;

  const Scenario& scenario_;
  const FaultPlan& faults_;
  std::optional<PathLoss> path_loss_;
  LinkMatrix<SightMemory> sights_;  ///< of each pair of nodes, the lower one first
  Links unfailed_;
};

}  // namespace skein::sim
