// One explorer alone in a world: the simulation and the on-board software of a run, without a bus between them. The
// software gets the same inputs as in a fleet: odometry, boxes, key frames, scans, angles of the servo.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <functional>
#include <memory>

#include "sim_server/simulation.hpp"
#include "uav_agent/onboard/agent.hpp"

namespace skein::bench {

/// The scenario `cranes` with an explorer as the only UAV. @param start  its start position (x, y) in W [m]; heading 0.
Scenario lone_explorer(const Vector2d& start);

class Explorer {
 public:
  /// @param scenario  with a fleet of one UAV.   @param seed  0: no noise, and the servo starts at angle 0.
  Explorer(const Scenario& scenario, Scene scene, std::uint64_t seed, std::unique_ptr<agent::Planner> planner);

  /// Simulates one exchange.
  void step();
  bool alive() const { return simulation_.uav(UavIndex{0}).alive; }
  const agent::OccupancyMap& map() const { return agent_.map(); }
  /// Events of the last exchange.
  const sim::StepEvents& events() const { return simulation_.events(); }
  const Scene& scene() const { return simulation_.scene(); }

 private:
  sim::Simulation simulation_;
  agent::Agent agent_;
  bool boxes_told_ = false;
};

/// Takes off, hovers, then flies along a line. Passes all beams of its LiDAR to a callback.
class RoutePlanner final : public agent::Planner {
 public:
  struct Config {
    double height_m = 5.0;  ///< height of the hover above the start
    double climb_mps = 2.0;
    double hover_s = 8.0;
    Vector3d along_W = Vector3d::UnitX();  ///< unit vector: direction of the flight after the hover
    double speed_mps = 1.0;
  };
  /// Data of one exchange for the callback.
  struct Seen {
    Tick tick = 0;
    std::optional<double> hovering_s;  ///< time since the start of the hover; nullopt: before it
    RigidBodyState state;
    std::span<const agent::BeamScan> beam_scans;
  };
  using Look = std::function<void(const Seen&)>;

  RoutePlanner(const Config& config, Look look) : config_(config), look_(std::move(look)) {}

  agent::PlannerOutput plan(const agent::PlannerInput& input) override;
  bool wants_beams() const override { return true; }

 private:
  enum class Phase { ground, climb, hover, flight };

  Config config_;
  Look look_;
  Phase phase_ = Phase::ground;
  Tick hovers_since_ = 0;
};

}  // namespace skein::bench
