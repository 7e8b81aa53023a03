#include "uav_agent/agent_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/thread_cpu.hpp"
#include "idl/conversions.hpp"
#include "uav_agent/neighbours.hpp"

namespace skein::agent {

using bus::LockstepClient;
using Counterpart = LockstepClient::Counterpart;

AgentNode::AgentNode(const Scenario& scenario, std::size_t uav, std::unique_ptr<Planner> planner, int base_domain,
                     bus::Bus& bus)
    : scenario_(scenario),
      bus_(bus),
      domain_(uav_domain(base_domain, uav)),
      id_(scenario.fleet.at(uav).name),
      node_(node_of_uav(uav)),
      radio_(scenario, node_),
      agent_(agent_config(scenario, uav), std::move(planner)) {
  join();
}

// Who was stopped by a fault comes back as somebody new on the network; what it had in mind stays.
void AgentNode::join() {
  client_.reset();
  participant_.reset();
  participant_ = bus_.join(domain_);
  client_.emplace(*participant_, inbox_, id_);
  read_sensors();
  read_captures();
  radio_.declare(*client_, input_.radio);
  client_->declare_writer(bus::spec(topics::captures(id_)), Counterpart::router);
  client_->declare_writer(bus::spec(topics::trajectory_command(id_)), Counterpart::server);
  client_->declare_writer(bus::spec(topics::gimbal_command(id_)), Counterpart::server);
  client_->declare_writer(bus::spec(topics::camera_trigger(id_)), Counterpart::server);
  client_->declare_writer(bus::spec(topics::capture_stored()), Counterpart::server);
}

template <class Message>
void AgentNode::read(const topics::WireTopic& topic, Counterpart counterpart,
                     std::function<void(const Message&)> handler) {
  client_->read<Message>(bus::spec(topic), counterpart, std::move(handler));
}

void AgentNode::read_sensors() {
  read<msg::Odometry>(topics::odometry(id_), Counterpart::server,
                      [this](const auto& m) { input_.state = from_odometry(m); });
  read<msg::TwistStamped>(topics::gimbal(id_), Counterpart::server,
                          [this](const auto& m) { input_.gimbal = from_gimbal(m); });
  read<msg::Duration>(topics::mission_duration_remained(id_), Counterpart::server,
                      [this](const auto& m) { input_.mission_remaining_s = from_duration(m); });
  read<msg::PointCloud>(topics::bounding_boxes(), Counterpart::server,
                        [this](const auto& m) { input_.boxes = from_box_vertices(m); });
  read<msg::PointCloud2>(topics::neighbour_odometry(id_), Counterpart::server,
                         [this](const auto& m) { input_.neighbours = neighbours_of(m); });
  const auto read_key_frames = [this](const topics::WireTopic& topic, std::optional<Node> source) {
    read<msg::PointCloud2>(topic, Counterpart::server, [this, source](const auto& m) {
      KeyFrame frame;
      frame.source = source;
      for (const ScanPoint& p : from_cloud<ScanPoint>(m)) {
        frame.points_W.emplace_back(p.x, p.y, p.z);
        if (!source) frame.source = whole_number(p.intensity);
      }
      input_.key_frames.push_back(std::move(frame));
    });
  };
  if (scenario_.fleet[node_ - 1].vehicle.lidar) read_key_frames(topics::self_keyframe(id_), node_);
  read_key_frames(topics::neighbour_keyframe(id_), std::nullopt);
  read<msg::PointCloud2>(topics::detected_points(id_), Counterpart::server, [this](const auto& m) {
    for (const DetectionPoint& p : from_cloud<DetectionPoint>(m)) {
      if (const auto index = whole_number(p.index)) input_.detected.push_back({{p.x, p.y, p.z}, p.score, *index});
    }
  });
}

void AgentNode::read_captures() {
  read<msg::CaptureReports>(topics::capture(), Counterpart::server, [this](const auto& m) {
    for (const auto& report : m.reports()) input_.capture_reports.push_back({report.capture(), encode(report)});
  });
  read<msg::CaptureAck>(topics::captures_ack_at_uav(id_), Counterpart::router, [this](const auto& m) {
    input_.capture_acks.insert(input_.capture_acks.end(), m.captures().begin(), m.captures().end());
  });
}

void AgentNode::think() {
  const msg::Step& step = client_->step();
  input_.k = step.k();
  input_.tick = step.tick();
  released_ = input_.capture_acks;
  const double before = thread_cpu_s();
  const AgentOutput output = agent_.step(input_);
  planner_cpu_s_ += thread_cpu_s() - before;
  {
    const bus::Burst burst(*participant_);
    write(output);
    client_->done();
  }
  last_step_answered_ = step.final_step();
  // State stays until the next sample replaces it; events are over.
  input_.boxes.clear();
  input_.key_frames.clear();
  input_.detected.clear();
  input_.capture_reports.clear();
  input_.capture_acks.clear();
  input_.radio.clear();
}

void AgentNode::write(const AgentOutput& output) {
  if (output.trajectory) {
    client_->write(topics::trajectory_command(id_).name, to_trajectory(input_.tick, *output.trajectory));
  }
  if (output.gimbal) client_->write(topics::gimbal_command(id_).name, to_gimbal_command(*output.gimbal));
  if (output.trigger) {
    msg::BoolStamped trigger;
    trigger.header(to_header(input_.tick));
    trigger.data(true);
    client_->write(topics::camera_trigger(id_).name, trigger);
  }
  if (!released_.empty()) {
    msg::CaptureAck ack;
    ack.uav(id_);
    ack.captures(released_);
    client_->write(topics::capture_stored().name, ack);
  }
  if (!output.captures.empty()) {
    msg::CaptureReports reports;
    for (const CaptureReport& capture : output.captures) {
      msg::CaptureReport report;
      if (decode(capture.payload, report)) reports.reports().push_back(std::move(report));
    }
    client_->write(topics::captures(id_).name, reports);
  }
  radio_.send(*client_, output.radio);
}

int AgentNode::run(const StopSignal& stop) {
  const bus::ClientLoop loop{.think = [this] { think(); }, .answered_last = [this] { return last_step_answered_; }};
  bus::LoopEnd end = bus::run_client(*client_, inbox_, loop, stop);
  while (end == bus::LoopEnd::resumed) {
    join();
    end = bus::run_client(*client_, inbox_, loop, stop);
  }
  return bus::exit_code(end, id_);
}

}  // namespace skein::agent
