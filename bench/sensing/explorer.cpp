#include "bench/sensing/explorer.hpp"

#include "core/scenario/scenario_reader.hpp"

namespace skein::bench {

namespace {

constexpr UavIndex kSelf{0};
constexpr double kFarM = 1000.0;  // farther than any flight of this benchmark

}  // namespace

Scenario lone_explorer(const Vector2d& start) {
  Scenario scenario = load_scenario("cranes", {.uavs = 1});
  scenario.fleet.front().start = start;
  scenario.fleet.front().start_yaw = 0.0;
  return scenario;
}

Explorer::Explorer(const Scenario& scenario, Scene scene, std::uint64_t seed, std::unique_ptr<agent::Planner> planner)
    : simulation_(scenario, std::move(scene), seed), agent_(agent::agent_config(scenario, kSelf), std::move(planner)) {
  simulation_.want_scans(kSelf, agent_.wants_beams());
}

void Explorer::step() {
  const sim::UavView& view = simulation_.uav(kSelf);
  const sim::StepEvents& events = simulation_.events();
  agent::AgentInput input;
  input.k = simulation_.step();
  input.tick = simulation_.tick();
  input.state = view.told;
  input.gimbal = view.gimbal;
  if (simulation_.mission().start_tick()) input.mission_remaining_s = simulation_.mission().remaining_s(input.tick);
  if (!boxes_told_) input.boxes = simulation_.scene().boxes;
  boxes_told_ = true;
  for (const sim::KeyFrameEvent& event : events.key_frames) {
    input.key_frames.push_back({.points_W = event.key_frame.points_W, .source = node_of_uav(kSelf)});
  }
  if (agent_.wants_beams()) {
    for (const sim::LidarEvent& event : events.scans) input.scans.push_back({event.scan.tick, event.scan.points_W});
    for (const sim::ServoEvent& event : events.servos) input.servos.push_back(event.servo);
  }
  const agent::AgentOutput output = agent_.step(input);
  if (output.trajectory) simulation_.command_trajectory(kSelf, *output.trajectory);
  if (output.gimbal) simulation_.command_gimbal(kSelf, *output.gimbal);
  simulation_.advance();
}

agent::PlannerOutput RoutePlanner::plan(const agent::PlannerInput& input) {
  agent::PlannerOutput output;
  const Vector3d& p_WB = input.state.p_WB;
  if (phase_ == Phase::ground) {
    phase_ = Phase::climb;
    output.motion = agent::Path{{{p_WB + config_.height_m * Vector3d::UnitZ(), config_.climb_mps}}};
  } else if (phase_ == Phase::climb && input.tracking.done) {
    phase_ = Phase::hover;
    hovers_since_ = input.tick;
  } else if (phase_ == Phase::hover && input.tick - hovers_since_ >= ticks(config_.hover_s)) {
    phase_ = Phase::flight;
    output.motion = agent::Path{{{input.tracking.setpoint.p_WB + kFarM * config_.along_W, config_.speed_mps}}};
  }
  Seen seen{.tick = input.tick, .hovering_s = {}, .state = input.state, .beam_scans = input.beam_scans};
  if (phase_ >= Phase::hover) seen.hovering_s = seconds(input.tick - hovers_since_);
  look_(seen);
  return output;
}

}  // namespace skein::bench
