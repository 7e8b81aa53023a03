// What a learner knows, as arrays in the block that it shares with the program that steps it. Nothing of it is the
// truth: it is what the UAV's own software was told or has found out (api/planner.hpp).
// Frame W unless the name says otherwise.   Units: SI and radians.   Threads: one.   Deterministic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/block_layout.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/learner/config.hpp"

namespace skein::agent {

/// More boxes than this are not shown.
inline constexpr std::size_t kMostBoxes = 32;

class Observation {
 public:
  /// @param config, agent  must outlive this.
  Observation(const LearnerConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  void lay_out(BlockLayout& layout, const std::string& prefix);
  void use(std::byte* block);
  /// Keeps what an exchange brought until the next write(). Every exchange.
  void note(const PlannerInput& in);
  void write(const PlannerInput& in);

 private:
  /// Where a window of the map begins, in its cells, and what the map was like.
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
  std::int64_t detected_since_ = 0;  ///< the last write(), those that are not shown among them
  std::optional<Tick> scan_tick_;
  std::size_t boxes_written_ = 0;
  Outcome::Kind outcome_ = Outcome::Kind::reached;  ///< of the last goal that came to its end
  bool has_outcome_ = false;
  std::optional<Window> window_;  ///< that is in the block
};

}  // namespace skein::agent
