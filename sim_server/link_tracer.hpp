// Determines which radio links exist: by line of sight between antennas, range, path loss, and faults that cut links.
// Threads: one, which may share its work.   Frames: W.   Units: m, ticks.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/for_each.hpp"
#include "core/messages/uav_status.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario/scenario.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/conditions/path_loss.hpp"
#include "sim_server/sensors/sight_memory.hpp"

namespace skein::sim {

class LinkTracer {
 public:
  /// Position of a UAV's body, and whether the UAV is alive: a dead one has no radio.
  struct Place {
    Vector3d p_WB = Vector3d::Zero();
    bool alive = true;
  };

  /// Both must outlive this. @param seed  draws the shadowing, if the scenario's conditions have any.
  LinkTracer(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed = 0);

  /// Changes the radio conditions for the traces that follow. Has no effect if the scenario has no path loss.
  void change(const RadioConditions& radio) {
    if (path_loss_) path_loss_->change(radio);
  }

  /// @param rays  with all bodies at their present poses. @param uavs  in fleet order.
  /// @returns 0: no link; 1: a link, or with path loss the index of its data rate in kRadioRates, counted from 1.
  Links trace(Tick tick, const RayScene& rays, const std::vector<Place>& uavs,
              const ForEach& for_each = one_after_another);
  /// The links of the last trace() as they would be if no fault limited their range.
  const Links& unfailed() const { return unfailed_; }
  /// @param level  of this link, as trace() and open() return it. @returns the link's quality since the last trace();
  /// nullopt: the link is closed, or the scenario has no path loss.
  std::optional<LinkQuality> quality(std::uint8_t level, Node from, Node to) const;
  /// @returns `links` without those that blackouts, outages and partitions cut in the exchange at this tick.
  Links open(Tick tick, const Links& links) const;

 private:
  /// The shadowing field at a radio node.
  struct NodeField {
    Vector3d p_W = Vector3d::Zero();
    std::optional<double> value;  ///< nullopt: not yet computed
  };

  void update(NodeField& field, const Vector3d& p_W) const;
  /// Whether this effect limits this link to a range shorter than this distance.
  bool ends_before(const LinkEffect& effect, Node from, Node to, double distance_m) const;
  bool in_range(Node from, Node to, double distance_m) const;
  bool fails(Tick tick, Node from, Node to, double distance_m) const;

  const Scenario& scenario_;
  const FaultPlan& faults_;
  const std::optional<double> range_m_;  ///< of every link between UAVs; nullopt: not limited
  std::optional<PathLoss> path_loss_;
  std::vector<NodeField> fields_;    ///< by node; empty without path loss
  LinkMatrix<double> received_dbm_;  ///< of links in range with line of sight; empty without path loss
  /// Of pairs that were in range: by the lower node, then by the higher one.
  std::vector<std::unordered_map<std::size_t, SightMemory>> sights_;
  Links unfailed_;
};

}  // namespace skein::sim
