#include "sim_server/uav_node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/strangers.hpp"
#include "idl/activity_conversions.hpp"

namespace skein::sim {
namespace {

// Builds a message only if a program reads it: large unread messages would be the server's greatest cost.
void send(bus::CountedWriter& writer, auto&& make) {
  if (writer.is_wanted()) {
    writer.write(make());
  } else {
    writer.skip();
  }
}

}  // namespace

msg::PointCloud2 neighbour_cloud(const Simulation& simulation, const Scenario& scenario, Node node) {
  const auto linked = [&](Node other) { return simulation.open_links().at(other, node) != 0; };
  std::vector<NeighbourPoint> points;
  if (linked(kStationNode)) {
    const Eigen::Vector3f p = scenario.station_position.cast<float>();
    points.push_back({.x = p.x(), .y = p.y(), .z = p.z(), .node = 0, .t = seconds(simulation.tick())});
  }
  for (const UavIndex other : FirstUavs(simulation.size())) {
    if (node_of_uav(other) == node || !linked(node_of_uav(other))) continue;
    const RigidBodyState& state = simulation.uav(other).told;
    const Eigen::Vector3f p = state.p_WB.cast<float>(), w = state.w_WB_B.cast<float>();
    const Eigen::Vector3f v = (state.q_WB.conjugate() * state.v_WB).cast<float>();
    const Eigen::Quaternionf q = state.q_WB.cast<float>();
    points.push_back({p.x(), p.y(), p.z(), static_cast<float>(node_of_uav(other)),
                      seconds(simulation.uav(other).told_tick), q.x(), q.y(), q.z(), q.w(), v.x(), v.y(), v.z(), w.x(),
                      w.y(), w.z()});
  }
  return to_cloud(simulation.tick(), points);
}

std::span<const std::uint8_t> HeardKeyFrames::payload(const Simulation& simulation, std::size_t event) {
  const std::vector<KeyFrameEvent>& events = simulation.events().key_frames;
  if (step_ != simulation.step()) payloads_.assign(events.size(), {});
  step_ = simulation.step();
  std::vector<std::uint8_t>& payload = payloads_.at(event);
  const auto& [uav, frame, neighbours] = events[event];
  if (payload.empty()) payload = encode(to_cloud(frame.tick, frame.points_W, static_cast<float>(node_of_uav(uav))));
  return payload;
}

UavNode::UavNode(UavIndex uav, const Scenario& scenario, Simulation& simulation, HeardKeyFrames& heard,
                 bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain)
    : uav_(uav),
      scenario_(scenario),
      simulation_(simulation),
      server_(server),
      domain_(domain),
      heard_(heard),
      id_(scenario.fleet[uav].name),
      fleet_(scenario.uav_names()),
      odometry_(server.writer(domain, bus::spec(topics::odometry(id_)))),
      gimbal_(server.writer(domain, bus::spec(topics::gimbal(id_)))),
      neighbour_odometry_(server.writer(domain, bus::spec(topics::neighbour_odometry(id_)))),
      neighbour_keyframe_(server.writer(domain, bus::spec(topics::neighbour_keyframe(id_)))),
      detected_points_(server.writer(domain, bus::spec(topics::detected_points(id_)))),
      detected_(server.writer(domain, bus::spec(topics::detected()))),
      remained_(server.writer(domain, bus::spec(topics::mission_duration_remained(id_)))),
      clock_(server.writer(domain, bus::spec(topics::clock()))),
      boxes_(server.writer(domain, bus::spec(topics::bounding_boxes()))),
      rejected_(server.writer(domain, bus::spec(topics::command_rejected(id_)))),
      capture_(server.writer(domain, bus::spec(topics::capture()))) {
  if (scenario.fleet[uav].vehicle.lidar) {
    cloud_ = &server.writer(domain, bus::spec(topics::cloud(id_)));
    servo_ = &server.writer(domain, bus::spec(topics::lidar_servo(id_)));
    self_keyframe_ = &server.writer(domain, bus::spec(topics::self_keyframe(id_)));
  }
  if (scenario.conditions.battery.on()) battery_ = &server.writer(domain, bus::spec(topics::battery(id_)));
  if (scenario.conditions.wind.on()) wind_ = &server.writer(domain, bus::spec(topics::wind(id_)));
  if (scenario.conditions.radio.on()) radio_links_ = &server.writer(domain, bus::spec(topics::radio_links(id_)));
  server.read<msg::MultiDOFJointTrajectory>(domain, bus::spec(topics::trajectory_command(id_)),
                                            [this](const msg::MultiDOFJointTrajectory& trajectory) {
                                              if (const auto command = from_trajectory(trajectory))
                                                simulation_.command_trajectory(uav_, *command);
                                            });
  server.read<msg::Twist>(domain, bus::spec(topics::gimbal_command(id_)), [this](const msg::Twist& twist) {
    simulation_.command_gimbal(uav_, from_gimbal_command(twist));
  });
  for (const topics::WireTopic& topic : {topics::camera_trigger(id_), topics::trigger(id_)}) {
    server.read<msg::BoolStamped>(domain, bus::spec(topic), [this](const msg::BoolStamped& trigger) {
      if (trigger.data()) simulation_.trigger_camera(uav_);
    });
  }
  server.read<msg::CaptureAck>(domain, bus::spec(topics::capture_stored()), [this](const msg::CaptureAck& ack) {
    for (const std::uint64_t capture : from_capture_ack(ack, id_)) {
      if (card_.erase(capture) > 0) released_.push_back(capture);
    }
  });
}

/// Warns of the topic because its program waits until all topics that it writes have readers, and the fleet waits for
/// the program.
void UavNode::warn_of_unread_debug(const std::string& topic) const {
  spdlog::warn(
      "{} announces the topic '{}', which sim_server does not read: the name of a debug value begins with a letter, "
      "has only letters, digits and _, and is one of at most {} of a UAV",
      id_, topic.substr(0, kMostNameBytes), topics::kMostDebugNames);
}

void UavNode::read_debug(const std::vector<std::string>& writes) {
  const bus::TopicSpec activity = bus::spec(topics::activity(id_));
  if (!reads_activity_ && std::ranges::find(writes, activity.name) != writes.end()) {
    reads_activity_ = true;
    server_.read<msg::Activity>(domain_, activity,
                                [this](const msg::Activity& message) { activity_ = from_activity(message); });
  }
  for (const std::string& topic : writes) {
    if (!topic.starts_with(topics::debug(id_, "").name)) continue;
    const std::string name(topics::debug_name(topic, id_));
    if (debug_names_.contains(name)) continue;
    if (name.empty() || debug_names_.size() == topics::kMostDebugNames) {
      if (!std::exchange(warned_of_debug_, true)) warn_of_unread_debug(topic);
      continue;
    }
    debug_names_.insert(name);
    server_.read<msg::Float64>(domain_, bus::spec(topics::debug(id_, name)),
                               [this, name](const msg::Float64& value) { debug_.emplace_back(name, value.data()); });
  }
}

void UavNode::choose_scans(bool shown) {
  simulation_.want_scans(uav_, shown || (cloud_ != nullptr && cloud_->is_wanted()));
}

void UavNode::publish() {
  publish_state();
  publish_neighbours();
  publish_clouds();
  publish_captures();
  publish_rejections();
}

void UavNode::publish_state() {
  const Tick tick = simulation_.tick();
  const UavView& view = simulation_.uav(uav_);
  send(odometry_, [&] { return to_odometry(view.told_tick, id_, view.told, view.uncertainty); });
  if (battery_) send(*battery_, [&] { return to_battery(tick, *view.battery, scenario_.conditions.battery.cells); });
  if (wind_) send(*wind_, [&] { return to_wind(tick, *view.wind_W); });
  send(gimbal_, [&] { return to_gimbal(tick, id_, view.gimbal); });
  send(clock_, [&] {
    msg::Clock clock;
    clock.clock(to_time(tick));
    return clock;
  });
  if (simulation_.mission().start_tick()) {
    send(remained_, [&] { return to_duration(simulation_.mission().remaining_s(tick)); });
  }
  if (!boxes_sent_) boxes_.write(to_box_vertices(tick, simulation_.scene().boxes));
  boxes_sent_ = true;
}

void UavNode::publish_neighbours() {
  send(neighbour_odometry_, [&] { return neighbour_cloud(simulation_, scenario_, node_of_uav(uav_)); });
  if (radio_links_) send(*radio_links_, [&] { return to_radio_links(simulation_.tick(), link_qualities()); });
}

LinkQualities UavNode::link_qualities() const {
  LinkQualities qualities;
  for (const Node other : scenario_.nodes()) {
    if (other == node_of_uav(uav_)) continue;
    if (const auto quality = simulation_.link_quality(node_of_uav(uav_), other)) {
      qualities.emplace_back(other, *quality);
    }
  }
  return qualities;
}

void UavNode::publish_clouds() {
  for (const LidarEvent& scan : simulation_.events().scans) {
    if (scan.uav == uav_ && cloud_) send(*cloud_, [&] { return to_cloud(scan.scan.tick, scan.scan.points_W); });
  }
  for (const ServoEvent& event : simulation_.events().servos) {
    if (event.uav == uav_ && servo_) send(*servo_, [&] { return to_lidar_servo(event.servo); });
  }
  const std::vector<KeyFrameEvent>& frames = simulation_.events().key_frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const KeyFrameEvent& frame = frames[i];
    if (frame.uav == uav_ && self_keyframe_)
      send(*self_keyframe_, [&] { return to_cloud(frame.key_frame.tick, frame.key_frame.points_W); });
    const bool neighbour = std::find(frame.neighbours.begin(), frame.neighbours.end(), uav_) != frame.neighbours.end();
    if (neighbour) send(neighbour_keyframe_, [&] { return heard_.payload(simulation_, i); });
  }
}

