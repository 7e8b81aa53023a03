#include "uav_agent/agent_node.hpp"

#include <spdlog/spdlog.h>

#include "bus/lockstep/names.hpp"
#include "core/messages/view_topics.hpp"
#include "idl/activity_conversions.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "idl/hand_conversions.hpp"
#include "process/host/thread_cpu.hpp"
#include "uav_agent/diagnostics.hpp"
#include "uav_agent/neighbours.hpp"
#include "uav_agent/octomap_message.hpp"

namespace skein::agent {

using bus::LockstepClient;
using Counterpart = LockstepClient::Counterpart;

AgentNode::AgentNode(const Scenario& scenario, UavIndex uav, std::unique_ptr<Planner> planner, int base_domain,
                     bus::Bus& bus, std::shared_ptr<ReadyFrames> frames, bool by_hand)
    : MemberNode(bus, uav_domain(base_domain, uav), scenario.fleet.at(uav).name),
      scenario_(scenario),
      uav_(uav),
      by_hand_(by_hand),
      radio_(scenario, node_of_uav(uav)),
      agent_(agent_config(scenario, uav), std::move(planner), std::move(frames)) {}

void AgentNode::start() {
  octomap_.reset();  // the writers belong to the participant that MemberNode::start() replaces
  flight_map_.reset();
  diagnostics_.reset();
  MemberNode::start();
  octomap_ = participant().create_writer(bus::spec(topics::octomap(member())));
  flight_map_ = participant().create_writer(bus::spec(topics::flight_map(member())));
  diagnostics_ = participant().create_writer(bus::spec(topics::diagnostics()));
  shown_key_frames_ = shown_flight_key_frames_ = 0;
  shown_tree_.reset();
}

void AgentNode::declare(LockstepClient& client) {
  read_sensors(client);
  read_captures(client);
  radio_.declare(client, input_.radio);
  client.declare_writer(bus::spec(topics::captures(member())), Counterpart::router);
  client.declare_writer(bus::spec(topics::trajectory_command(member())), Counterpart::server);
  client.declare_writer(bus::spec(topics::gimbal_command(member())), Counterpart::server);
  client.declare_writer(bus::spec(topics::camera_trigger(member())), Counterpart::server);
  client.declare_writer(bus::spec(topics::capture_stored()), Counterpart::server);
  client.declare_writer(bus::spec(topics::activity(member())), Counterpart::server);
  for (const std::string& name : agent_.debug_names()) {
    client.declare_writer(bus::spec(topics::debug(member(), name)), Counterpart::server);
  }
}

void AgentNode::read_conditions(LockstepClient& client) {
  if (scenario_.conditions.battery.on()) {
    client.read<msg::BatteryState>(bus::spec(topics::battery(member())), Counterpart::server, [this](const auto& m) {
      if (const auto battery = from_battery(m)) input_.battery = battery;
    });
  }
  if (scenario_.conditions.wind.on()) {
    client.read<msg::TwistStamped>(bus::spec(topics::wind(member())), Counterpart::server, [this](const auto& m) {
      if (const auto wind = from_wind(m)) input_.wind_W = wind;
    });
  }
  if (scenario_.conditions.radio.on()) {
    client.read<msg::RadioLinks>(bus::spec(topics::radio_links(member())), Counterpart::server,
                                 [this](const auto& m) { input_.links = from_radio_links(m); });
  }
}

void AgentNode::read_sensors(LockstepClient& client) {
  client.read<msg::Odometry>(bus::spec(topics::odometry(member())), Counterpart::server, [this](const auto& m) {
    input_.state = from_odometry(m);
    input_.state_tick = from_time(m.header().stamp());
    input_.uncertainty = uncertainty_from_odometry(m);
  });
  read_conditions(client);
  client.read<msg::TwistStamped>(bus::spec(topics::gimbal(member())), Counterpart::server,
                                 [this](const auto& m) { input_.gimbal = from_gimbal(m); });
  client.read<msg::Duration>(bus::spec(topics::mission_duration_remained(member())), Counterpart::server,
                             [this](const auto& m) { input_.mission_remaining_s = from_duration(m); });
  client.read<msg::PointCloud>(bus::spec(topics::bounding_boxes()), Counterpart::server,
                               [this](const auto& m) { input_.boxes = from_box_vertices(m); });
  client.read<msg::PointCloud2>(bus::spec(topics::neighbour_odometry(member())), Counterpart::server,
                                [this](const auto& m) { input_.neighbours = neighbours_of(m); });
  if (by_hand_) {
    client.read<msg::HandCommand>(bus::spec(topics::hand(member())), Counterpart::server, [this](const auto& m) {
      if (const auto command = from_hand_command(m)) input_.hand = command;
    });
  }
  const auto read_key_frames = [this, &client](const topics::WireTopic& topic, std::optional<Node> source) {
    client.read<msg::PointCloud2>(bus::spec(topic), Counterpart::server, [this, source](const auto& m) {
      KeyFrame frame;
      frame.source = source;
      const std::vector<ScanPoint> points = from_cloud<ScanPoint>(m);
      frame.points_W.reserve(points.size());
      for (const ScanPoint& p : points) frame.points_W.emplace_back(p.x, p.y, p.z);
      if (!source && !points.empty()) frame.source = node_of(points.back().intensity);
      input_.key_frames.push_back(std::move(frame));
    });
  };
  if (scenario_.fleet[uav_].vehicle.lidar) read_key_frames(topics::self_keyframe(member()), node_of_uav(uav_));
  read_key_frames(topics::neighbour_keyframe(member()), std::nullopt);
  if (agent_.wants_beams()) {
    client.read<msg::JointState>(bus::spec(topics::lidar_servo(member())), Counterpart::server, [this](const auto& m) {
      if (const auto servo = from_lidar_servo(m)) input_.servos.push_back(*servo);
    });
  }
  if (scenario_.fleet[uav_].vehicle.lidar && (agent_.wants_scans() || agent_.wants_beams())) {
    client.read<msg::PointCloud2>(bus::spec(topics::cloud(member())), Counterpart::server, [this](const auto& m) {
      Scan scan{.tick = from_time(m.header().stamp())};
      for (const ScanPoint& p : from_cloud<ScanPoint>(m)) scan.points_W.emplace_back(p.x, p.y, p.z);
      input_.scans.push_back(std::move(scan));
    });
  }
  client.read<msg::PointCloud2>(bus::spec(topics::detected()), Counterpart::server, [this](const auto& m) {
    for (const DetectionPoint& p : from_cloud<DetectionPoint>(m)) {
      const auto order = whole_number(p.order);
      if (!order) continue;
      input_.detected.push_back({{p.x, p.y, p.z}, p.score, *order, {p.normal_x, p.normal_y, p.normal_z}});
    }
  });
}

void AgentNode::read_captures(LockstepClient& client) {
  client.read<msg::CaptureReports>(bus::spec(topics::capture()), Counterpart::server, [this](const auto& m) {
    for (const auto& report : m.reports()) {
      input_.capture_reports.push_back({report.capture(), encoded_size(report)});
      reports_.insert_or_assign(report.capture(), report);
    }
  });
  client.read<msg::CaptureAck>(
      bus::spec(topics::captures_ack_at_uav(member())), Counterpart::router, [this](const auto& m) {
        const std::vector<std::uint64_t> captures = from_capture_ack(m, member());
        input_.capture_acks.insert(input_.capture_acks.end(), captures.begin(), captures.end());
      });
}

/// All announced messages have been read: a learner writes its observation, and works once its orders are there.
bool AgentNode::may_think() {
  if (desk_ == nullptr) return true;
  const msg::Step& step = this->step();
  if (!looked_ && desk_->looks(step.k())) {
    input_.k = step.k();
    input_.tick = step.tick();
    agent_.look(input_);
    looked_ = true;
  }
  return !looked_ || desk_->told(step.k());
}

void AgentNode::work(const msg::Step& step) {
  looked_ = false;
  input_.k = step.k();
  input_.tick = step.tick();
  released_ = input_.capture_acks;
  const std::size_t reasons = agent_.no_ways().size();
  output_ = agent_.step(input_);
  if (agent_.no_ways().size() > reasons) spdlog::info("{:.2f} s: no way: {}", seconds(input_.tick), agent_.no_way());
  if (input_.capture_reports.empty() && input_.capture_acks.empty()) return;
  std::erase_if(reports_, [this](const auto& entry) { return !agent_.holds_capture(entry.first); });
}

std::vector<std::string> AgentNode::no_ways() const {
  std::vector<std::string> sentences;
  for (const auto& [reason, times] : agent_.no_ways()) sentences.push_back(fmt::format("{} times: {}", times, reason));
  return sentences;
}

std::optional<std::vector<WaitReport>> AgentNode::waits() const {
  std::vector<WaitReport> reports;
  for (const WaitSpan& wait : agent_.waits()) {
    const bool known = wait.mate < scenario_.fleet.size();
    reports.push_back({wait.from_s, wait.until_s, known ? Text(scenario_.fleet[UavIndex{wait.mate}].name) : Text()});
  }
  return reports;
}

std::optional<SafetyFilterReport> AgentNode::safety_filter() const {
  const SafetyFilter::Counts* counts = agent_.filter_counts();
  if (counts == nullptr) return std::nullopt;
  return SafetyFilterReport{.steps = counts->exchanges, .slowed = counts->slowed, .breaches = counts->broken};
}

void AgentNode::time_parts() { agent_.time_parts(thread_cpu_s); }

std::optional<std::vector<WorkPartReport>> AgentNode::planner_parts() const {
  if (agent_.parts() == nullptr) return std::nullopt;
  std::vector<WorkPartReport> reports;
  for (const WorkParts::Part& part : agent_.parts()->all()) reports.push_back({part.cpu_s, Text(part.name)});
  return reports;
}

void AgentNode::keep_maps(std::unique_ptr<KeptMaps> maps) { kept_maps_ = std::move(maps); }

std::string AgentNode::end_maps() {
  if (!kept_maps_) return {};
  kept_maps_->end(agent_.world_map(), agent_.map());
  return kept_maps_->write_error();
}

void AgentNode::send(LockstepClient& client) {
  write(client);
  // Before the step is answered, so that an agent that a fault kills at the next step has kept the same snapshots in
  // each run.
  if (kept_maps_) kept_maps_->keep(input_.tick, agent_.world_map(), agent_.map());
  // State stays until the next sample replaces it; events count only in the step in which they arrived.
  input_.boxes.clear();
  input_.key_frames.clear();
  input_.scans.clear();
  input_.servos.clear();
  input_.detected.clear();
  input_.capture_reports.clear();
  input_.capture_acks.clear();
  input_.radio.clear();
  input_.hand.reset();
}

void AgentNode::show() {
  show_octomap();
  show_flight_map();
  show_diagnostics();
}

void AgentNode::show_octomap() {
  if (input_.tick < octomap_due_) return;
  octomap_due_ = input_.tick + kTicksPerSecond;
  const OccupancyMap& map = agent_.map();
  if (map.key_frames() == shown_key_frames_ || !octomap_->has_readers()) return;
  shown_key_frames_ = map.key_frames();
  octomap_->write(encode(octomap_of(map, input_.tick)));
}

void AgentNode::show_flight_map() {
  if (!flight_map_->has_readers()) {
    flight_map_due_ = 0;  // a new reader need not wait: the run may be held step by step
    return shown_tree_.reset();
  }
  if (input_.tick < flight_map_due_) return;
  flight_map_due_ = input_.tick + kTicksPerSecond;
  if (const WorldMap* world = agent_.world_map()) {
    if (!shown_tree_) shown_tree_.emplace();
    if (!shown_tree_->update(*world)) return;
    flight_map_->write(encode(octomap_of(shown_tree_->bytes(), world->config().cell_m, input_.tick)));
  } else if (agent_.map().key_frames() != shown_flight_key_frames_) {
    shown_flight_key_frames_ = agent_.map().key_frames();
    flight_map_->write(encode(octomap_of(agent_.map(), input_.tick)));
  }
}

void AgentNode::show_diagnostics() {
  if (input_.tick < diagnostics_due_ || !diagnostics_->has_readers()) return;
  diagnostics_due_ = input_.tick + kTicksPerSecond;
  DiagnosticFacts facts{.uav = member(),
                        .k = input_.k,
                        .tick = input_.tick,
                        .mission_remaining_s = input_.mission_remaining_s,
                        .undelivered = agent_.undelivered(),
                        .unreadable = malformed(),
                        .unsent = unsent(),
                        .planner_cpu_s = planner_cpu().total_s(),
                        .filter = agent_.filter_counts(),
                        .breaches_told = breaches_told_,
                        .no_way = agent_.no_way(),
                        .battery = input_.battery};
  for (const Neighbour& neighbour : input_.neighbours) {
    if (neighbour.node <= scenario_.fleet.size()) facts.linked.push_back(scenario_.node_name(neighbour.node));
  }
  if (facts.filter != nullptr) breaches_told_ = facts.filter->broken;
  diagnostics_->write(encode(diagnostics_of(facts)));
}

void AgentNode::write(LockstepClient& client) const {
  if (output_.trajectory) {
    client.write(topics::trajectory_command(member()).name, to_trajectory(input_.tick, *output_.trajectory));
  }
  if (output_.gimbal) client.write(topics::gimbal_command(member()).name, to_gimbal_command(*output_.gimbal));
  if (output_.trigger) {
    msg::BoolStamped trigger;
    trigger.header(to_header(input_.tick));
    trigger.data(true);
    client.write(topics::camera_trigger(member()).name, trigger);
  }
  for (const DebugValue& debug : output_.debug) {
    msg::Float64 value;
    value.data(debug.value);
    client.write(topics::debug(member(), debug.name).name, value);
  }
  if (output_.activity) {
    Activity activity = *output_.activity;
    activity.cpu_s = planner_cpu().total_s();
    client.write(topics::activity(member()).name, to_activity(input_.tick, activity));
  }
  if (!released_.empty()) {
    client.write(topics::capture_stored().name, to_capture_ack(member(), released_));
  }
  if (!output_.captures.empty()) {
    msg::CaptureReports reports;
    for (const std::uint64_t capture : output_.captures) reports.reports().push_back(reports_.at(capture));
    client.write(topics::captures(member()).name, reports);
  }
  radio_.send(client, output_.radio);
}

}  // namespace skein::agent
