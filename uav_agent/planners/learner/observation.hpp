// The observation of a learner, as arrays in a memory block shared with the program that steps the fleet. It holds no
// ground truth, only what the UAV's own software received or computed (api/planner.hpp).
// Frame W, angular_velocity B; quaternions w, x, y, z; ages -1: never.   Units: SI and radians.   Threads: one.
// Deterministic.   Shapes and meaning of all arrays: docs/python.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/planners/block_layout.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/learner/config.hpp"

namespace skein::agent {

/// Most boxes in an observation; further boxes are left out. Chosen.
inline constexpr std::size_t kMostBoxes = 32;

class Observation {
 public:
  /// @param config, agent  must outlive this.
  Observation(const LearnerConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// Adds this learner's arrays to the block's layout. Call it first. @param prefix  of their names
  void lay_out(BlockLayout& layout, const std::string& prefix);
  void use(std::byte* block);  ///< From now on, writes to this block, which must have that layout.
  /// Keeps detections, the last outcome and the latest scan until the next write(). Call it at every exchange.
  void note(const PlannerInput& in);
  void write(const PlannerInput& in);  ///< Writes the observation of this exchange into the block.

 private:
  /// Position of the map window, in its cells, and the map's state number then.
  struct Window {
    Eigen::Vector3i from = Eigen::Vector3i::Zero();
    std::uint64_t map = 0;
    bool operator==(const Window&) const = default;
  };

  void write_peers(const PlannerInput& in);
  void write_boxes(const PlannerInput& in);
  void write_detections();
  void write_flight(const PlannerInput& in);
  void write_map(const PlannerInput& in);
  std::uint64_t state_of_map(const PlannerInput& in, const Eigen::Vector3i& from) const;
  void write_cells(const WorldMap& map, const Eigen::Vector3i& from);
  void write_cells(const OccupancyMap& map, const Eigen::Vector3i& from);
  Eigen::Vector3i window() const { return {config_.map_x, config_.map_y, config_.map_z}; }
  std::size_t map_index(const Eigen::Vector3i& cell) const;

  const LearnerConfig& config_;
  const AgentConfig& agent_;
  std::byte* block_ = nullptr;
  BlockArray<double> time_s_, time_left_s_, position_, velocity_, attitude_, angular_velocity_, gimbal_;
  BlockArray<double> boxes_, peers_, peer_velocities_, peer_ages_s_, detections_, map_origin_, scan_age_s_;
  BlockArray<float> scan_;
  BlockArray<std::int8_t> linked_, peers_linked_, airborne_, goal_, map_;
  BlockArray<std::int64_t> box_count_, undelivered_, detection_count_, scan_points_;
  std::deque<DetectedPoint> detected_;
  std::int64_t detected_since_ = 0;  ///< detections since the last write(), including those that are left out
  std::optional<Tick> scan_tick_;
  std::size_t boxes_written_ = 0;
  Outcome::Kind outcome_ = Outcome::Kind::reached;  ///< outcome of the last goal that ended
  bool has_outcome_ = false;
  std::optional<Window> window_;  ///< the window that the block holds now
};

}  // namespace skein::agent