void UavNode::publish_captures() {
  msg::CaptureReports reports;
  if (resend_) {
    for (const auto& [number, report] : card_) reports.reports().push_back(to_message(report, fleet_));
  }
  for (const CaptureEvent& event : simulation_.events().captures) {
    if (event.uav != uav_) continue;
    detections_.add(event.capture, event.X_told_W);
    if (!event.report) continue;
    const auto [entry, fresh] = card_.emplace(event.report->capture, detections_.as_told(*event.report));
    reports.reports().push_back(to_message(entry->second, fleet_));
  }
  if (!reports.reports().empty()) capture_.write(reports);
  publish_detections();
  resend_ = false;
}

void UavNode::publish_detections() {
  const std::span<const DetectionLog::Entry> log = detections_.entries();
  std::vector<std::uint32_t> seen = detections_.take_seen();
  const auto cloud_of = [&](const std::vector<std::uint32_t>& numbers) {
    std::vector<DetectionPoint> points;
    for (const std::uint32_t number : numbers) {
      const InterestPoint point = log[number].as_told(simulation_.scene().points[log[number].point]);
      points.push_back({point.p_W.x(), point.p_W.y(), point.p_W.z(), log[number].best, point.n_W.x(), point.n_W.y(),
                        point.n_W.z(), static_cast<float>(number)});
    }
    return to_cloud(simulation_.tick(), points);
  };
  std::vector<std::uint32_t> all(log.size());
  std::iota(all.begin(), all.end(), 0U);
  if (!seen.empty()) send(detected_points_, [&] { return cloud_of(all); });
  if (resend_) seen = all;
  if (!seen.empty()) send(detected_, [&] { return cloud_of(seen); });
}

void UavNode::publish_rejections() {
  const auto publish = [this](const std::string& command, const std::string& reason, std::uint64_t total) {
    msg::CommandRejected rejected;
    rejected.header(to_header(simulation_.tick()));
    rejected.command(command);
    rejected.reason(reason);
    rejected.total(total);
    rejected_.write(rejected);
  };
  for (const RejectionEvent& event : simulation_.events().rejections) {
    if (event.uav != uav_) continue;
    const bool trajectory = event.command == RejectionEvent::Command::trajectory;
    publish((trajectory ? topics::trajectory_command(id_) : topics::gimbal_command(id_)).name, event.reason,
            event.total);
  }
  for (const std::string& topic : std::exchange(unheard_, {})) {
    publish(topic, bus::kUnheardReason, simulation_.uav(uav_).commands_rejected);
  }
}

}  // namespace skein::sim
