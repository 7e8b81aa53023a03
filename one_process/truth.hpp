// The ground truth of a fleet that is stepped: the server's world and the station's tally. The program that steps the
// fleet receives it in arrays whose names begin with "truth."; no UAV receives any of it.
// Frame W.   Units: SI and radians.   Threads: one.
#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/planners/block_layout.hpp"
#include "sim_server/step_gate.hpp"
#include "station/score_view.hpp"

namespace skein::one_process {

class Truth {
 public:
  /// @param uavs  names in fleet order.
  Truth(std::shared_ptr<station::ScoreView> score, std::vector<std::string> uavs)
      : score_(std::move(score)), uavs_(std::move(uavs)) {}
  /// Adds the arrays of the truth to the layout.
  void lay_out(BlockLayout& layout);

  /// Call it in each step: notes the collisions of that step. @param simulation, digest  must live until keep().
  void follow(const sim::Simulation& simulation, const sim::RunDigest& digest);
  /// Call it before simulation and digest end: result() and scene() keep returning their last values.
  void keep();

  /// Writes the present state into a block with the layout of lay_out().
  void write(std::byte* block) const;
  /// Digest, score, and each UAV's totals so far.
  nlohmann::json result() const;
  /// Boxes and interest points: for each point, the quality delivered and earned, and whether it was ever seen.
  nlohmann::json scene() const;

 private:
  void write_score(std::byte* block) const;

  const std::shared_ptr<station::ScoreView> score_;
  const std::vector<std::string> uavs_;
  const sim::Simulation* simulation_ = nullptr;  ///< null: not begun, or ended
  const sim::RunDigest* digest_ = nullptr;
  mutable std::uint64_t standing_ = 0;  ///< Scoreboard::standing() when the score earned was written last
  nlohmann::json kept_result_, kept_scene_;
  nlohmann::json collisions_ = nlohmann::json::array();
  BlockArray<std::int64_t> step_, points_, captures_;
  BlockArray<double> time_s_, score_now_, earned_;
  BlockArray<double> position_, attitude_, velocity_, angular_velocity_, gimbal_, distance_m_;
  BlockArray<std::int8_t> mission_, alive_, airborne_;
};

}  // namespace skein::one_process
