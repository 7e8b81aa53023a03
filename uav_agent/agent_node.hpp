// One UAV's on-board software as a DDS node: reads topics, executes one step of Agent, writes topics. It joins only the
// UAV's own DDS domain. Everything happens on the thread that calls run().
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/learner.hpp"
#include "uav_agent/kept_maps.hpp"
#include "uav_agent/maps/map_tree.hpp"
#include "uav_agent/member_node.hpp"
#include "uav_agent/onboard/agent.hpp"
#include "uav_agent/radio_node.hpp"

namespace skein::agent {

class AgentNode final : public MemberNode {
 public:
  /// @param frames  see Agent. @param by_hand  whether the node reads commands of a person who flies the UAV by hand.
  AgentNode(const Scenario& scenario, UavIndex uav, std::unique_ptr<Planner> planner, int base_domain, bus::Bus& bus,
            std::shared_ptr<ReadyFrames> frames = nullptr, bool by_hand = false);

  /// Lets `desk` step the planner, which must be a learner. Call it before start(). @param desk  must outlive this.
  void step_by(const LearnerDesk& desk) { desk_ = &desk; }
  /// Writes snapshots of the map that the UAV flies on to `maps`. Call it before start().
  void keep_maps(std::unique_ptr<KeptMaps> maps);
  /// Times the parts of the agent's work, for the report. Call it before start().
  void time_parts();

  void start() override;
  std::optional<std::string> octomap_file() const override { return agent_.map().octomap_file(); }
  std::string end_maps() override;
  std::vector<std::string> no_ways() const override;
  std::optional<double> waited_s() const override { return agent_.waited_s(); }
  std::optional<std::vector<WaitReport>> waits() const override;
  std::optional<SafetyFilterReport> safety_filter() const override;
  std::optional<std::vector<WorkPartReport>> planner_parts() const override;

 private:
  void declare(bus::LockstepClient& client) override;
  void work(const bus::LockstepClient::Step& step) override;
  void send(bus::LockstepClient& client) override;
  void show() override;
  bool may_think() override;
  void show_octomap();
  void show_flight_map();
  void show_diagnostics();
  void read_conditions(bus::LockstepClient& client);
  void read_sensors(bus::LockstepClient& client);
  void read_captures(bus::LockstepClient& client);
  void write(bus::LockstepClient& client) const;

  const Scenario& scenario_;
  const UavIndex uav_;
  const bool by_hand_;
  const RadioNode radio_;
  Agent agent_;
  AgentInput input_;  ///< inputs of the next step, filled as samples arrive
  AgentOutput output_;
  std::map<std::uint64_t, msg::CaptureReport> reports_;  ///< not yet acknowledged, by capture
  std::vector<std::uint64_t> released_;                  ///< acknowledged captures that the camera may forget
  std::unique_ptr<bus::Writer> octomap_, flight_map_, diagnostics_;
  Tick octomap_due_ = 0, flight_map_due_ = 0, diagnostics_due_ = 0;
  std::uint64_t breaches_told_ = 0;  ///< the safety filter's breaches in the last diagnostics
  std::uint64_t shown_key_frames_ = 0;
  std::optional<MapTree> shown_tree_;          ///< as last written to flight_map_; nullopt: not written yet
  std::uint64_t shown_flight_key_frames_ = 0;  ///< the same for a UAV without a world map: number of key frames
  std::unique_ptr<KeptMaps> kept_maps_;        ///< nullptr: no snapshots
  const LearnerDesk* desk_ = nullptr;          ///< nullptr: the planner decides by itself
  bool looked_ = false;                        ///< whether the learner has looked in this step
};

}  // namespace skein::agent
