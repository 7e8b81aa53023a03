// The lock-step member of a user's program, which replaces a UAV's on-board software or the program at the ground
// station. It exchanges serialised messages with the user's code, the caller. The node itself delivers the UAV's
// captures to the station, so that no user's program can lose one. Everything happens on the thread that takes the
// node's turns.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/radio_topics.hpp"
#include "core/scenario/scenario.hpp"
#include "idl/type_names.hpp"
#include "uav_agent/member_node.hpp"
#include "uav_agent/onboard/uplink.hpp"

namespace skein::agent {

/// A serialised message: topic name on the wire, payload with CDR encapsulation header.
struct WireMessage {
  std::string topic;
  std::vector<std::uint8_t> payload;
};

/// Topics that a user's program reads and writes, besides those of radio and custody; names and types on the wire.
struct UserTopics {
  std::vector<topics::WireTopic> reads;
  std::vector<topics::WireTopic> writes;
};

class UserNode : public MemberNode {
 public:
  /// @param node  radio node: of a UAV, or kStationNode. @param domain  DDS domain.
  /// @throws InputError if sim_server would not read all debug values: the fleet would wait for the program in vain
  UserNode(const Scenario& scenario, Node node, int domain, bus::Bus& bus, UserTopics topics);

  // ---- while a step waits for its answer ---------------------------------------------------------------------------

  /// Whether a step waits for answer(); all its samples have arrived.
  bool has_step() const { return waits_; }
  using MemberNode::step;
  /// Takes the messages that arrived with this step, by topic and then in the order of writing. They are returned once.
  std::vector<WireMessage> take() { return std::exchange(arrived_, {}); }
  /// Whether there is a link to the station, and the number of captures that it has not acknowledged.
  bool station_linked() const { return station_linked_; }
  std::size_t undelivered() const { return uplink_.undelivered(); }
  /// How often the node has joined the lock-step: once, and again after each fault that stopped it.
  int joins() const { return joins_; }

  enum class Said { sent, undeclared, full, closed };
  /// Queues a message, to be sent with this step's answer. Otherwise it is dropped: `undeclared`: the node does not
  /// write this topic; `full`: the step already has as many messages as the topic's depth; `closed`: the radio topic is
  /// registered, but not open yet.
  Said say(const std::string& topic, std::vector<std::uint8_t> payload);
  /// Answers the step: the node's next turn sends all queued messages and ends the step.
  void answer() { answered_ = true; }

  // ---- the program's own radio topics (docs/radio.md), while a step waits; ROS names and types ---------------------

  /// open() registers a topic for sending to `targets`, listen() one for receiving. The node repeats this when it
  /// rejoins.
  /// @throws InputError if topic or type is malformed
  void open(const std::string& topic, const std::string& type, const std::vector<std::string>& targets);
  void listen(const std::string& topic, const std::string& type);
  bus::RadioTopics::Status sending(const std::string& topic) const { return radio_->sending(topic); }
  bus::RadioTopics::Status listening(const std::string& topic) const { return radio_->listening(topic); }

 protected:
  void declare(bus::LockstepClient& client) override;
  bool may_think() override;

 private:
  struct Opened {
    std::string type;
    std::vector<std::string> targets;
  };

  void work(const bus::LockstepClient::Step&) override {}
  void send(bus::LockstepClient& client) override;
  void read(bus::LockstepClient& client, const topics::WireTopic& topic, bus::LockstepClient::Counterpart counterpart);
  void write(bus::LockstepClient& client, const topics::WireTopic& topic, bus::LockstepClient::Counterpart counterpart);
  void declare_radio(bus::LockstepClient& client);
  void declare_custody(bus::LockstepClient& client);
  void send_custody(bus::LockstepClient& client);
  void see_neighbours(std::span<const std::uint8_t> payload);
  void request_again();
  bool is_uav() const { return node_ != kStationNode; }

  const Scenario& scenario_;
  const Node node_;
  const UserTopics topics_;
  std::unique_ptr<bus::RadioTopics> radio_;
  std::map<std::string, Opened> opened_;         ///< arguments of open(), by ROS topic
  std::map<std::string, std::string> listened_;  ///< arguments of listen(): type, by ROS topic
  std::set<std::string> read_;                   ///< topics with a reader, names on the wire
  std::map<std::string, std::size_t> share_;     ///< most messages per step, by topic on the wire
  std::map<std::string, std::size_t> said_;      ///< messages so far in this step, by topic on the wire
  std::vector<WireMessage> arrived_, to_send_;
  bool waits_ = false, answered_ = false;
  bool fresh_ = true;  ///< it has joined, and has had no step since
  int joins_ = 0;

  Uplink uplink_;
  bool station_linked_ = false;
  std::map<std::uint64_t, msg::CaptureReport> reports_;  ///< not yet acknowledged, by capture
  std::vector<std::uint64_t> released_;                  ///< acknowledged captures that the camera may forget
};

}  // namespace skein::agent
