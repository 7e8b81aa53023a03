#include "sim_server/recording_node.hpp"

#include "core/topics.hpp"
#include "idl/conversions.hpp"
#include "results/run_folder.hpp"
#include "sim_server/viz/frames.hpp"
#include "sim_server/viz/markers.hpp"

namespace skein::sim {
namespace {

constexpr const char* kEventsTopic = "/skein/events";
constexpr Tick kFramesPeriod = kTicksPerSecond / 5, kMarkersPeriod = kTicksPerSecond;

std::string name_of(const topics::TopicInfo& topic) { return std::string(topic.pattern); }

msg::Event to_event(const LoggedEvent& event) {
  msg::Event message;
  message.stamp(to_time(event.tick));
  message.step(event.step);
  message.event(event.event);
  message.subject(event.subject);
  message.object(event.object);
  return message;
}

}  // namespace

RecordingNode::RecordingNode(const std::filesystem::path& folder, recording::Scope scope, const Scenario& scenario,
                             EventLog& events, const recording::ReplayOptions& replay)
    : scenario_(scenario), recorder_(folder, programs::kSimServer, scope) {
  if (replay.active()) replay_.emplace(replay, recorder_);
  if (scope <= recording::Scope::messages) return;
  events.tell([this](const LoggedEvent& event) { recorder_.add(kEventsTopic, to_event(event)); });
}

void RecordingNode::begin_step(const Simulation& simulation, const std::vector<std::string>& faults) {
  recorder_.set_time(simulation.tick());
  if (replay_) replay_->begin_step(simulation.tick());
  for (const std::string& line : faults) {
    recorder_.add(kEventsTopic, to_event({simulation.step(), simulation.tick(), "fault", line, ""}));
  }
  if (recorder_.scope() > recording::Scope::messages) add_views(simulation);
}

void RecordingNode::end_step() {
  if (replay_) replay_->end_step();
}

bool RecordingNode::is_replayed(Tick tick) const { return replay_ && replay_->is_over(tick); }

std::optional<std::vector<std::string>> RecordingNode::differences() const {
  return replay_ ? std::optional(replay_->differences().texts()) : std::nullopt;
}

void RecordingNode::add_views(const Simulation& simulation) {
  const Tick tick = simulation.tick();
  const std::span<const UavView> uavs = simulation.uavs();
  if (tick == 0) {
    recorder_.add(name_of(topics::kTfStatic), viz::fixed_frames(scenario_));
    recorder_.add(name_of(topics::kVizStructure), viz::structure_marker(simulation.scene().mesh));
    recorder_.add(name_of(topics::kVizBoxes), viz::box_marker(simulation.scene().boxes));
  }
  if (tick >= frames_due_) {
    recorder_.add(name_of(topics::kTf), viz::moving_frames(tick, scenario_, uavs));
    frames_due_ = tick + kFramesPeriod;
  }
  if (tick < markers_due_) return;
  recorder_.add(name_of(topics::kVizFleet), viz::fleet_markers(tick, scenario_, uavs));
  recorder_.add(name_of(topics::kVizFrusta), viz::frustum_markers(tick, scenario_, uavs));
  recorder_.add(name_of(topics::kVizLinks), viz::link_marker(tick, scenario_, uavs, simulation.open_links()));
  markers_due_ = tick + kMarkersPeriod;
}

std::string RecordingNode::close() {
  recorder_.close();
  return recorder_.write_error();
}

}  // namespace skein::sim
